#pragma once
/// Work that is shared among threads and counted.

#include <cstddef>
#include <functional>

namespace rollrig::generator {

/// Called after each piece of work.
using Progress = std::function<void(std::size_t done, std::size_t of)>;

/// Does `work` on 0 to `count` - 1 as parallel_for() does. `progress` is called by one thread at a time. Ctrl-C stops
/// between two. Throws what `work` throws, and Interrupted.
void work_on_all(std::size_t count, int threads, const Progress& progress,
                 const std::function<void(std::size_t)>& work);

}  // namespace rollrig::generator
