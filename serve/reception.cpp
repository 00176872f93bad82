#include "serve/reception.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>

#include "sim/core/error.h"

namespace rollrig::serve {
namespace {

constexpr std::size_t kAnswerThreads = 16;  // Assumed: a browser opens six connections
constexpr std::size_t kMostHeld = 256;      // Assumed: connections that have no thread yet

}  // namespace

Reception::Reception(Answer answer) : answer_(std::move(answer)), waker_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (waker_ < 0) throw RunFailure("the operating system gives no handle for the connections of the server");
  threads_.emplace_back([this] { receive(); });
  for (std::size_t i = 0; i < kAnswerThreads; ++i) threads_.emplace_back([this] { work_off(); });
}

void Reception::wake() const {
  const std::uint64_t one = 1;
  // It cannot be full: receive() empties it.
  if (::write(waker_, &one, sizeof one) < 0) return;
}

void Reception::take(std::unique_ptr<Connection> connection) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto has_room = [this] { return silent_.size() + ready_.size() < kMostHeld || !silent_.empty(); };
  changed_.wait(lock, [&] { return is_ending_ || has_room(); });
  if (is_ending_) return;
  if (silent_.size() + ready_.size() >= kMostHeld) silent_.pop_front();
  silent_.push_back(std::move(connection));
  wake();
}

void Reception::end() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
    silent_.clear();
    ready_.clear();
  }
  changed_.notify_all();
  wake();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
  if (waker_ >= 0) ::close(waker_);
  waker_ = -1;
}

void Reception::receive() {
  constexpr int kBetweenLooks_ms = 100;  // for what takes too long
  while (true) {
    std::vector<pollfd> polled{{waker_, POLLIN, 0}};
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (is_ending_) return;
      for (const auto& connection : silent_) polled.push_back({connection->socket(), POLLIN, 0});
    }
    ::poll(polled.data(), polled.size(), polled.size() > 1 ? kBetweenLooks_ms : -1);
    std::uint64_t ignored = 0;
    if (::read(waker_, &ignored, sizeof ignored) < 0) ignored = 0;  // nothing was written
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_ending_) return;
    look_through();
  }
}

void Reception::look_through() {
  Connections still_silent;
  for (auto& connection : silent_) {
    const HeadState state = connection->receive_head();
    if (state == HeadState::kReady) ready_.push_back(std::move(connection));
    if (state == HeadState::kSilent) still_silent.push_back(std::move(connection));
  }
  silent_ = std::move(still_silent);
  changed_.notify_all();
}

void Reception::work_off() {
  while (true) {
    std::unique_ptr<Connection> connection;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return is_ending_ || !ready_.empty(); });
      if (is_ending_) return;
      connection = std::move(ready_.front());
      ready_.pop_front();
    }
    changed_.notify_all();
    answer_(*connection);
  }
}

}  // namespace rollrig::serve
