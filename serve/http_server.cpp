#include "serve/http_server.h"

#include <sys/socket.h>

namespace rollrig::serve {
namespace {

constexpr std::size_t kThreads = 16;          // Assumed: a browser opens six connections
constexpr std::size_t kMostConnections = 64;  // Assumed: connections that are taken and not yet looked at

}  // namespace

AnswerThreads::AnswerThreads() {
  for (std::size_t i = 0; i < kThreads; ++i) threads_.emplace_back([this] { work_off(); });
}

AnswerThreads::~AnswerThreads() { shutdown(); }

void AnswerThreads::enqueue(std::function<void()> answer) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return is_ending_ || waiting_.size() < kMostConnections; });
  waiting_.push_back(std::move(answer));
  changed_.notify_all();
}

void AnswerThreads::shutdown() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

void AnswerThreads::work_off() {
  while (true) {
    std::function<void()> answer;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
      if (waiting_.empty()) return;  // the server ends: connections that still wait are closed, as their reads fail
      answer = std::move(waiting_.front());
      waiting_.pop_front();
    }
    changed_.notify_all();
    answer();
  }
}

HttpServer::HttpServer(const ConnectionLimits& limits) : limits_(limits) {
  set_socket_options([](socket_t socket) {  // without SO_REUSEPORT: a second server on a port that is taken is refused
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  new_task_queue = [] { return new AnswerThreads; };  // NOLINT: cpp-httplib deletes it
}

void HttpServer::lengthen_queue() {
  constexpr int kMostQueued = 128;  // Assumed: the most that Linux lets wait by default, or less
  ::listen(svr_sock_, kMostQueued);
}

void HttpServer::end() {
  is_ending_ = true;
  stop();
}

bool HttpServer::process_and_close_socket(socket_t socket) {
  Connection connection(socket, limits_, is_ending_);
  bool is_closed = false;
  const bool is_answered = process_request(connection, true, is_closed, nullptr);
  connection.close();
  return is_answered;
}

}  // namespace rollrig::serve
