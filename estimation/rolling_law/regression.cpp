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

/// Residuals of a fit with so many coefficients, and the diagonal of its hat matrix.
struct Residuals {
  Eigen::VectorXd values_N;
  Eigen::VectorXd leverages;
  double coefficients = 0.0;
};

/// The point whose residual is largest over the standard deviation that the other points give it, and the probability
/// that one of so many normal residuals is as large.
struct OddPoint {
  std::size_t place = 0;
  double chance = 1.0;
};

/// Equation  t_i = |e_i|/(s_i sqrt(1 - h_i)),  s_i^2 = (S - e_i^2/(1 - h_i))/(n - p - 1) (externally studentized);
///           chance min(1, n P(|t(n - p - 1)| > t_i)) (Bonferroni)
OddPoint find_odd_point(const Residuals& residuals) {
  const double squares_N2 = residuals.values_N.squaredNorm();
  const auto count = static_cast<double>(residuals.values_N.size());
  const double freedom = count - residuals.coefficients - 1.0;
  OddPoint odd;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < residuals.values_N.size() && freedom >= 1.0; ++i) {
    const double left = 1.0 - residuals.leverages(i);
    const double others_N2 = squares_N2 - std::pow(residuals.values_N(i), 2) / left;
    if (left <= 1e-6 || others_N2 <= 0.0) continue;
    const double student = std::abs(residuals.values_N(i)) / std::sqrt(others_N2 / freedom * left);
    if (student <= largest) continue;
    largest = student;
    odd.place = static_cast<std::size_t>(i);
  }
  if (largest <= 0.0) return odd;
  const boost::math::students_t chance(freedom);
  odd.chance = std::min(1.0, 2.0 * count * boost::math::cdf(boost::math::complement(chance, largest)));
  return odd;
}

/// Terms that a law would have beside its own, if tires did not keep to it: the force times squares and products of
/// the logarithms of pressure and load and of the speed, and its third and fourth power. Columns of unit length.
Eigen::MatrixXd make_further_terms(const std::vector<FittedPoint>& points) {
  const auto rows = static_cast<Eigen::Index>(points.size());
  Eigen::VectorXd force(rows), pressure(rows), load(rows), speed(rows);
  std::vector<double> speeds_m_s;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const FittedPoint& at = points[static_cast<std::size_t>(i)];
    force(i) = at.fitted_N;
    pressure(i) = std::log(at.point.pressure_Pa);
    load(i) = std::log(at.point.load_N);
    speed(i) = at.point.speed_m_s;
    speeds_m_s.push_back(at.point.speed_m_s);
  }
  const Eigen::ArrayXd a = pressure.array() - pressure.mean();
  const Eigen::ArrayXd b = load.array() - load.mean();
  const Eigen::ArrayXd u = speed.array() / speed.mean() - 1.0;
  std::vector<Eigen::VectorXd> terms{a * a, b * b, a * b};
  if (count_levels(speeds_m_s) > 1) terms.insert(terms.end(), {a * u, b * u, u.cube(), u.square().square()});
  Eigen::MatrixXd columns(rows, static_cast<Eigen::Index>(terms.size()));
  for (std::size_t i = 0; i < terms.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = force.cwiseProduct(terms[i]).normalized();
  }
  return columns;
}

/// A law against one with further terms.
struct FurtherFit {
  Residuals residuals;  // of the one with further terms
  double chance = 1.0;  // that points of the law show as much of them
};

