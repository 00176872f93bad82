#include "estimation/rolling_law/regression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "sim/core/error.h"

namespace rollrig::estimation {
namespace {

bool is_same_condition(const RollingPoint& a, const RollingPoint& b) {
  constexpr double kSame = 0.005;
  const auto same = [](double x, double y) { return std::abs(x - y) <= kSame * std::max(x, y); };
  return same(a.speed_m_s, b.speed_m_s) && same(a.load_N, b.load_N) && same(a.pressure_Pa, b.pressure_Pa);
}

bool is_copy(const RollingPoint& a, const RollingPoint& b) {
  return a.speed_m_s == b.speed_m_s && a.load_N == b.load_N && a.pressure_Pa == b.pressure_Pa && a.force_N == b.force_N;
}

/// Without members that are copies of one before them: they say nothing of the scatter.
std::vector<std::size_t> drop_copies(const std::vector<FittedPoint>& points, const std::vector<std::size_t>& group) {
  std::vector<std::size_t> kept;
  for (const std::size_t i : group) {
    const bool is_new = std::none_of(kept.begin(), kept.end(),
                                     [&](std::size_t other) { return is_copy(points[other].point, points[i].point); });
    if (is_new) kept.push_back(i);
  }
  return kept;
}

/// Indices of points that share a condition with the first of their group.
std::vector<std::vector<std::size_t>> group_repeats(const std::vector<FittedPoint>& points) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<std::size_t>& members) {
      return is_same_condition(points[members.front()].point, points[i].point);
    });
    if (group == groups.end()) {
      groups.push_back({i});
    } else {
      group->push_back(i);
    }
  }
  return groups;
}

/// Scatter of the residuals within the groups, so that what the law says of slightly different conditions is out.
void put_lack_of_fit(const std::vector<FittedPoint>& points, double squares_N2, RegressionStatistics& statistics) {
  double pure_N2 = 0.0;
  int pure_freedom = 0;
  for (const std::vector<std::size_t>& all : group_repeats(points)) {
    if (all.size() < 2) continue;
    statistics.repeated_points += static_cast<int>(all.size());
    const std::vector<std::size_t> group = drop_copies(points, all);
    double mean_N = 0.0;
    for (const std::size_t i : group) mean_N += points[i].residual_N() / static_cast<double>(group.size());
    for (const std::size_t i : group) pure_N2 += std::pow(points[i].residual_N() - mean_N, 2);
    pure_freedom += static_cast<int>(group.size()) - 1;
  }
  const int lack_freedom = statistics.freedom - pure_freedom;
  if (pure_freedom < 1 || lack_freedom < 1 || pure_N2 <= 0.0) return;
  LackOfFit lack;
  lack.pure_error_freedom = pure_freedom;
  lack.pure_error_sd_N = std::sqrt(pure_N2 / pure_freedom);
  lack.F = std::max(0.0, squares_N2 - pure_N2) / lack_freedom / (pure_N2 / pure_freedom);
  lack.p = boost::math::cdf(boost::math::complement(boost::math::fisher_f(lack_freedom, pure_freedom), lack.F));
  statistics.lack_of_fit = lack;
}

/// Each residual over the standard deviation that the other points give it (externally studentized); 0 where that is
/// not known.
/// Equation  t_i = |e_i|/(s_i sqrt(1 - h_i)),  s_i^2 = (S - e_i^2/(1 - h_i))/(n - p - 1)
std::vector<double> studentize(const std::vector<FittedPoint>& points) {
  double squares_N2 = 0.0, coefficients = 0.0;
  for (const FittedPoint& point : points) {
    squares_N2 += std::pow(point.residual_N(), 2);
    coefficients += point.leverage;
  }
  const double freedom = static_cast<double>(points.size()) - std::round(coefficients) - 1.0;
  std::vector<double> students;
  for (const FittedPoint& point : points) {
    const double left = 1.0 - point.leverage;
    const double others_N2 = squares_N2 - std::pow(point.residual_N(), 2) / left;
    const bool is_known = freedom >= 1.0 && left > 1e-6 && others_N2 > 0.0;
    students.push_back(is_known ? std::abs(point.residual_N()) / std::sqrt(others_N2 / freedom * left) : 0.0);
  }
  return students;
}

}  // namespace

