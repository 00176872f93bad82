#include "estimation/road_load/road_load_checks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

// Limits. Those of J1263 and of J2263 from public summaries and from 40 CFR 1066.310; see docs/fit_road_load.md.
constexpr double kColdest_K = kZeroCelsius_K + 5.0;
constexpr double kHottest_K = kZeroCelsius_K + 35.0;
constexpr double kMostWind_m_s = 16.0 / 3.6;
constexpr double kMostPeakWind_m_s = 20.0 / 3.6;
constexpr double kMostCrosswind_m_s = 8.0 / 3.6;
constexpr double kMostSlope = 0.005;
constexpr double kMostSlopeChange = 0.002;  // constant within 0.1 % to either side
constexpr int kLeastRunsEachWay = 5;
constexpr double kMostPrecision = 0.03;
constexpr double kTopSpeed_m_s = 115.0 / 3.6;
constexpr double kLowSpeed_m_s = 15.0 / 3.6;
constexpr double kSpeedAccuracy_m_s = 0.2 / 3.6;  // that J2263 asks of the sensor

/// What the data say of a limit.
struct Found {
  bool is_within = false;
  std::string text;
};

/// A check. Where nothing was found, `missing` says why.
RoadLoadCheck check(const char* name, const std::optional<Found>& found, const char* missing, const std::string& limit,
                    const char* clause) {
  if (!found.has_value()) return {name, CheckStatus::kNotChecked, missing, limit, clause};
  return {name, found->is_within ? CheckStatus::kPass : CheckStatus::kFail, found->text, limit, clause};
}