/// Absent where the points leave too little freedom beside further terms.
/// Equation  F = [(S - S_f) / k] / (S_f / (n - p - k)), F distribution of k and n - p - k degrees of freedom
/// Symbols   S, S_f sums of squared residuals without and with the k further terms; n points, p coefficients
std::optional<FurtherFit> fit_further_terms(const std::vector<FittedPoint>& points, const Eigen::MatrixXd& jacobian) {
  constexpr double kLeastShare = 0.02;   // Assumed: of a term of unit length, what is neither the law nor another term
  constexpr double kLeastFreedom = 3.0;  // Assumed: with less the F test finds next to nothing
  const Eigen::Index rows = jacobian.rows();
  Eigen::VectorXd left_N(rows);
  for (Eigen::Index i = 0; i < rows; ++i) left_N(i) = points[static_cast<std::size_t>(i)].residual_N();
  const Eigen::MatrixXd own = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(jacobian).householderQ() *
                              Eigen::MatrixXd::Identity(rows, jacobian.cols());
  const Eigen::MatrixXd further = make_further_terms(points);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(further - own * (own.transpose() * further));
  const Eigen::Index terms = (qr.matrixR().diagonal().array().abs() > kLeastShare).count();
  FurtherFit found;
  found.residuals.coefficients = static_cast<double>(jacobian.cols() + terms);
  const double freedom = static_cast<double>(rows) - found.residuals.coefficients;
  if (terms < 1 || freedom < kLeastFreedom) return std::nullopt;
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(rows, terms);
  const double squares_N2 = left_N.squaredNorm();
  left_N -= own * (own.transpose() * left_N);  // what convergence left
  found.residuals.values_N = left_N - q * (q.transpose() * left_N);
  found.residuals.leverages = own.rowwise().squaredNorm() + q.rowwise().squaredNorm();
  const double rest_N2 = found.residuals.values_N.squaredNorm();
  if (!(rest_N2 > 0.0)) return std::nullopt;
  const double F = std::max(0.0, squares_N2 - rest_N2) / static_cast<double>(terms) / (rest_N2 / freedom);
  const boost::math::fisher_f chance(static_cast<double>(terms), freedom);
  found.chance = boost::math::cdf(boost::math::complement(chance, F));
  return found;
}

/// The point that stands out from the law, and still does where the law may bend; by far, whatever the bend.
std::optional<std::size_t> find_point_that_stands_out(const std::vector<FittedPoint>& points, double coefficients,
                                                      const std::optional<FurtherFit>& further) {
  constexpr double kUnlikelyOdd = 0.005;
  constexpr double kUnlikelyStill = 0.05;
  constexpr double kByFar = 1e-5;  // Assumed: t above 8 of a few dozen points, which no bend of a law reaches
  Residuals residuals{Eigen::VectorXd(points.size()), Eigen::VectorXd(points.size()), coefficients};
  for (std::size_t i = 0; i < points.size(); ++i) {
    residuals.values_N(static_cast<Eigen::Index>(i)) = points[i].residual_N();
    residuals.leverages(static_cast<Eigen::Index>(i)) = points[i].leverage;
  }
  const OddPoint odd = find_odd_point(residuals);
  if (odd.chance >= kUnlikelyOdd) return std::nullopt;
  if (!further.has_value() || odd.chance < kByFar) return odd.place;
  const OddPoint still = find_odd_point(further->residuals);
  if (still.place != odd.place || still.chance >= kUnlikelyStill) return std::nullopt;
  return odd.place;
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

std::optional<std::string> doubt_largest_residual(const std::vector<FittedPoint>& points,
                                                  const RegressionStatistics& statistics,
                                                  const Eigen::MatrixXd& jacobian) {
  constexpr double kMisses = 0.03;
  constexpr double kUnlikelyMisfit = 0.002;
  if (statistics.freedom < 1 || statistics.largest_residual <= kMisses) return std::nullopt;
  const auto share = [](const FittedPoint& at) { return std::abs(at.residual_N() / at.point.force_N); };
  const auto worst = std::max_element(points.begin(), points.end(),
                                      [&](const auto& one, const auto& other) { return share(one) < share(other); });
  const std::optional<FurtherFit> further = fit_further_terms(points, jacobian);
  if (const auto odd = find_point_that_stands_out(points, static_cast<double>(jacobian.cols()), further)) {
    const FittedPoint& point = points[*odd];
    return fmt::format(
        "{} stands out: it is {:.0f} % off the law of the other points, and bends the law of all, which misses points "
        "by up to {:.0f} %. Is its value typed right?",
        name_point(point.point),
        1e2 * point.residual_N() / (1.0 - point.leverage) /
            (point.point.force_N - point.residual_N() / (1.0 - point.leverage)),
        1e2 * share(*worst));
  }
  const bool lacks_fit = statistics.lack_of_fit.has_value() && statistics.lack_of_fit->p < kUnlikelyMisfit;
  if (further.has_value() && further->chance >= kUnlikelyMisfit && !lacks_fit) return std::nullopt;
  return fmt::format(
      "the law misses {} by {:.1f} %: it does not describe this tire over this range, or a point is wrong",
      name_point(worst->point), 1e2 * share(*worst));
}

namespace {

/// By point, the place of its set: points belong to one set if a row of points leads from one to the other, each near
/// to the next. The pressure of a tire may move from point to point.
std::vector<std::size_t> sort_into_sets(const std::vector<FittedPoint>& points) {
  constexpr double kNear = 0.02;  // Assumed
  const auto is_near = [](double a, double b) { return std::abs(a - b) <= kNear * std::max(a, b); };
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> set_of_point(points.size(), kNone);
  std::size_t sets = 0;
  for (std::size_t first = 0; first < points.size(); ++first) {
    if (set_of_point[first] != kNone) continue;
    std::vector<std::size_t> reached{first};
    set_of_point[first] = sets;
    while (!reached.empty()) {
      const RollingPoint& from = points[reached.back()].point;
      reached.pop_back();
      for (std::size_t i = 0; i < points.size(); ++i) {
        const RollingPoint& to = points[i].point;
        if (set_of_point[i] != kNone || !is_near(from.load_N, to.load_N) ||
            !is_near(from.pressure_Pa, to.pressure_Pa)) {
          continue;
        }
        set_of_point[i] = sets;
        reached.push_back(i);
      }
    }
    ++sets;
  }
  return set_of_point;
}

}  // namespace

Eigen::MatrixXd make_set_columns(const std::vector<FittedPoint>& points, const std::vector<std::size_t>& set_of_point) {
  const std::size_t sets = 1 + *std::max_element(set_of_point.begin(), set_of_point.end());
  Eigen::MatrixXd columns =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(points.size()), static_cast<Eigen::Index>(sets));
  for (std::size_t i = 0; i < points.size(); ++i) {
    columns(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(set_of_point[i])) = points[i].fitted_N;
  }
  return columns;
}

