#pragma once
/// cpp-httplib with the limits that it lacks: on the time and size of a request, and on what waits.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "serve/connection.h"
#include "serve/http.h"

namespace rollrig::serve {

/// Threads that answer connections. Where too many wait, the server takes no new one until one is answered: further
/// clients wait in the queue of the operating system, which refuses them when it is full.
class AnswerThreads : public httplib::TaskQueue {
 public:
  AnswerThreads();
  ~AnswerThreads() override;
  AnswerThreads(const AnswerThreads&) = delete;
  AnswerThreads& operator=(const AnswerThreads&) = delete;

  void enqueue(std::function<void()> answer) override;
  void shutdown() override;

 private:
  void work_off();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

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

  ConnectionLimits limits_;
  std::atomic<bool> is_ending_{false};
};

}  // namespace rollrig::serve
