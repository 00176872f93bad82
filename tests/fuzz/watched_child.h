#pragma once
/// Runs work in a child process. The parent learns how it ended and which input ended it.

#include <cstddef>
#include <functional>
#include <string>

namespace rollrig::fuzz {

constexpr std::size_t kMostInput_B = 1 << 18;
constexpr std::size_t kMostOutcomes = 3;

/// The child process, and what it shows the parent while it works.
class Watched {
 public:
  Watched();
  ~Watched();
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

  /// In the child: the input that it works on next, for at most `most_s` of CPU time of the child itself, and 12 times
  /// as long in wall-clock time.
  void begin(const std::string& input, unsigned most_s);
  /// In the child: the input is done. `outcome` is a number below kMostOutcomes, which the parent counts.
  void end(std::size_t outcome = 0);

  /// Runs `work` in a child that may map `most_memory_B` of address space. Returns an empty string if `work` returns,
  /// else how the child ended. A child that exits by itself, even with status 0, did not come to its end.
  std::string run(const std::function<void()>& work, std::size_t most_memory_B);

  /// Inputs that are done, in all.
  std::size_t executions() const;
  std::size_t executions_with(std::size_t outcome) const;
  std::string last_input() const;

 private:
  struct Shared;
  Shared* shared_;
};

}  // namespace rollrig::fuzz
