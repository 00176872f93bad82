#include "estimation/road_load/road_load_checks.h"

#include <algorithm>
#include <cmath>

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

CheckStatus status_of(bool good) { return good ? CheckStatus::kPass : CheckStatus::kFail; }

/// Every value of a condition over all runs.
std::vector<double> gather(const CoastdownData& data, std::vector<double> CoastdownConditions::*member) {
  std::vector<double> all;
  for (const CoastdownRun& run : data.runs) {
    const std::vector<double>& values = run.conditions.*member;
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

RoadLoadCheck not_checked(const char* name, const std::string& why, const std::string& limit, const char* clause) {
  return {name, CheckStatus::kNotChecked, why, limit, clause};
}

void check_wind(const CoastdownData& data, std::vector<RoadLoadCheck>& checks) {
  const std::vector<double> along = gather(data, &CoastdownConditions::wind_m_s);
  const std::vector<double> across = gather(data, &CoastdownConditions::crosswind_m_s);
  const std::string mean_limit = fmt::format("<= {:.1f} m/s", kMostWind_m_s);
  const std::string peak_limit = fmt::format("<= {:.1f} m/s", kMostPeakWind_m_s);
  const std::string cross_limit = fmt::format("<= {:.1f} m/s", kMostCrosswind_m_s);
  if (along.empty()) {
    checks.push_back(not_checked("wind, mean", "no column wind_m_s", mean_limit, "SAE J1263"));
    checks.push_back(not_checked("wind, peak", "no column wind_m_s", peak_limit, "SAE J1263"));
  } else {
    std::vector<double> total = along;
    for (std::size_t i = 0; i < total.size() && across.size() == along.size(); ++i) {
      total[i] = std::hypot(along[i], across[i]);
    }
    for (double& wind : total) wind = std::abs(wind);
    const double mean = calc_mean(total);
    const double peak = *std::max_element(total.begin(), total.end());
    checks.push_back(
        {"wind, mean", status_of(mean <= kMostWind_m_s), fmt::format("{:.2f} m/s", mean), mean_limit, "SAE J1263"});
    checks.push_back(
        {"wind, peak", status_of(peak <= kMostPeakWind_m_s), fmt::format("{:.2f} m/s", peak), peak_limit, "SAE J1263"});
  }
  if (across.empty()) {
    checks.push_back(not_checked("crosswind, mean", "no column crosswind_m_s", cross_limit, "SAE J1263"));
    return;
  }
  const double cross = std::abs(calc_mean(across));
  checks.push_back({"crosswind, mean", status_of(cross <= kMostCrosswind_m_s), fmt::format("{:.2f} m/s", cross),
                    cross_limit, "SAE J1263"});
}

void check_wind_found(const RoadLoadFit& fit, std::vector<RoadLoadCheck>& checks) {
  const std::string limit = fmt::format("<= {:.1f} m/s", kMostWind_m_s);
  if (fit.winds.empty()) {
    checks.push_back(not_checked("wind from headings", "not both headings", limit, "SAE J1263"));
    return;
  }
  const auto worst = std::max_element(fit.winds.begin(), fit.winds.end(), [](const auto& a, const auto& b) {
    return std::abs(a.wind_m_s) < std::abs(b.wind_m_s);
  });
  checks.push_back({"wind from headings", status_of(std::abs(worst->wind_m_s) <= kMostWind_m_s),
                    fmt::format("{:.2f} +- {:.2f} m/s", worst->wind_m_s, worst->sd_m_s), limit, "SAE J1263"});
}

void check_slope(const CoastdownData& data, const RoadLoadFit& fit, std::vector<RoadLoadCheck>& checks) {
  const std::vector<double> slopes = gather(data, &CoastdownConditions::slope);
  const std::string limit = fmt::format("<= {:.1f} %", 100.0 * kMostSlope);
  const char* clause = "SAE J1263 7.4; 40 CFR 1066.310(b)";
  if (slopes.empty()) {
    checks.push_back(not_checked("slope", "no column slope", limit, clause));
    checks.push_back(not_checked("slope, constant", "no column slope", "within 0.2 %", "SAE J1263 7.4"));
  } else {
    const auto [low, high] = std::minmax_element(slopes.begin(), slopes.end());
    const double most = std::max(std::abs(*low), std::abs(*high));
    checks.push_back({"slope", status_of(most <= kMostSlope), fmt::format("{:.2f} %", 100.0 * most), limit, clause});
    checks.push_back({"slope, constant", status_of(*high - *low <= kMostSlopeChange),
                      fmt::format("within {:.2f} %", 100.0 * (*high - *low)), "within 0.2 %", "SAE J1263 7.4"});
  }
  if (!fit.slope.has_value()) {
    checks.push_back(not_checked("slope from headings", "not both headings", limit, clause));
    return;
  }
  checks.push_back({"slope from headings", status_of(std::abs(*fit.slope) <= kMostSlope),
                    fmt::format("{:.3f} +- {:.3f} %", 100.0 * *fit.slope, 100.0 * fit.slope_sd), limit, clause});
}

void check_ambient(const CoastdownData& data, std::vector<RoadLoadCheck>& checks) {
  const std::vector<double> ambient = gather(data, &CoastdownConditions::ambient_K);
  const std::string limit = "5 to 35 degC";
  if (ambient.empty()) {
    checks.push_back(not_checked("ambient temperature", "no column ambient_degC", limit, "SAE J1263"));
    return;
  }
  const auto [low, high] = std::minmax_element(ambient.begin(), ambient.end());
  checks.push_back({"ambient temperature", status_of(*low >= kColdest_K && *high <= kHottest_K),
                    fmt::format("{:.1f} to {:.1f} degC", *low - kZeroCelsius_K, *high - kZeroCelsius_K), limit,
                    "SAE J1263"});
}

void check_runs(const CoastdownData& data, const RoadLoadFit& fit, std::vector<RoadLoadCheck>& checks) {
  int ways[2] = {0, 0};
  for (const CoastdownRun& run : data.runs) {
    if (run.heading != 0) ++ways[run.heading > 0 ? 0 : 1];
  }
  checks.push_back({"runs each way", status_of(std::min(ways[0], ways[1]) >= kLeastRunsEachWay),
                    fmt::format("{} and {}", ways[0], ways[1]), fmt::format(">= {}", kLeastRunsEachWay),
                    "SAE J1263; J2263"});
  const bool covered =
      fit.high_m_s >= kTopSpeed_m_s - kSpeedAccuracy_m_s && fit.low_m_s <= kLowSpeed_m_s + kSpeedAccuracy_m_s;
  checks.push_back({"speed range", status_of(covered),
                    fmt::format("{:.4g} to {:.4g} km/h", 3.6 * fit.high_m_s, 3.6 * fit.low_m_s), "115 to 15 km/h",
                    "SAE J2263, scope"});
}

void check_precision(const std::vector<PairPrecision>& precisions, std::vector<RoadLoadCheck>& checks) {
  const std::string limit = fmt::format("<= {:.0f} % each", 100.0 * kMostPrecision);
  const char* clause = "UN GTR 15 Annex 4, 4.3.1.4.2";
  if (precisions.empty()) {
    checks.push_back(not_checked("repeatability of pairs", "fewer than two pairs", limit, clause));
    return;
  }
  const auto worst = std::max_element(precisions.begin(), precisions.end(),
                                      [](const auto& a, const auto& b) { return a.precision < b.precision; });
  checks.push_back({"repeatability of pairs", status_of(worst->precision <= kMostPrecision),
                    fmt::format("{:.1f} % at {:.0f} km/h", 100.0 * worst->precision, 3.6 * worst->speed_m_s), limit,
                    clause});
}

}  // namespace

RoadLoadChecks check_road_load(const CoastdownData& data, const RoadLoadFit& fit) {
  RoadLoadChecks result;
  result.drifts = find_session_drifts(data, fit);
  result.precisions = find_pair_precisions(data, fit);
  check_runs(data, fit, result.checks);
  check_precision(result.precisions, result.checks);
  check_wind(data, result.checks);
  check_wind_found(fit, result.checks);
  check_slope(data, fit, result.checks);
  check_ambient(data, result.checks);
  return result;
}

}  // namespace rollrig::estimation
