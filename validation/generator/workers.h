#pragma once
/// Work that is shared among threads.

#include <cstddef>
#include <functional>

namespace blind {

/// Does `work` on 0 to `count` - 1, on as many threads as asked for; 0: as there are cores. `progress` is told how many
/// are done and in all, by one thread at a time. What `work` throws first ends the others after what they are at, and
/// is thrown again.
void work_on_all(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work,
                 const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace blind
