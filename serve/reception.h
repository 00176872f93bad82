#pragma once
/// Connections until they have said what they want, and the threads that then answer them.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "serve/connection.h"

namespace rollrig::serve {

/// A connection takes a thread once the head of its request is in: those that say nothing keep no other out. Where too
/// many are held, the one that has been silent longest goes. Where all of them wait for a thread, no new one is taken:
/// further clients wait in the queue of the operating system, which refuses them when it is full.
class Reception {
 public:
  using Answer = std::function<void(Connection&)>;

  /// `answer` is called by several threads at once.
  explicit Reception(Answer answer);
  ~Reception() { end(); }
  Reception(const Reception&) = delete;
  Reception& operator=(const Reception&) = delete;

  void take(std::unique_ptr<Connection> connection);
  /// Lets those go that have no thread yet, and waits for the answers of the others.
  void end();

 private:
  using Connections = std::deque<std::unique_ptr<Connection>>;

  void receive();
  void work_off();
  /// Looks at the silent connections once: which have said what they want, and which are to go.
  void look_through();
  void wake() const;

  Answer answer_;
  int waker_;  // an eventfd: written to where receive() has to look anew
  std::mutex mutex_;
  std::condition_variable changed_;
  Connections silent_;  // the oldest first
  Connections ready_;
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace rollrig::serve
