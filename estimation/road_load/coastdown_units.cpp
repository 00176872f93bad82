#include "estimation/road_load/coastdown_units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <Eigen/QR>

#include "estimation/run_checks/robust_statistics.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

// Assumed: decelerations of coasting road vehicles, from a truck at low speed to a car at a high one
constexpr double kUsualLeast_m_s2 = 0.03, kUsualMost_m_s2 = 2.0;
// Assumed: beyond, a unit is wrong for sure
constexpr double kLeast_m_s2 = 0.005, kMost_m_s2 = 5.0;

double calc_trace_deceleration_m_s2(const CoastdownRun& run) {
  const auto top = std::max_element(run.speed_m_s.begin(), run.speed_m_s.end());
  if (top == run.speed_m_s.end()) return 0.0;
  const double lowest_m_s = *std::min_element(top, run.speed_m_s.end());
  const double quarter_m_s = 0.25 * (*top - lowest_m_s);
  if (!(quarter_m_s > 0.0)) return 0.0;
  const auto end =
      std::find_if(top, run.speed_m_s.end(), [&](double speed_m_s) { return speed_m_s <= lowest_m_s + quarter_m_s; });
  auto begin = end - 1;
  while (*begin < *top - quarter_m_s) --begin;
  const auto time_at = [&run](auto at) { return run.time_s[static_cast<std::size_t>(at - run.speed_m_s.begin())]; };
  return (*begin - *end) / (time_at(end) - time_at(begin));
}

double calc_bins_deceleration_m_s2(const CoastdownRun& run) {
  const double center_m_s = 0.5 * (run.bins.front().high_m_s + run.bins.back().low_m_s);
  constexpr double kRounding = 1e-9;  // two bins of one width have their middles at the quarters
  const double quarter_m_s = (0.25 + kRounding) * (run.bins.front().high_m_s - run.bins.back().low_m_s);
  double fall_m_s = 0.0, duration_s = 0.0;
  for (const SpeedBin& bin : run.bins) {
    if (std::abs(0.5 * (bin.high_m_s + bin.low_m_s) - center_m_s) > quarter_m_s) continue;
    fall_m_s += bin.high_m_s - bin.low_m_s;
    duration_s += bin.duration_s;
  }
  return duration_s > 0.0 ? fall_m_s / duration_s : 0.0;
}

/// In what the times may be; empty where no unit makes the deceleration a usual one.
std::string guess_time_unit(double deceleration_m_s2) {
  struct TimeUnit {
    double length_s;
    const char* name;
  };
  for (const TimeUnit& unit : {TimeUnit{60.0, "minutes"}, TimeUnit{3600.0, "hours"}, TimeUnit{1e-3, "ms"}}) {
    const double in_seconds_m_s2 = deceleration_m_s2 / unit.length_s;
    if (in_seconds_m_s2 >= kUsualLeast_m_s2 && in_seconds_m_s2 <= kUsualMost_m_s2) return unit.name;
  }
  return "";
}

/// How far decelerations are from a parabola over speed: root of the mean square, relative to their mean. Infinite
/// where one of them is not positive.
double judge_decelerations(const std::vector<SpeedBin>& bins, const std::vector<double>& durations_s) {
  const auto n = static_cast<Eigen::Index>(bins.size());
  Eigen::MatrixXd X(n, 3);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!(durations_s[at] > 0.0)) return std::numeric_limits<double>::infinity();
    const double v = 0.5 * (bins[at].high_m_s + bins[at].low_m_s);
    X.row(i) << 1.0, v, v * v;
    y(i) = (bins[at].high_m_s - bins[at].low_m_s) / durations_s[at];
  }
  const Eigen::Vector3d parabola = X.colPivHouseholderQr().solve(y);
  return std::sqrt((y - X * parabola).squaredNorm() / static_cast<double>(n)) / y.mean();
}

/// Whether the times of a run fit a coastdown as times since its beginning, and not as times through each bin.
bool looks_cumulative(const CoastdownRun& run) {
  constexpr double kClearly = 3.0;  // Assumed: by how much better
  constexpr std::size_t kFewest = 5;
  if (run.bins.size() < kFewest) return false;
  std::vector<double> durations_s, steps_s;
  for (const SpeedBin& bin : run.bins) {
    steps_s.push_back(bin.duration_s - (durations_s.empty() ? 0.0 : durations_s.back()));
    durations_s.push_back(bin.duration_s);
  }
  return kClearly * judge_decelerations(run.bins, steps_s) < judge_decelerations(run.bins, durations_s);
}

/// Throws InputError where the times through bins add up in most runs.
void require_single_durations(const CoastdownFile& file) {
  const auto& runs = file.data.runs;
  const auto cumulative = std::count_if(runs.begin(), runs.end(), &looks_cumulative);
  if (2 * static_cast<std::size_t>(cumulative) <= runs.size()) return;
  const CoastdownRun& first = *std::find_if(runs.begin(), runs.end(), &looks_cumulative);
  throw InputError({"dt_s looks as if it were the time since the beginning of each run", file.path, 0, "dt_s",
                    fmt::format("{:.4g} s in the first bin of run '{}', {:.4g} s in its last one",
                                first.bins.front().duration_s, first.id, first.bins.back().duration_s),
                    "the time through each bin alone", ""});
}

