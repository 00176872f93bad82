#pragma once
/// Progress of what takes longer than two seconds on a terminal, and than ten seconds in a log.

#include <chrono>
#include <mutex>
#include <string>

#include "rollrig/progress.h"

namespace rollrig::cli {

/// Writes to standard error. On a terminal, one line that is updated, once two seconds have passed. Elsewhere, as in
/// the log of a CI job, a new line once ten seconds have passed, and then one a minute.
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
  void write_on_terminal(std::string text);

  std::string label_;
  bool active_;
  bool terminal_;
  std::size_t shown_ = 0;  // characters on the terminal
  double done_ = 0.0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  Clock::time_point next_;
  std::mutex mutex_;
};

}  // namespace rollrig::cli
