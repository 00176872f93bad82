#pragma once
/// Work on several threads whose result does not depend on how many there are.

#include <cstddef>
#include <functional>

namespace rollrig {

/// Calls work(0) .. work(count - 1), on up to `threads` threads (0: as many as the machine has). Each
/// call must touch only what belongs to its own index. The first exception is passed on. `advance` is called after
/// each, one call at a time, with the share that is done. Ctrl-C stops between two calls (Interrupted).
/// Within `work` it shares the threads of the outer one: those that have nothing left to do there help.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                  const std::function<void(double)>& advance = {});

}  // namespace rollrig
