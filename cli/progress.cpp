#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace rollrig::cli {
namespace {

constexpr std::chrono::seconds kQuietFor{2};
constexpr std::chrono::milliseconds kBetweenUpdates{200};

}  // namespace

ProgressLine::ProgressLine(std::string label, bool quiet)
    : label_(std::move(label)), active_(!quiet && isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

bool ProgressLine::is_due() {
  const Clock::time_point now = Clock::now();
  if (now - start_ < kQuietFor || now - last_ < kBetweenUpdates) return false;
  last_ = now;
  return true;
}

void ProgressLine::update(double done, const std::string& stage) {
  if (!active_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!is_due()) return;
  const double elapsed_s = std::chrono::duration<double>(last_ - start_).count();
  const std::string left = fmt::format("about {:.0f} s left", done > 0.0 ? elapsed_s * (1.0 - done) / done : 0.0);
  const std::string share = std::isnan(done) ? "" : fmt::format("{:3.0f} %  ", 100.0 * done);
  shown_ = true;
  fmt::print(stderr, "\r\033[K{}  {}{}", label_, share, stage.empty() ? left : stage);
  std::fflush(stderr);
}

Progress ProgressLine::callback() {
  if (!active_) return {};
  return [this](double done, const std::string& stage) { update(done, stage); };
}

}  // namespace rollrig::cli
