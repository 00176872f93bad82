#include "estimation/road_load/road_load_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Dense>
#include <boost/math/distributions/students_t.hpp>

namespace rollrig::estimation {
namespace {

double quantile_t(double freedom) { return boost::math::quantile(boost::math::students_t(freedom), 0.975); }

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
  // Where one heading was driven after the other, a change in time and the difference of the headings are one.
  constexpr double kLeastShare = 1e-2;  // Assumed: of what runs in turn tell about the change
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> parts(X);
  parts.setThreshold(kLeastShare);
  if (parts.rank() < p) return std::nullopt;
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

/// Time of a run from one speed to a lower one, where its points lead from the one to the other.
std::optional<double> sum_times_s(const std::vector<RoadLoadPoint>& points, std::size_t run, double high_m_s,
                                  double low_m_s) {
  constexpr double kSame_m_s = 1e-6;
  double at_m_s = high_m_s;
  double sum_s = 0.0;
  for (const RoadLoadPoint& point : points) {
    if (point.run != run || std::abs(point.high_m_s - at_m_s) > kSame_m_s) continue;
    sum_s += point.duration_s;
    at_m_s = point.low_m_s;
    if (std::abs(at_m_s - low_m_s) < kSame_m_s) return sum_s;
    if (at_m_s < low_m_s) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<PairPrecision> find_precision(const RoadLoadFit& fit,
                                            const std::vector<std::array<std::size_t, 2>>& pairs, double speed_m_s) {
  constexpr double kHalf_m_s = 5.0 / 3.6;
  std::vector<double> times;
  for (const auto& [plus, minus] : pairs) {
    const std::optional<double> a = sum_times_s(fit.points, plus, speed_m_s + kHalf_m_s, speed_m_s - kHalf_m_s);
    const std::optional<double> b = sum_times_s(fit.points, minus, speed_m_s + kHalf_m_s, speed_m_s - kHalf_m_s);
    if (a.has_value() && b.has_value()) times.push_back(2.0 / (1.0 / *a + 1.0 / *b));
  }
  if (times.size() < 2) return std::nullopt;
  const double n = static_cast<double>(times.size());
  const double mean = calc_mean(times);
  double squares = 0.0;
  for (const double time : times) squares += (time - mean) * (time - mean);
  const double s = std::sqrt(squares / (n - 1.0));
  return PairPrecision{speed_m_s, static_cast<int>(times.size()), mean,
                       quantile_t(n - 1.0) * s / (std::sqrt(n) * mean)};
}

}  // namespace

double calc_mean(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())).mean();
}

std::map<std::size_t, double> find_run_deviations(const RoadLoadFit& fit) {
  std::map<std::size_t, std::pair<double, double>> sums;
  for (const RoadLoadPoint& point : fit.points) {
    const double load_N = fit.as_tested.A_N +
                          point.speed_m_s * (fit.as_tested.B_N_s_per_m + point.speed_m_s * fit.as_tested.C_N_s2_per_m2);
    if (load_N <= 0.0) continue;
    const double weight = load_N * load_N / (point.sd_N * point.sd_N);
    sums[point.run].first += weight * point.residual_N / load_N;
    sums[point.run].second += weight;
  }
  std::map<std::size_t, double> deviations;
  for (const auto& [run, sum] : sums) deviations[run] = sum.first / sum.second;
  return deviations;
}

std::vector<SessionDrift> find_session_drifts(const CoastdownData& data, const RoadLoadFit& fit) {
  const std::map<std::size_t, double> deviations = find_run_deviations(fit);
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

}  // namespace rollrig::estimation