/// Time at which a run falls to a speed; none where it does not pass it.
std::optional<double> find_fall_time_s(const CoastdownRun& run, double speed_m_s) {
  const auto top = std::max_element(run.speed_m_s.begin(), run.speed_m_s.end());
  const auto at = std::find_if(top, run.speed_m_s.end(), [&](double value_m_s) { return value_m_s <= speed_m_s; });
  if (at == run.speed_m_s.end()) return std::nullopt;
  return run.time_s[static_cast<std::size_t>(at - run.speed_m_s.begin())];
}

}  // namespace

std::optional<std::string> doubt_speeds_in_m_s(const CoastdownData& data) {
  constexpr double kMostTop_km_h = 60.0, kLeastTop_km_h = 22.0;
  constexpr double kMostRatio = 1.9;
  std::vector<double> ratios;
  double top_m_s = 0.0;
  for (const CoastdownRun& run : data.runs) {
    if (run.speed_m_s.empty()) continue;
    const double highest_m_s = *std::max_element(run.speed_m_s.begin(), run.speed_m_s.end());
    top_m_s = std::max(top_m_s, highest_m_s);
    const auto fall = [&](double share) { return find_fall_time_s(run, share * highest_m_s); };
    const auto a = fall(0.95), b = fall(0.75), c = fall(0.45), d = fall(0.25);
    if (!a.has_value() || !b.has_value() || !c.has_value() || !d.has_value() || *b <= *a) continue;
    ratios.push_back((*d - *c) / (*b - *a));
  }
  const double top_km_h = kKmhPerMs * top_m_s;
  if (ratios.empty() || top_km_h > kMostTop_km_h || top_km_h < kLeastTop_km_h) return std::nullopt;
  const double ratio = calc_median(ratios);
  if (ratio <= kMostRatio) return std::nullopt;
  return fmt::format(
      "the speeds end at {:.0f}, and the vehicles slow down {:.1f} times as fast near there as at a third of it, as "
      "cars do from {:.0f} km/h on: is speed_km_h in m/s?",
      top_km_h, ratio, kKmhPerMs * top_km_h);
}

void put_speed_unit_doubt(const CoastdownData& data, std::vector<std::string>& warnings) {
  const std::optional<std::string> doubt = doubt_speeds_in_m_s(data);
  const bool is_said = std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("if they were in m/s") != std::string::npos;
  });
  if (doubt.has_value() && !is_said) warnings.insert(warnings.begin(), *doubt);
}

void require_coasting_decelerations(const CoastdownFile& file) {
  require_single_durations(file);
  std::vector<double> decelerations_m_s2;
  for (const CoastdownRun& run : file.data.runs) {
    const double found_m_s2 = run.bins.empty() ? calc_trace_deceleration_m_s2(run) : calc_bins_deceleration_m_s2(run);
    if (found_m_s2 > 0.0) decelerations_m_s2.push_back(found_m_s2);
  }
  if (decelerations_m_s2.empty()) return;
  const double median_m_s2 = calc_median(decelerations_m_s2);
  if (median_m_s2 >= kLeast_m_s2 && median_m_s2 <= kMost_m_s2) return;
  const std::string column = file.is_trace ? "time_s" : "dt_s";
  const std::string unit = guess_time_unit(median_m_s2);
  throw InputError({"the runs do not slow down as a coasting road vehicle does: " +
                        (unit.empty() ? "are times and speeds in the units of their columns?"
                                      : column + " looks as if it were in " + unit),
                    file.path, 0, column, fmt::format("{:.3g} m/s2, the median deceleration of the runs", median_m_s2),
                    fmt::format("times in s and speeds in km/h that give {:g} to {:g} m/s2; coasting road vehicles "
                                "have about {:g} to {:g}",
                                kLeast_m_s2, kMost_m_s2, kUsualLeast_m_s2, kUsualMost_m_s2),
                    ""});
}

std::string guess_speed_unit(double ratio, const std::string& column, const std::string& other, double tolerance) {
  constexpr double kKmPerMile = 3.6 * kMph_m_s;
  const auto is_near = [&](double wanted) { return std::abs(ratio / wanted - 1.0) < tolerance; };
  const auto say = [](const std::string& name, const char* unit) {
    return fmt::format("; {} looks as if it were in {}", name, unit);
  };
  if (is_near(1.0 / kKmPerMile)) return say(column, "mph");
  if (is_near(kKmPerMile)) return say(other, "mph");
  if (is_near(1.0 / kKmhPerMs)) return say(column, "m/s");
  if (is_near(kKmhPerMs)) return say(other, "m/s");
  return "";
}

}  // namespace rollrig::estimation
