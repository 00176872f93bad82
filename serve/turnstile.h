#pragma once
/// Lets a few through at a time.

#include <condition_variable>
#include <mutex>

#include "serve/refusal.h"

namespace rollrig::serve {

/// Computations that run at once; others wait, and beyond that they are refused.
class Turnstile {
 public:
  Turnstile(int most_inside, int most_waiting) : free_(most_inside), most_waiting_(most_waiting) {}

  /// One that is let through, until the object goes.
  class Pass {
   public:
    /// Throws Refusal where too many wait.
    explicit Pass(Turnstile& turnstile) : turnstile_(turnstile) { turnstile_.enter(); }
    ~Pass() { turnstile_.leave(); }
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;

   private:
    Turnstile& turnstile_;
  };

 private:
  void enter() {
    std::unique_lock<std::mutex> lock(mutex_);
    if (waiting_ >= most_waiting_) throw Refusal(503, "too many computations wait; try again");
    ++waiting_;
    changed_.wait(lock, [this] { return free_ > 0; });
    --waiting_;
    --free_;
  }
  void leave() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++free_;
    changed_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  int free_;
  int most_waiting_;
  int waiting_ = 0;
};

}  // namespace rollrig::serve
