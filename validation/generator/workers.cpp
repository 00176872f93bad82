#include "validation/generator/workers.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "validation/generator/interrupt.h"

namespace blind {

void work_on_all(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work,
                 const std::function<void(std::size_t, std::size_t)>& progress) {
  std::mutex mutex;
  std::size_t next = 0;
  std::size_t done = 0;
  std::exception_ptr failure;
  const auto take = [&](std::size_t& mine) {
    const std::lock_guard lock(mutex);
    mine = next;
    return failure == nullptr && next++ < count;
  };
  const auto work_on = [&](std::size_t mine) {
    try {
      throw_if_interrupted();
      work(mine);
      const std::lock_guard lock(mutex);
      progress(++done, count);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (failure == nullptr) failure = std::current_exception();
    }
  };
  const std::size_t asked = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::thread> workers;
  for (std::size_t i = 0; i < std::min(asked, count); ++i) {
    workers.emplace_back([&] {
      for (std::size_t mine = 0; take(mine);) work_on(mine);
    });
  }
  for (std::thread& worker : workers) worker.join();
  if (failure != nullptr) std::rethrow_exception(failure);
}

}  // namespace blind
