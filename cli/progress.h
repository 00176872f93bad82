#pragma once
/// Shows the progress of a command that takes longer than 2 s on a terminal, or 10 s in a log.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "rollrig/progress.h"

namespace rollrig::cli {

/// Who reads the progress: a person, or a program, which gets a line of JSON each second and one when all is done:
/// {"done":0.3100,"seconds_left":12.3}. `seconds_left` is null if nothing is done yet. A program gets these lines also
/// where a person wants nothing but errors.
enum class ProgressReader { kPerson, kProgram };

/// Writes to standard error. On a terminal, it updates one line, from 2 s on. Elsewhere, as in the log of a CI job, it
/// writes a line after 10 s and then one each minute.
class ProgressLine {
 public:
  ProgressLine(std::string label, bool quiet, ProgressReader reader = ProgressReader::kPerson);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the share that is done, the time that is left, and `stage`. `done` goes from 0 to 1, and is NaN where the
  /// length of the work is not known. May be called from several threads.
  void update(double done, const std::string& stage = "");
  /// Takes the line away, before a result is printed. Not while update() may be called.
  void clear();
  /// A callback for calls of the API.
  Progress callback();

 private:
  using Clock = std::chrono::steady_clock;

  /// Whether it is time for another update; notes that one was made.
  bool is_due();
  /// Writes the line for a program.
  void tell_program();
  /// Writes it each second, until the end.
  void tell_program_each_second();
  void write_on_terminal(std::string text);

  std::string label_;
  bool active_;
  ProgressReader reader_;
  bool terminal_;
  std::size_t shown_ = 0;  // characters on the terminal
  double done_ = 0.0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  Clock::time_point next_;
  std::optional<double> left_s_;  // at last_
  bool is_over_ = false;
  std::mutex mutex_;
  std::condition_variable over_;
  std::thread ticker_;  // of a program
};

}  // namespace rollrig::cli
