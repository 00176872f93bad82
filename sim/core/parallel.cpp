#include "sim/core/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rollrig {

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, work, tbb::simple_partitioner()); });
}

}  // namespace rollrig
