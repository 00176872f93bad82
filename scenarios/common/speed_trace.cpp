#include "scenarios/common/speed_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/core/assets.h"
#include "sim/core/csv.h"

namespace rollrig::scenarios {

double calc_distance_m(const std::vector<double>& time_s, const std::vector<double>& speed_m_s) {
  double distance_m = 0.0;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    distance_m += 0.5 * (speed_m_s[i - 1] + speed_m_s[i]) * (time_s[i] - time_s[i - 1]);
  }
  return distance_m;
}

namespace {

/// The strongest acceleration or braking of a cycle, and when it begins.
struct StrongestRate {
  double rate_m_s2 = 0.0;
  double at_s = 0.0;
};

StrongestRate find_strongest_rate(const SpeedTrace& trace) {
  StrongestRate strongest;
  for (std::size_t i = 1; i < trace.time_s.size(); ++i) {
    const double rate_m_s2 = (trace.speed_m_s[i] - trace.speed_m_s[i - 1]) / (trace.time_s[i] - trace.time_s[i - 1]);
    if (std::abs(rate_m_s2) > std::abs(strongest.rate_m_s2)) strongest = {rate_m_s2, trace.time_s[i - 1]};
  }
  return strongest;
}

}  // namespace

std::optional<std::string> doubt_acceleration(const SpeedTrace& trace) {
  constexpr double kMost_m_s2 = 10.0;
  const StrongestRate strongest = find_strongest_rate(trace);
  if (std::abs(strongest.rate_m_s2) <= kMost_m_s2) return std::nullopt;
  return fmt::format("cycle '{}' asks for {:.3g} m/s2 from time_s = {:g} on, which no car does: are its times in s?",
                     trace.name, strongest.rate_m_s2, strongest.at_s);
}

std::optional<std::string> doubt_slowness(const SpeedTrace& trace) {
  constexpr double kLeast_m_s2 = 0.02, kMoves_m_s = 5.0;
  const double most_m_s2 = std::abs(find_strongest_rate(trace).rate_m_s2);
  const auto [slowest, fastest] = std::minmax_element(trace.speed_m_s.begin(), trace.speed_m_s.end());
  if (most_m_s2 >= kLeast_m_s2 || *fastest - *slowest < kMoves_m_s) return std::nullopt;
  return fmt::format(
      "cycle '{}' lasts {:.3g} h and never changes its speed by more than {:.2g} m/s2: are its times in s, and not in "
      "ms?",
      trace.name, (trace.time_s.back() - trace.time_s.front()) / 3600.0, most_m_s2);
}

std::optional<std::string> doubt_hole(const SpeedTrace& trace) {
  constexpr double kMostFactor = 20.0;
  constexpr double kRegularShare = 0.9, kSame = 0.01;
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < trace.time_s.size(); ++i) steps_s.push_back(trace.time_s[i] - trace.time_s[i - 1]);
  std::vector<double> sorted = steps_s;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double usual_s = sorted[sorted.size() / 2];
  const auto regular = std::count_if(steps_s.begin(), steps_s.end(),
                                     [&](double step_s) { return std::abs(step_s / usual_s - 1.0) <= kSame; });
  const auto longest = std::max_element(steps_s.begin(), steps_s.end());
  if (static_cast<double>(regular) < kRegularShare * static_cast<double>(steps_s.size())) return std::nullopt;
  if (*longest < kMostFactor * usual_s) return std::nullopt;
  return fmt::format(
      "cycle '{}' has a row every {:g} s, but none for {:g} s after time_s = {:g}: a straight line joins the speeds on "
      "both sides of the hole",
      trace.name, usual_s, *longest, trace.time_s[static_cast<std::size_t>(longest - steps_s.begin())]);
}

std::vector<std::string> doubt_trace(const SpeedTrace& trace) {
  std::vector<std::string> doubts;
  for (const auto& doubt : {doubt_acceleration(trace), doubt_slowness(trace), doubt_hole(trace)}) {
    if (doubt.has_value()) doubts.push_back(*doubt);
  }
  return doubts;
}

SpeedTrace read_speed_trace(const std::string& name_or_path) {
  const std::string path = find_asset("cycles", name_or_path);
  const CsvTable csv = CsvTable::read(path);
  csv.require_known({"time_s", "speed_km_h"});
  SpeedTrace trace;
  trace.name = std::filesystem::path(path).stem().string();
  trace.time_s = csv.increasing_times("time_s");
  if (csv.row_count() < 2) {
    throw InputError({"a cycle of one row goes nowhere", path, csv.line_of(0), "time_s", "", "two rows at least", ""});
  }
  trace.speed_m_s = csv.numbers({"speed_km_h", between(0.0, 400.0), "speed"});
  if (*std::max_element(trace.speed_m_s.begin(), trace.speed_m_s.end()) <= 0.0) {
    throw InputError({"a cycle that never moves", path, csv.line_of(0), "speed_km_h", "", "a speed above 0", ""});
  }
  return trace;
}

}  // namespace rollrig::scenarios
