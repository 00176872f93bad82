#pragma once
/// The request by which the calls of this thread are stopped (include/rollrig/stop.h).

namespace rollrig {

class Stop;

/// nullptr where no StopScope is there.
const Stop* current_stop();
/// Returns the one before.
const Stop* exchange_current_stop(const Stop* stop);

/// For a thread that works for another one: takes over its request.
class AdoptedStop {
 public:
  explicit AdoptedStop(const Stop* stop) : before_(exchange_current_stop(stop)) {}
  ~AdoptedStop() { exchange_current_stop(before_); }
  AdoptedStop(const AdoptedStop&) = delete;
  AdoptedStop& operator=(const AdoptedStop&) = delete;

 private:
  const Stop* before_;
};

}  // namespace rollrig