int SetScatter::find_whole_freedom() const {
  constexpr double kRounding = 1e-6;
  return static_cast<int>(std::floor(freedom + kRounding));
}

bool SetScatter::is_significant() const {
  constexpr double kPooledFrom = 0.25;
  constexpr int kLeastFreedom = 2;
  return find_whole_freedom() >= kLeastFreedom && chance < kPooledFrom && relative_sd > 0.0;
}

std::optional<SetScatter> find_set_scatter(const std::vector<FittedPoint>& points, const Eigen::MatrixXd& jacobian) {
  SetScatter found;
  found.set_of_point = sort_into_sets(points);
  const Eigen::MatrixXd columns = make_set_columns(points, found.set_of_point);
  const Eigen::ArrayXd squares_N2 = columns.colwise().squaredNorm().transpose();
  const Eigen::MatrixXd basis = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(jacobian).householderQ() *
                                Eigen::MatrixXd::Identity(jacobian.rows(), jacobian.cols());
  const Eigen::MatrixXd in_law = basis.transpose() * columns;
  const double of_law = (in_law.colwise().squaredNorm().transpose().array() / squares_N2).sum();
  const auto sets = static_cast<double>(columns.cols());
  found.freedom = sets - of_law;
  found.freedom_within = static_cast<double>(points.size()) - sets - (static_cast<double>(jacobian.cols()) - of_law);
  if (found.find_whole_freedom() < 1 || found.freedom_within < 1.0) return std::nullopt;
  Eigen::VectorXd residuals_N(jacobian.rows());
  for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
    residuals_N(i) = points[static_cast<std::size_t>(i)].residual_N();
  }
  const Eigen::ArrayXd errors = (columns.transpose() * residuals_N).array() / squares_N2;
  const double within_N2 = (residuals_N - columns * errors.matrix()).squaredNorm() / found.freedom_within;
  const double between_N2 = (errors.square() * squares_N2).sum();
  if (!(within_N2 > 0.0)) return std::nullopt;
  const Eigen::MatrixXd left_N2 = columns.transpose() * columns - in_law.transpose() * in_law;
  const double N2_per_variance = (left_N2.array().square().rowwise().sum() / squares_N2).sum();
  const boost::math::fisher_f distribution(found.freedom, found.freedom_within);
  found.set_errors.assign(errors.data(), errors.data() + errors.size());
  found.chance = boost::math::cdf(boost::math::complement(distribution, between_N2 / found.freedom / within_N2));
  found.relative_sd = std::sqrt(std::max(0.0, between_N2 - found.freedom * within_N2) / N2_per_variance);
  found.point_sd_N = std::sqrt(within_N2);
  return found;
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
