#include "sim/core/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "sim/core/current_stop.h"
#include "sim/core/interrupt.h"

#ifdef ROLLRIG_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* order);
extern "C" void __tsan_release(void* order);
#endif

namespace rollrig {
namespace {

#ifdef ROLLRIG_THREAD_SANITIZER
/// What was done before `release` is done before what follows `acquire`. TBB sees to it; this tells the thread
/// sanitizer, which does not look into TBB.
struct Order {
  void release() { __tsan_release(this); }
  void acquire() { __tsan_acquire(this); }
};
#else
struct Order {
  void release() {}
  void acquire() {}
};
#endif

/// One call of the work: after it was handed out, and before all is finished.
struct Turn {
  Turn(Order& handed_out, Order& finished_) : finished(finished_) { handed_out.acquire(); }
  ~Turn() { finished.release(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  Order& finished;
};

/// Tells the thread sanitizer, on return and on an exception, that all calls of the work are finished.
struct AcquireAtEnd {
  explicit AcquireAtEnd(Order& finished_) : finished(finished_) {}
  ~AcquireAtEnd() { finished.acquire(); }
  AcquireAtEnd(const AcquireAtEnd&) = delete;
  AcquireAtEnd& operator=(const AcquireAtEnd&) = delete;

  Order& finished;
};

/// Whether this thread does the work of a parallel_for.
thread_local bool is_at_work = false;

struct AtWork {
  AtWork() : before(std::exchange(is_at_work, true)) {}
  ~AtWork() { is_at_work = before; }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

  bool before;
};

}  // namespace

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                  const std::function<void(double)>& advance) {
  std::mutex mutex;
  std::size_t done = 0;
  Order handed_out;
  Order finished;
  const Stop* const stop = current_stop();
  const auto work_and_tell = [&, stop](std::size_t i) {
    const Turn turn(handed_out, finished);
    const AdoptedStop adopted(stop);
    throw_if_interrupted();
    {
      const AtWork at_work;
      work(i);
    }
    if (!advance) return;
    const std::lock_guard<std::mutex> lock(mutex);
    advance(static_cast<double>(++done) / static_cast<double>(count));
  };
  const auto share_out = [&] { tbb::parallel_for(std::size_t{0}, count, work_and_tell, tbb::simple_partitioner()); };
  handed_out.release();
  const AcquireAtEnd at_end(finished);
  if (is_at_work && threads != 1) {
    tbb::this_task_arena::isolate(share_out);  // else a thread that waits for its part would begin with another's
  } else {
    const int cores = tbb::info::default_concurrency();  // TBB warns of more threads than it has
    tbb::task_arena arena(threads > 0 ? std::min(threads, cores) : tbb::task_arena::automatic);
    arena.execute(share_out);
  }
}

}  // namespace rollrig
