#pragma once
/// One connection of a client, within limits of time and size that cpp-httplib does not have.

#include <array>
#include <atomic>
#include <chrono>

#include "serve/http.h"

namespace rollrig::serve {

/// The connection of a client that is slower or sends more than this is closed. Assumed: all of it; the client is on
/// this computer.
struct ConnectionLimits {
  std::chrono::milliseconds head{5000};      // from the connection to the end of the head of the request
  std::chrono::milliseconds request{30000};  // from when a thread takes it to the end of its content
  std::chrono::milliseconds answer{30000};   // from the first to the last byte of the answer
  std::chrono::milliseconds linger{3000};    // for a client that still sends when it is answered
  std::size_t head_bytes = 16384;
};

/// Of the head of a request.
enum class HeadState {
  kSilent,  // it is not in yet
  kReady,   // it is in, or too long
  kGone     // the client has closed the connection, or was too slow
};

/// A socket as cpp-httplib reads and writes it. A read or write beyond a limit fails, and the request with it.
class Connection : public httplib::Stream {
 public:
  /// Reads and writes fail once `is_ending` is true.
  Connection(socket_t socket, const ConnectionLimits& limits, const std::atomic<bool>& is_ending);
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Takes what has come of the head, without waiting.
  HeadState receive_head();
  /// To be called where the answer begins: waiting for a thread is not the client's fault.
  void begin_answer();

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* data, std::size_t size) override;
  ssize_t write(const char* data, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

  /// Ends the connection. Reads what still comes for a while, since a client that sends would else not get its answer.
  void close();

 private:
  using Clock = std::chrono::steady_clock;

  bool wait_for(short event) const;
  /// Fills the buffer; false at the end, at an error and beyond a limit.
  bool fill();
  /// Counts what came, from a place of the buffer on, as part of the head until its empty line has come.
  bool count_head(std::size_t first, std::size_t bytes);

  socket_t socket_;
  ConnectionLimits limits_;
  const std::atomic<bool>& is_ending_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point deadline_;
  std::array<char, 16384> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t head_bytes_ = 0;
  std::size_t line_bytes_ = 0;  // of the last line
  bool is_head_done_ = false;
  bool is_answering_ = false;
};

}  // namespace rollrig::serve
