#pragma once
/// Runs work in a child process. The parent learns how it ended and which input ended it.

#include <functional>
#include <string>

namespace rollrig::fuzz {

constexpr std::size_t kMostInput_B = 1 << 18;

/// The child process, and what it shows the parent while it works.
class Watched {
 public:
  Watched();
  ~Watched();
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

  /// In the child: the input that it works on next, for at most so many seconds.
  void begin(const std::string& input, unsigned most_s);
  void end();

  /// Runs `work` in a child that may take `most_memory_B` beyond its libraries. Returns an empty string if `work`
  /// returns, else how the child ended.
  std::string run(const std::function<void()>& work, std::size_t most_memory_B);

  std::size_t executions() const;
  std::string last_input() const;

 private:
  struct Shared;
  Shared* shared_;
};

}  // namespace rollrig::fuzz
