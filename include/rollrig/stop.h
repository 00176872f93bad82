#pragma once
/// How one call is stopped, while others of the process go on.

#include <atomic>

#pragma GCC visibility push(default)
namespace rollrig {

/// A request to stop. It may be made from any thread, and is not taken back. For all calls of the process at once:
/// request_interrupt().
class Stop {
 public:
  void request() { is_requested_ = true; }
  bool is_requested() const { return is_requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> is_requested_{false};
};

/// As long as it lives, the calls that this thread makes end with Interrupted at their next step once `stop` is
/// requested, with all threads that they use. Within another StopScope, the inner one alone counts. `stop` has to live
/// longer.
/// Example  rollrig::Stop stop;  // another thread calls stop.request()
///          const rollrig::StopScope scope(stop);
///          run.carry_out();
class StopScope {
 public:
  explicit StopScope(const Stop& stop);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const Stop* before_;
};

}  // namespace rollrig
#pragma GCC visibility pop
