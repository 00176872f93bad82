#include "serve/http_server.h"

#include <sys/socket.h>

namespace rollrig::serve {
namespace {

/// Hands connections on in the thread that takes them: the reception has the threads that answer.
class HandedOn : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> hand_on) override { hand_on(); }
  void shutdown() override {}
};

}  // namespace

HttpServer::HttpServer(const ConnectionLimits& limits)
    : limits_(limits), reception_([this](Connection& connection) { answer(connection); }) {
  set_socket_options([](socket_t socket) {  // without SO_REUSEPORT: a second server on a port that is taken is refused
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  new_task_queue = [] { return new HandedOn; };  // NOLINT: cpp-httplib deletes it
}

void HttpServer::lengthen_queue() {
  constexpr int kMostQueued = 128;  // Assumed: the most that Linux lets wait by default, or less
  ::listen(svr_sock_, kMostQueued);
}

void HttpServer::end() {
  is_ending_ = true;
  stop();
  reception_.end();
}

bool HttpServer::process_and_close_socket(socket_t socket) {
  reception_.take(std::make_unique<Connection>(socket, limits_, is_ending_));
  return true;
}

void HttpServer::answer(Connection& connection) {
  connection.begin_answer();
  bool is_closed = false;
  process_request(connection, true, is_closed, nullptr);
  connection.close();
}

}  // namespace rollrig::serve
