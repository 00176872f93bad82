#include "sim/core/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <mutex>

#include "sim/core/interrupt.h"

namespace rollrig {

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                  const std::function<void(double)>& advance) {
  std::mutex mutex;
  std::size_t done = 0;
  const auto work_and_tell = [&](std::size_t i) {
    throw_if_interrupted();
    work(i);
    if (!advance) return;
    const std::lock_guard<std::mutex> lock(mutex);
    advance(static_cast<double>(++done) / static_cast<double>(count));
  };
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, work_and_tell, tbb::simple_partitioner()); });
}

}  // namespace rollrig
