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

  /// Shows `stage` and how far the work is: `done` from 0 to 1, NaN where its length is not known; without a stage also
  /// how long it will take. May be called from several threads.
  void update(double done, const std::string& stage = "");
  /// A callback for calls of the API.
  Progress callback();

 private:
  using Clock = std::chrono::steady_clock;

  /// Whether it is time for another update; notes that one was made.
  bool is_due();

  std::string label_;
  bool active_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  std::mutex mutex_;
};

}  // namespace rollrig::cli
