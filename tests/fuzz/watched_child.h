#pragma once
/// Work in a child process, of which the parent learns how it ended, and by which input.

#include <functional>
#include <string>

namespace rollrig::fuzz {

constexpr std::size_t kMostInput_B = 1 << 18;

/// What the child shows the parent while it works.
class Watched {
 public:
  Watched();
  ~Watched();
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

  /// In the child: the input that it works on next, for at most so many seconds.
  void begin(const std::string& input, unsigned most_s);
  void end();

  /// Runs `work` in a child with so much memory beyond what libraries take. Empty where it returns, else how it ended.
  std::string run(const std::function<void()>& work, std::size_t most_memory_B);

  std::size_t executions() const;
  std::string last_input() const;

 private:
  struct Shared;
  Shared* shared_;
};

}  // namespace rollrig::fuzz
