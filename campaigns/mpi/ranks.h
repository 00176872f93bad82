#pragma once
/// The processes that mpirun started, which share the work; one alone where it did not, or was not built in.

#include <cstddef>
#include <vector>

namespace rollrig::campaigns {

/// MPI for as long as the object lives. Not copied; one at a time.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  std::size_t rank() const { return rank_; }
  std::size_t count() const { return count_; }
  bool is_first() const { return rank_ == 0; }
  /// Threads for this process where nothing else is said: the cores that it may use, shared with its like on the
  /// same machine.
  int threads() const { return threads_; }
  /// Leaves the others, without waiting for them at the end.
  void abandon() { started_ = false; }
  /// Sums of each number over all processes; waits for them.
  std::vector<std::size_t> sum(std::vector<std::size_t> numbers) const;

 private:
  std::size_t rank_ = 0;
  std::size_t count_ = 1;
  int threads_ = 0;
  bool started_ = false;
  int exceptions_ = 0;
};

/// After a failure of this process, ends the others, which may wait for it. To be called at the end of a program, once
/// the failure is told. Does nothing where MPI was not started, or has ended.
void end_other_processes(int status);

}  // namespace rollrig::campaigns
