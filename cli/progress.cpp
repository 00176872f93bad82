#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
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
      next_(start_ + (terminal_ ? kQuietOnTerminal : kQuietInLog)) {
  if (reader_ == ProgressReader::kProgram) ticker_ = std::thread([this] { tell_program_each_second(); });
}

ProgressLine::~ProgressLine() {
  if (ticker_.joinable()) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_over_ = true;
    }
    over_.notify_all();
    ticker_.join();
  }
  clear();
}

void ProgressLine::tell_program() {
  std::string left = "null";
  if (left_s_.has_value()) {
    const double since_s = std::chrono::duration<double>(Clock::now() - last_).count();
    left = fmt::format("{:.1f}", std::max(0.0, *left_s_ - since_s));
  }
  fmt::print(stderr, "{{\"done\":{:.4f},\"seconds_left\":{}}}\n", done_, left);
  std::fflush(stderr);
}

void ProgressLine::tell_program_each_second() {
  std::unique_lock<std::mutex> lock(mutex_);
  Clock::time_point next = start_ + kForPrograms;
  while (!over_.wait_until(lock, next, [this] { return is_over_ || done_ >= 1.0; })) {
    tell_program();
    next += kForPrograms;
  }
}

// Overwrites with spaces, since not every terminal knows the escape sequence.
void ProgressLine::clear() {
  if (shown_ > 0) fmt::print(stderr, "\r{:{}}\r", "", shown_);
  shown_ = 0;
}

bool ProgressLine::is_due() {
  last_ = Clock::now();
  if (last_ < next_) return false;
  next_ = last_ + (terminal_ ? Clock::duration(kBetweenUpdates) : Clock::duration(kBetweenLines));
  return true;
}

void ProgressLine::update(double done, const std::string& stage) {
  if (!active_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!(done >= done_)) start_ = Clock::now();  // it begins again, or `done` is or was NaN
  const bool was_over = done_ >= 1.0;
  done_ = done;
  if (reader_ == ProgressReader::kProgram) {
    last_ = Clock::now();
    const double elapsed_s = std::chrono::duration<double>(last_ - start_).count();
    left_s_ = done > 0.0 ? std::optional(elapsed_s * (1.0 - done) / done) : std::nullopt;
    if (done >= 1.0 && !was_over) {
      tell_program();
      over_.notify_all();
    }
    return;
  }
  if (done >= 1.0 || !is_due()) return;  // a person sees the end by the result
  const double elapsed_s = std::chrono::duration<double>(last_ - start_).count();
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
