#include "validation/generator/progress.h"

#include <mutex>

#include "sim/core/interrupt.h"
#include "sim/core/parallel.h"

namespace rollrig::generator {

void work_on_all(std::size_t count, int threads, const Progress& progress,
                 const std::function<void(std::size_t)>& work) {
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(count, threads, [&](std::size_t i) {
    throw_if_interrupted();
    work(i);
    const std::lock_guard lock(mutex);
    progress(++done, count);
  });
}

}  // namespace rollrig::generator
