#pragma once
/// cpp-httplib with the limits that it lacks: on the time and size of a request, and on what waits.

#include <atomic>

#include "serve/http.h"
#include "serve/reception.h"

namespace rollrig::serve {

/// One request a connection, read and answered within the limits of connection.h.
class HttpServer : public httplib::Server {
 public:
  explicit HttpServer(const ConnectionLimits& limits);

  /// To be called once it is bound: cpp-httplib lets five connections wait for the operating system, and further
  /// clients, even those of one browser, would be refused.
  void lengthen_queue();

  /// Takes no further connection, and closes those that are not answered yet. listen_after_bind() then returns.
  void end();

 private:
  bool process_and_close_socket(socket_t socket) override;
  void answer(Connection& connection);

  ConnectionLimits limits_;
  std::atomic<bool> is_ending_{false};
  Reception reception_;  // the last member: its threads use the others
};

}  // namespace rollrig::serve
