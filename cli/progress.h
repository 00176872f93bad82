#pragma once
/// A progress line on the terminal, for what takes longer than two seconds.

#include <chrono>
#include <mutex>
#include <string>

#include "rollrig/progress.h"

namespace rollrig::cli {

/// Writes to standard error when that is a terminal, and only once two seconds have passed.
class ProgressLine {
 public:
  ProgressLine(std::string label, bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows how far the work is, how long it will take, and `stage`: `done` goes from 0 to 1, and is NaN where the
  /// length of the work is not known. May be called from several threads.
  void update(double done, const std::string& stage = "");
  /// Takes the line away, before a result is printed.
  void clear();
  /// A callback for calls of the API.
  Progress callback();

 private:
  using Clock = std::chrono::steady_clock;

  /// Whether it is time for another update; notes that one was made.
  bool is_due();

  std::string label_;
  bool active_;
  std::size_t shown_ = 0;  // characters on the terminal
  double done_ = 0.0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  std::mutex mutex_;
};

}  // namespace rollrig::cli