/// Every value of a condition over all runs.
std::vector<double> gather(const CoastdownData& data, std::vector<double> CoastdownConditions::*member) {
  std::vector<double> all;
  for (const CoastdownRun& run : data.runs) {
    const std::vector<double>& values = run.conditions.*member;
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

void check_wind(const CoastdownData& data, std::vector<RoadLoadCheck>& checks) {
  std::vector<double> total_m_s = gather(data, &CoastdownConditions::wind_m_s);
  const std::vector<double> across_m_s = gather(data, &CoastdownConditions::crosswind_m_s);
  const bool has_both = across_m_s.size() == total_m_s.size();
  for (std::size_t i = 0; i < total_m_s.size(); ++i) {
    total_m_s[i] = std::hypot(total_m_s[i], has_both ? across_m_s[i] : 0.0);
  }
  const auto judge = [](double wind_m_s, double most_m_s) {
    return Found{wind_m_s <= most_m_s, fmt::format("{:.2f} m/s", wind_m_s)};
  };
  std::optional<Found> mean, peak, cross;
  if (!total_m_s.empty()) {
    mean = judge(calc_mean(total_m_s), kMostWind_m_s);
    peak = judge(*std::max_element(total_m_s.begin(), total_m_s.end()), kMostPeakWind_m_s);
  }
  if (!across_m_s.empty()) cross = judge(std::abs(calc_mean(across_m_s)), kMostCrosswind_m_s);
  const auto limit = [](double most_m_s) { return fmt::format("<= {:.1f} m/s", most_m_s); };
  checks.push_back(check("wind, mean", mean, "no column wind_m_s", limit(kMostWind_m_s), "SAE J1263"));
  checks.push_back(check("wind, peak", peak, "no column wind_m_s", limit(kMostPeakWind_m_s), "SAE J1263"));
  checks.push_back(check("crosswind, mean", cross, "no column crosswind_m_s", limit(kMostCrosswind_m_s), "SAE J1263"));
}

void check_wind_found(const RoadLoadFit& fit, std::vector<RoadLoadCheck>& checks) {
  std::optional<Found> found;
  if (!fit.winds.empty()) {
    const auto worst = std::max_element(fit.winds.begin(), fit.winds.end(), [](const auto& a, const auto& b) {
      return std::abs(a.wind_m_s) < std::abs(b.wind_m_s);
    });
    found = Found{std::abs(worst->wind_m_s) <= kMostWind_m_s,
                  fmt::format("{:.2f} +- {:.2f} m/s", worst->wind_m_s, worst->sd_m_s)};
  }
  checks.push_back(check("wind from headings", found, "not both headings", fmt::format("<= {:.1f} m/s", kMostWind_m_s),
                         "SAE J1263"));
}

constexpr const char* kSlopeClause = "SAE J1263 7.4; 40 CFR 1066.310(b)";

std::string limit_slope() { return fmt::format("<= {:.1f} %", 100.0 * kMostSlope); }

void check_slope_found(const RoadLoadFit& fit, std::vector<RoadLoadCheck>& checks) {
  std::optional<Found> from_headings;
  if (fit.slope.has_value()) {
    from_headings = Found{std::abs(*fit.slope) <= kMostSlope,
                          fmt::format("{:.3f} +- {:.3f} %", 100.0 * *fit.slope, 100.0 * fit.slope_sd)};
  }
  checks.push_back(check("slope from headings", from_headings, "not both headings", limit_slope(), kSlopeClause));
}

void check_ambient(const CoastdownData& data, std::vector<RoadLoadCheck>& checks) {
  const std::vector<double> ambient = gather(data, &CoastdownConditions::ambient_K);
  std::optional<Found> found;
  if (!ambient.empty()) {
    const auto [low, high] = std::minmax_element(ambient.begin(), ambient.end());
    found = Found{*low >= kColdest_K && *high <= kHottest_K,
                  fmt::format("{:.1f} to {:.1f} degC", *low - kZeroCelsius_K, *high - kZeroCelsius_K)};
  }
  checks.push_back(check("ambient temperature", found, "no column ambient_degC", "5 to 35 degC", "SAE J1263"));
}

void check_runs(const CoastdownData& data, const RoadLoadFit& fit, std::vector<RoadLoadCheck>& checks) {
  int ways[2] = {0, 0};
  for (const CoastdownRun& run : data.runs) {
    if (run.heading != 0) ++ways[run.heading > 0 ? 0 : 1];
  }
  const Found runs{std::min(ways[0], ways[1]) >= kLeastRunsEachWay, fmt::format("{} and {}", ways[0], ways[1])};
  checks.push_back(check("runs each way", runs, "", fmt::format(">= {}", kLeastRunsEachWay), "SAE J1263; J2263"));
  const Found speeds{
      fit.high_m_s >= kTopSpeed_m_s - kSpeedAccuracy_m_s && fit.low_m_s <= kLowSpeed_m_s + kSpeedAccuracy_m_s,
      fmt::format("{:.4g} to {:.4g} km/h", 3.6 * fit.high_m_s, 3.6 * fit.low_m_s)};
  checks.push_back(check("speed range", speeds, "", "115 to 15 km/h", "SAE J2263, scope"));
}

void check_precision(const std::vector<PairPrecision>& precisions, std::vector<RoadLoadCheck>& checks) {
  std::optional<Found> found;
  if (!precisions.empty()) {
    const auto worst = std::max_element(precisions.begin(), precisions.end(),
                                        [](const auto& a, const auto& b) { return a.precision < b.precision; });
    found = Found{worst->precision <= kMostPrecision,
                  fmt::format("{:.1f} % at {:.0f} km/h", 100.0 * worst->precision, 3.6 * worst->speed_m_s)};
  }
  checks.push_back(check("repeatability of pairs", found, "fewer than two pairs",
                         fmt::format("<= {:.0f} % each", 100.0 * kMostPrecision), "UN GTR 15 Annex 4, 4.3.1.4.2"));
}

}  // namespace

void check_slopes(const CoastdownData& data, std::vector<RoadLoadCheck>& checks) {
  const std::vector<double> slopes = gather(data, &CoastdownConditions::slope);
  std::optional<Found> most, change;
  if (!slopes.empty()) {
    const auto [low, high] = std::minmax_element(slopes.begin(), slopes.end());
    const double steepest = std::max(std::abs(*low), std::abs(*high));
    most = Found{steepest <= kMostSlope, fmt::format("{:.2f} %", 100.0 * steepest)};
    change = Found{*high - *low <= kMostSlopeChange, fmt::format("within {:.2f} %", 100.0 * (*high - *low))};
  }
  checks.push_back(check("slope", most, "no column slope", limit_slope(), kSlopeClause));
  checks.push_back(check("slope, constant", change, "no column slope", "within 0.2 %", "SAE J1263 7.4"));
}

std::optional<std::string> doubt_ambient(const CoastdownData& data) {
  constexpr double kMost_degC = 40.0;
  const std::vector<double> ambient_K = gather(data, &CoastdownConditions::ambient_K);
  if (ambient_K.empty()) return std::nullopt;
  const double mean_degC = calc_mean(ambient_K) - kZeroCelsius_K;
  if (mean_degC <= kMost_degC) return std::nullopt;
  return fmt::format(
      "the air was at {:.1f} degC on average, where the procedures end at 35: is ambient_degC in degrees Fahrenheit "
      "({:.1f} degC then)? The correction to reference conditions rests on it",
      mean_degC, (mean_degC - 32.0) / 1.8);
}

RoadLoadChecks check_road_load(const CoastdownData& data, const RoadLoadFit& fit) {
  RoadLoadChecks result;
  result.drifts = find_session_drifts(data, fit);
  result.precisions = find_pair_precisions(data, fit);
  check_runs(data, fit, result.checks);
  check_precision(result.precisions, result.checks);
  check_wind(data, result.checks);
  check_wind_found(fit, result.checks);
  check_slopes(data, result.checks);
  check_slope_found(fit, result.checks);
  check_ambient(data, result.checks);
  return result;
}

}  // namespace rollrig::estimation