RegressionStatistics calc_statistics(const std::vector<FittedPoint>& points, int coefficients) {
  RegressionStatistics statistics;
  statistics.freedom = static_cast<int>(points.size()) - coefficients;
  double squares_N2 = 0.0;
  for (const FittedPoint& point : points) {
    squares_N2 += point.residual_N() * point.residual_N();
    statistics.largest_residual =
        std::max(statistics.largest_residual, std::abs(point.residual_N() / point.point.force_N));
  }
  if (statistics.freedom > 0) statistics.residual_sd_N = std::sqrt(squares_N2 / statistics.freedom);
  put_lack_of_fit(points, squares_N2, statistics);
  return statistics;
}

std::string explain_no_lack_of_fit(int repeated_points) {
  return repeated_points == 0 ? "not tested: no points are repeated"
                              : "not tested: repeated points do not scatter, or leave the law no freedom";
}

std::optional<std::string> doubt_largest_residual(const std::vector<FittedPoint>& points) {
  constexpr double kMisses = 0.03;
  constexpr double kStandsOut = 8.0;  // Assumed: of Student's t; of a few dozen points by chance less than 5
  const auto share = [](const FittedPoint& at) { return std::abs(at.residual_N() / at.point.force_N); };
  const auto worst = std::max_element(points.begin(), points.end(),
                                      [&](const auto& one, const auto& other) { return share(one) < share(other); });
  if (worst == points.end() || share(*worst) <= kMisses) return std::nullopt;
  const std::vector<double> students = studentize(points);
  const auto odd = std::max_element(students.begin(), students.end());
  if (odd != students.end() && *odd > kStandsOut) {
    const FittedPoint& point = points[static_cast<std::size_t>(odd - students.begin())];
    return fmt::format(
        "{} stands out: it is {:.0f} % off the law of the other points, and bends the law of all, which misses points "
        "by up to {:.0f} %. Is its value typed right?",
        name_point(point.point), 1e2 * point.residual_N() / (1.0 - point.leverage) /
                                     (point.point.force_N - point.residual_N() / (1.0 - point.leverage)),
        1e2 * share(*worst));
  }
  return fmt::format(
      "the law misses {} by {:.1f} %: it does not describe this tire over this range, or a point is wrong",
      name_point(worst->point), 1e2 * share(*worst));
}

Eigen::MatrixXd invert_normal(const Eigen::MatrixXd& jacobian, std::vector<double>& leverages) {
  constexpr double kUndecided = 1e-7;  // Assumed: of unit columns, what rounding leaves of a direction without effect
  const Eigen::Index count = jacobian.cols();
  const Eigen::VectorXd lengths = jacobian.colwise().norm();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(kUndecided);
  if (lengths.allFinite() && lengths.minCoeff() > 0.0) qr.compute(jacobian * lengths.cwiseInverse().asDiagonal());
  if (!lengths.allFinite() || !(lengths.minCoeff() > 0.0) || qr.rank() < count) {
    throw RunFailure("the points do not decide the coefficients: speed, load and pressure must vary independently");
  }
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(jacobian.rows(), count);
  leverages.resize(static_cast<std::size_t>(jacobian.rows()));
  for (Eigen::Index row = 0; row < jacobian.rows(); ++row) {
    leverages[static_cast<std::size_t>(row)] = q.row(row).squaredNorm();
  }
  const Eigen::MatrixXd r = qr.matrixR().topRows(count).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd of_units =
      qr.colsPermutation() * r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::MatrixXd inverse = lengths.cwiseInverse().asDiagonal() * of_units;
  return inverse * inverse.transpose();
}

double calc_student_reach(int freedom) {
  if (freedom < 1) return std::numeric_limits<double>::infinity();
  return boost::math::quantile(boost::math::students_t(freedom), 0.975);
}

ParameterEstimate make_student_estimate(const std::string& name, double value, double sd, int freedom,
                                        const std::string& unit) {
  ParameterEstimate estimate;
  estimate.name = name;
  estimate.value = value;
  estimate.sd = freedom > 0 ? sd : std::numeric_limits<double>::quiet_NaN();
  const double reach = freedom > 0 ? calc_student_reach(freedom) * sd : std::numeric_limits<double>::quiet_NaN();
  estimate.low_95 = value - reach;
  estimate.high_95 = value + reach;
  estimate.unit = unit;
  return estimate;
}

}  // namespace rollrig::estimation
