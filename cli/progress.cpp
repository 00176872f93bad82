#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "sim/core/columns.h"
#include "sim/core/text.h"
#include "sim/core/visible.h"

namespace rollrig::cli {
namespace {

constexpr std::chrono::seconds kQuietOnTerminal{2};
constexpr std::chrono::milliseconds kBetweenUpdates{200};
constexpr std::chrono::seconds kQuietInLog{10};
constexpr std::chrono::seconds kBetweenLines{60};
constexpr std::chrono::seconds kForPrograms{1};

std::string show_duration(double duration_s) {
  return duration_s < 120.0 ? fmt::format("{:.0f} s", duration_s) : fmt::format("{:.0f} min", duration_s / 60.0);
}

}  // namespace

ProgressLine::ProgressLine(std::string label, bool quiet, ProgressReader reader)
    : label_(std::move(label)),
      active_(!quiet || reader == ProgressReader::kProgram),
      reader_(reader),
      terminal_(reader == ProgressReader::kPerson && isatty(STDERR_FILENO) != 0),
      next_(start_ + (reader == ProgressReader::kProgram ? kForPrograms
                      : terminal_                        ? kQuietOnTerminal
                                                         : kQuietInLog)) {}

ProgressLine::~ProgressLine() { clear(); }

// Overwrites with spaces, since not every terminal knows the escape sequence.
void ProgressLine::clear() {
  if (shown_ > 0) fmt::print(stderr, "\r{:{}}\r", "", shown_);
  shown_ = 0;
}

bool ProgressLine::is_due() {
  last_ = Clock::now();
  if (last_ < next_) return false;
  const Clock::duration pause = reader_ == ProgressReader::kProgram ? Clock::duration(kForPrograms)
                                : terminal_                         ? Clock::duration(kBetweenUpdates)
                                                                    : Clock::duration(kBetweenLines);
  next_ = last_ + pause;
  return true;
}

void ProgressLine::update(double done, const std::string& stage) {
  if (!active_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!(done >= done_)) start_ = Clock::now();  // it begins again, or `done` is or was NaN
  done_ = done;
  const bool is_end = done >= 1.0;  // which a person sees by the result
  if (is_end ? reader_ == ProgressReader::kPerson : !is_due()) return;
  const double elapsed_s = std::chrono::duration<double>(last_ - start_).count();
  if (reader_ == ProgressReader::kProgram) {
    if (done > 0.0) {
      fmt::print(stderr, "{{\"done\":{:.4f},\"seconds_left\":{:.1f}}}\n", done, elapsed_s * (1.0 - done) / done);
    }
    return;
  }
  std::string text = label_;
  if (done > 0.0) {
    text += fmt::format("  {:.0f} %, about {} left", 100.0 * done, show_duration(elapsed_s * (1.0 - done) / done));
  }
  if (!stage.empty()) text += "  " + stage;
  text = show_on_one_line(text);
  if (terminal_) {
    write_on_terminal(std::move(text));
  } else {
    fmt::print(stderr, "{}\n", text);
  }
  std::fflush(stderr);
}

void ProgressLine::write_on_terminal(std::string text) {
  while (count_characters(text) >= terminal_columns(STDERR_FILENO)) {  // else it would take a second line
    while ((static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.pop_back();
    text.pop_back();
  }
  clear();
  shown_ = count_characters(text);
  fmt::print(stderr, "{}", text);
}

Progress ProgressLine::callback() {
  if (!active_) return {};
  return [this](double done, const std::string& stage) { update(done, stage); };
}

}  // namespace rollrig::cli
