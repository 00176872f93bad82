#include "estimation/road_load/road_load_checks.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <Eigen/Dense>
#include <boost/math/distributions/students_t.hpp>

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

double quantile_t(double freedom) { return boost::math::quantile(boost::math::students_t(freedom), 0.975); }

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

double mean_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())).mean();
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
    const double mean = mean_of(total);
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
  const double cross = std::abs(mean_of(across));
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

/// Runs by session, in the order of their start.
std::map<std::string, std::vector<std::size_t>> sort_sessions(const CoastdownData& data) {
  std::map<std::string, std::vector<std::size_t>> sessions;
  for (std::size_t i = 0; i < data.runs.size(); ++i) sessions[data.runs[i].session].push_back(i);
  for (auto& [session, runs] : sessions) {
    const bool timed =
        std::all_of(runs.begin(), runs.end(), [&](std::size_t i) { return data.runs[i].start_s.has_value(); });
    if (!timed) continue;
    std::stable_sort(runs.begin(), runs.end(),
                     [&](std::size_t a, std::size_t b) { return *data.runs[a].start_s < *data.runs[b].start_s; });
  }
  return sessions;
}

/// Mean relative deviation of each run that has points.
std::map<std::size_t, double> find_deviations(const RoadLoadFit& fit) {
  std::map<std::size_t, std::pair<double, double>> sums;
  for (const RoadLoadPoint& point : fit.points) {
    const double weight = point.fit_N * point.fit_N / (point.sd_N * point.sd_N);
    sums[point.run].first += weight * point.residual_N / point.fit_N;
    sums[point.run].second += weight;
  }
  std::map<std::size_t, double> deviations;
  for (const auto& [run, sum] : sums) deviations[run] = sum.first / sum.second;
  return deviations;
}

std::optional<SessionDrift> fit_drift(const CoastdownData& data, const std::vector<std::size_t>& runs,
                                      const std::map<std::size_t, double>& deviations) {
  std::vector<std::size_t> used;
  bool timed = true;
  int ways[2] = {0, 0};
  for (const std::size_t i : runs) {
    if (deviations.count(i) == 0) continue;
    used.push_back(i);
    timed = timed && data.runs[i].start_s.has_value();
    ++ways[data.runs[i].heading >= 0 ? 0 : 1];
  }
  const bool both = std::min(ways[0], ways[1]) > 0;
  const auto n = static_cast<Eigen::Index>(used.size());
  const Eigen::Index p = both ? 4 : 2;
  if (n < p + 2) return std::nullopt;
  Eigen::MatrixXd X(n, p);
  Eigen::VectorXd y(n);
  const auto position = [&](std::size_t k) { return timed ? *data.runs[used[k]].start_s : static_cast<double>(k); };
  const double first = position(0);
  const double length = position(used.size() - 1) - first;
  if (length <= 0.0) return std::nullopt;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double x = (position(at) - first) / length - 0.5;
    const double h = data.runs[used[at]].heading;
    X(k, 0) = 1.0;
    X(k, 1) = x;
    if (both) {
      X(k, 2) = h;
      X(k, 3) = h * x;
    }
    y(k) = deviations.at(used[at]);
  }
  const Eigen::MatrixXd inverse = (X.transpose() * X).inverse();
  const Eigen::VectorXd beta = inverse * X.transpose() * y;
  const double freedom = static_cast<double>(n - p);
  const double variance = (y - X * beta).squaredNorm() / freedom;
  const double reach = quantile_t(freedom) * std::sqrt(variance * inverse(1, 1));
  SessionDrift drift;
  drift.session = data.runs[used[0]].session;
  drift.runs = static_cast<int>(n);
  drift.time_change = -beta(1);
  drift.lower_95 = drift.time_change - reach;
  drift.upper_95 = drift.time_change + reach;
  drift.per_run = drift.time_change / static_cast<double>(n - 1);
  return drift;
}

/// Time of a run from `high` to `low`, where its points lead from the one to the other.
std::optional<double> chain_s(const std::vector<RoadLoadPoint>& points, std::size_t run, double high, double low) {
  constexpr double kSame_m_s = 1e-6;
  double at = high;
  double sum = 0.0;
  for (const RoadLoadPoint& point : points) {
    if (point.run != run || std::abs(point.high_m_s - at) > kSame_m_s) continue;
    sum += point.duration_s;
    at = point.low_m_s;
    if (std::abs(at - low) < kSame_m_s) return sum;
    if (at < low) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<PairPrecision> find_precision(const RoadLoadFit& fit,
                                            const std::vector<std::array<std::size_t, 2>>& pairs, double speed) {
  constexpr double kHalf_m_s = 5.0 / 3.6;
  std::vector<double> times;
  for (const auto& [plus, minus] : pairs) {
    const std::optional<double> a = chain_s(fit.points, plus, speed + kHalf_m_s, speed - kHalf_m_s);
    const std::optional<double> b = chain_s(fit.points, minus, speed + kHalf_m_s, speed - kHalf_m_s);
    if (a.has_value() && b.has_value()) times.push_back(2.0 / (1.0 / *a + 1.0 / *b));
  }
  if (times.size() < 2) return std::nullopt;
  const double n = static_cast<double>(times.size());
  const double mean = mean_of(times);
  double squares = 0.0;
  for (const double time : times) squares += (time - mean) * (time - mean);
  const double s = std::sqrt(squares / (n - 1.0));
  return PairPrecision{speed, static_cast<int>(times.size()), mean, quantile_t(n - 1.0) * s / (std::sqrt(n) * mean)};
}

}  // namespace

std::vector<SessionDrift> find_session_drifts(const CoastdownData& data, const RoadLoadFit& fit) {
  const std::map<std::size_t, double> deviations = find_deviations(fit);
  std::vector<SessionDrift> drifts;
  for (const auto& [session, runs] : sort_sessions(data)) {
    const std::optional<SessionDrift> drift = fit_drift(data, runs, deviations);
    if (drift.has_value()) drifts.push_back(*drift);
  }
  return drifts;
}

std::vector<PairPrecision> find_pair_precisions(const CoastdownData& data, const RoadLoadFit& fit) {
  std::vector<std::array<std::size_t, 2>> pairs;
  for (const auto& [session, runs] : sort_sessions(data)) {
    std::vector<std::size_t> plus, minus;
    for (const std::size_t i : runs) {
      if (data.runs[i].heading != 0) (data.runs[i].heading > 0 ? plus : minus).push_back(i);
    }
    for (std::size_t i = 0; i < std::min(plus.size(), minus.size()); ++i) pairs.push_back({plus[i], minus[i]});
  }
  std::vector<PairPrecision> precisions;
  for (const int step_km_h : {10, 5}) {
    for (int km_h = 200; km_h > 5; km_h -= step_km_h) {
      const std::optional<PairPrecision> found = find_precision(fit, pairs, km_h / 3.6);
      if (found.has_value()) precisions.push_back(*found);
    }
    if (!precisions.empty()) break;
  }
  return precisions;
}

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
