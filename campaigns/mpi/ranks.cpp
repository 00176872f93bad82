#include "campaigns/mpi/ranks.h"

#include <algorithm>
#include <exception>
#include <thread>

#include "campaigns/part.h"

#ifdef ROLLRIG_MPI
#include <mpi.h>

#include <cstdlib>
#endif

namespace rollrig::campaigns {

#ifdef ROLLRIG_MPI
Ranks::Ranks() : exceptions_(std::uncaught_exceptions()) {
  // Alone, a process needs no MPI.
  if (!is_started_for_mpi([](const char* name) -> const char* { return std::getenv(name); })) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  started_ = true;
  int rank = 0;
  int count = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  rank_ = static_cast<std::size_t>(rank);
  count_ = static_cast<std::size_t>(count);
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  int beside = 1;
  MPI_Comm_size(here, &beside);
  MPI_Comm_free(&here);
  threads_ = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / beside);
}

Ranks::~Ranks() {
  if (!started_) return;
  // After an exception the others may wait for this process: end_other_processes() is for that.
  if (std::uncaught_exceptions() > exceptions_) return;
  MPI_Finalize();
}

std::vector<std::size_t> Ranks::sum(std::vector<std::size_t> numbers) const {
  if (!started_) return numbers;
  std::vector<unsigned long long> own(numbers.begin(), numbers.end());
  std::vector<unsigned long long> all(own.size());
  MPI_Allreduce(own.data(), all.data(), static_cast<int>(own.size()), MPI_UNSIGNED_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
  return {all.begin(), all.end()};
}
void end_other_processes(int status) {
  int is_started = 0;
  int has_ended = 0;
  MPI_Initialized(&is_started);
  MPI_Finalized(&has_ended);
  if (is_started != 0 && has_ended == 0) MPI_Abort(MPI_COMM_WORLD, status);
}
#else
Ranks::Ranks() = default;
Ranks::~Ranks() = default;
std::vector<std::size_t> Ranks::sum(std::vector<std::size_t> numbers) const { return numbers; }
void end_other_processes(int) {}
#endif

}  // namespace rollrig::campaigns
