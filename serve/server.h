#pragma once
/// The server of `rollrig serve`: one page and what it asks for, on this computer alone.

#include <chrono>
#include <memory>
#include <string>

#include "serve/shelf.h"

namespace rollrig::serve {

struct ServerOptions {
  ShelfFiles files;
  std::string keep_folder = "rollrig_serve";
  int port = 0;       // 0: any that is free
  int threads = 0;    // of a diagnosis; 0: all of the machine but one, so that the controls stay quick
  std::string token;  // empty: a new one
  std::chrono::milliseconds head_limit{5000};  // within which a client has to say what it wants
};

class Server {
 public:
  /// Listens from here on. Throws InputError where a file is wrong or the port is taken.
  explicit Server(const ServerOptions& options);
  /// Stops: connections that are open are answered or let go, a running diagnosis ends at its next step, dropped files
  /// are deleted.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  const std::string& token() const;
  /// The address of the page, with the token.
  std::string url() const;
  /// The private folder of the dropped files. It goes with the server.
  const std::string& dropped_folder() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace rollrig::serve
