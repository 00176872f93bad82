#include "estimation/rolling_law/j2452_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <boost/math/constants/constants.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/minima.hpp>

#include "estimation/least_squares/least_squares.h"
#include "sim/core/error.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

constexpr int kJ2452Coefficients = 5;
constexpr std::size_t kLeastJ2452Points = 6;  // one more than coefficients
constexpr int kOffsetTerms = 2;               // of a force that depends on speed alone: 1, v^2

using Vector5 = Eigen::Matrix<double, kJ2452Coefficients, 1>;

/// One point in the scaling of a fit.
struct ScaledPoint {
  double log_pressure = 0.0;
  double log_load = 0.0;
  double x = 0.0;
  double force = 0.0;
  double speed_squared = 0.0;  // over the highest speed
};

ScaledPoint scale_point(const J2452Fit& fit, const RollingPoint& point) {
  return {std::log(point.pressure_Pa / fit.pressure_0_Pa), std::log(point.load_N / fit.load_0_N),
          (point.speed_m_s - fit.speed_0_m_s) / fit.half_range_m_s, point.force_N / fit.force_0_N,
          std::pow(point.speed_m_s / (fit.speed_0_m_s + fit.half_range_m_s), 2)};
}

std::vector<ScaledPoint> scale_points(const J2452Fit& fit, const std::vector<RollingPoint>& points) {
  std::vector<ScaledPoint> scaled;
  for (const RollingPoint& point : points) scaled.push_back(scale_point(fit, point));
  return scaled;
}

void require_levels(const std::vector<RollingPoint>& points, double RollingPoint::*member, const char* key,
                    const char* what, std::size_t least) {
  std::vector<double> values;
  for (const RollingPoint& point : points) values.push_back(point.*member);
  const std::size_t levels = count_levels(values);
  if (levels >= least) return;
  throw InputError(
      {fmt::format("the points have only {}, too few for the law of SAE J2452", format_count(levels, what)), "", 0, key,
       "", fmt::format("at least {} {}s that differ by more than 2 %", least, what), ""});
}

void require_decided(const std::vector<RollingPoint>& points) {
  if (points.size() < kLeastJ2452Points) {
    throw InputError({fmt::format("too few points for the five coefficients of SAE J2452: {}", points.size()), "", 0,
                      "", "", fmt::format("at least {} points", kLeastJ2452Points), ""});
  }
  require_levels(points, &RollingPoint::pressure_Pa, "pressure_kPa", "pressure", 2);
  require_levels(points, &RollingPoint::load_N, "load_N", "load", 2);
  require_levels(points, &RollingPoint::speed_m_s, "speed_km_h", "speed", 3);
}

void choose_scaling(const std::vector<RollingPoint>& points, J2452Fit& fit) {
  const auto n = static_cast<double>(points.size());
  double log_pressure = 0.0, log_load = 0.0, force_N = 0.0;
  double low_m_s = points.front().speed_m_s;
  double high_m_s = low_m_s;
  for (const RollingPoint& point : points) {
    log_pressure += std::log(point.pressure_Pa) / n;
    log_load += std::log(point.load_N) / n;
    force_N += point.force_N / n;
    low_m_s = std::min(low_m_s, point.speed_m_s);
    high_m_s = std::max(high_m_s, point.speed_m_s);
  }
  fit.pressure_0_Pa = std::exp(log_pressure);
  fit.load_0_N = std::exp(log_load);
  fit.force_0_N = force_N;
  fit.speed_0_m_s = 0.5 * (low_m_s + high_m_s);
  fit.half_range_m_s = 0.5 * (high_m_s - low_m_s);
}

/// Row of the Jacobian of the scaled force.
Vector5 calc_gradient(const Vector5& found, double log_pressure, double log_load, double mean_x, double mean_x2) {
  const double level = std::exp(found(0) * log_pressure + found(1) * log_load);
  const double force = level * (found(2) + found(3) * mean_x + found(4) * mean_x2);
  Vector5 gradient;
  gradient << force * log_pressure, force * log_load, level, level * mean_x, level * mean_x2;
  return gradient;
}

/// The same of a point. Beyond the coefficients of the law stand those of a force that depends on speed alone.
Eigen::VectorXd calc_row(const Eigen::VectorXd& unknowns, const ScaledPoint& point) {
  Eigen::VectorXd row(unknowns.size());
  row.head<kJ2452Coefficients>() = calc_gradient(unknowns.head<kJ2452Coefficients>(), point.log_pressure,
                                                 point.log_load, point.x, point.x * point.x);
  if (unknowns.size() > kJ2452Coefficients) row.tail<kOffsetTerms>() << 1.0, point.speed_squared;
  return row;
}

double calc_residual(const Eigen::VectorXd& unknowns, const ScaledPoint& point) {
  const double level = std::exp(unknowns(0) * point.log_pressure + unknowns(1) * point.log_load);
  const double law = level * (unknowns(2) + point.x * (unknowns(3) + point.x * unknowns(4)));
  const bool has_offset = unknowns.size() > kJ2452Coefficients;
  return law + (has_offset ? unknowns(5) + unknowns(6) * point.speed_squared : 0.0) - point.force;
}

/// From the first unknowns: the coefficients of the law, and perhaps those of a force that depends on speed alone.
Eigen::VectorXd minimize_scaled(const std::vector<ScaledPoint>& points, std::vector<double> unknowns) {
  const auto count = static_cast<Eigen::Index>(unknowns.size());
  LeastSquaresProblem problem;
  problem.residuals = points.size();
  problem.evaluate = [&points, count](const double* values, double* residuals, double* jacobian) {
    const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(values, count);
    for (std::size_t i = 0; i < points.size(); ++i) {
      residuals[i] = calc_residual(at, points[i]);
      if (jacobian == nullptr) continue;
      Eigen::Map<Eigen::VectorXd>(jacobian + static_cast<Eigen::Index>(i) * count, count) = calc_row(at, points[i]);
    }
    return true;
  };
  LeastSquaresOptions options;
  options.most_iterations = 200;  // Assumed: a well-conditioned fit takes ten
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  const LeastSquaresResult result = minimize_squares(problem, options, unknowns);
  if (!result.has_converged) {
    throw RunFailure("the fit of the law of SAE J2452 does not converge: " + result.message);
  }
  return Eigen::Map<const Eigen::VectorXd>(unknowns.data(), count);
}

/// a, b or c as the product of two numbers: exp(u), the scaling's part, and m, linear in q.
struct PowerCoefficient {
  double u = 0.0;
  double m = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

  double value() const { return std::exp(u) * m; }
  double calc_sd() const {
    const Eigen::Vector2d gradient(value(), std::exp(u));
    return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
  }
  std::pair<double, double> find_range(double reach) const;
};

/// Least and greatest value of exp(u) m over the ellipse of u and m whose radius is `reach` standard deviations: the
/// interval by the likelihood ratio, where u and m are normal. They lie on its rim, since m has no extreme inside.
std::pair<double, double> PowerCoefficient::find_range(double reach) const {
  constexpr int kSteps = 180;
  constexpr int kBits = 40;
  constexpr double kTurn = 2.0 * boost::math::constants::pi<double>() / kSteps;
  const Eigen::Matrix2d root = covariance.llt().matrixL();
  const auto at = [&](double angle) {
    const Eigen::Vector2d step = reach * (root * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    return std::exp(u + step(0)) * (m + step(1));
  };
  const auto least = [&](double sign) {
    int best = 0;
    for (int i = 1; i < kSteps; ++i) {
      if (sign * at(i * kTurn) < sign * at(best * kTurn)) best = i;
    }
    const auto turned = [&](double angle) { return sign * at(angle); };
    return sign * boost::math::tools::brent_find_minima(turned, (best - 1) * kTurn, (best + 1) * kTurn, kBits).second;
  };
  return {least(1.0), least(-1.0)};
}

/// The coefficient of v^`power` (v in km/h).
PowerCoefficient make_power_coefficient(const J2452Fit& fit, const Vector5& found, int power) {
  const double log_pressure_kPa = std::log(fit.pressure_0_Pa / 1e3);
  const double log_load_N = std::log(fit.load_0_N);
  const double v0 = kKmhPerMs * fit.speed_0_m_s;
  const double h = kKmhPerMs * fit.half_range_m_s;
  Eigen::Matrix3d of_powers;  // a, b, c from q, but for the level
  of_powers << 1.0, -v0 / h, v0 * v0 / (h * h), 0.0, 1.0 / h, -2.0 * v0 / (h * h), 0.0, 0.0, 1.0 / (h * h);
  Eigen::Matrix<double, 2, 5> linear = Eigen::Matrix<double, 2, 5>::Zero();
  linear(0, 0) = -log_pressure_kPa;
  linear(0, 1) = -log_load_N;
  linear.block<1, 3>(1, 2) = of_powers.row(power);
  const Eigen::Vector2d values = linear * found;
  return {values(0) + std::log(fit.force_0_N), values(1), linear * fit.covariance * linear.transpose()};
}

void put_coefficients(const Vector5& found, J2452Fit& fit) {
  constexpr std::array<const char*, 3> kNames{"a", "b", "c"};
  constexpr std::array<const char*, 3> kUnits{"N kPa^-alpha N^-beta", "N kPa^-alpha N^-beta/(km/h)",
                                              "N kPa^-alpha N^-beta/(km/h)^2"};
  const int freedom = fit.find_freedom();
  fit.coefficients = {make_student_estimate("alpha", found(0), std::sqrt(fit.covariance(0, 0)), freedom, ""),
                      make_student_estimate("beta", found(1), std::sqrt(fit.covariance(1, 1)), freedom, "")};
  for (int power = 0; power < 3; ++power) {
    const auto at = static_cast<std::size_t>(power);
    const PowerCoefficient coefficient = make_power_coefficient(fit, found, power);
    fit.coefficients.push_back(
        make_student_estimate(kNames[at], coefficient.value(), coefficient.calc_sd(), freedom, kUnits[at]));
    if (fit.statistics.residual_sd_N <= 0.0) continue;
    std::tie(fit.coefficients.back().low_95, fit.coefficients.back().high_95) =
        coefficient.find_range(calc_student_reach(freedom));
  }
  fit.law = {found(0), found(1), fit.coefficients[2].value, fit.coefficients[3].value, fit.coefficients[4].value};
}

/// Covariance of unknowns of points that scatter by themselves, in the scaling of the law.
Eigen::MatrixXd calc_law_covariance(double point_sd, const Eigen::MatrixXd& inverse) {
  return point_sd * point_sd * inverse;
}

/// The same if sets scatter as well.
Eigen::MatrixXd calc_law_covariance(double force_0_N, const std::vector<FittedPoint>& points, const SetScatter& scatter,
                                    const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& inverse) {
  const Eigen::MatrixXd moved =
      scatter.relative_sd / force_0_N * inverse * jacobian.transpose() * make_set_columns(points, scatter.set_of_point);
  return calc_law_covariance(scatter.point_sd_N / force_0_N, inverse) + moved * moved.transpose();
}

void warn_of_j2452(const Eigen::MatrixXd& jacobian, J2452Fit& fit) {
  constexpr double kUnlikely = 0.01;
  const auto& lack = fit.statistics.lack_of_fit;
  if (lack.has_value() && lack->p < kUnlikely) {
    fit.warnings.push_back(fmt::format(
        "lack of fit: the points leave the law by more than repeated points scatter (F = {:.3g}, p = {:.2g}); the "
        "standard deviations hold that, but the law is not exact over this range",
        lack->F, lack->p));
  }
  if (const auto doubt = doubt_largest_residual(fit.points, fit.statistics, jacobian)) fit.warnings.push_back(*doubt);
}

/// A force that depends on speed alone, beside the law.
struct OffsetForce {
  double value_N = 0.0;  // at the middle speed
  double chance = 1.0;   // that points without it show as much of it
  double alpha = 0.0;    // of the law beside it
  double beta = 0.0;
};

/// Throws RunFailure where the points do not decide it.
OffsetForce find_offset_force(const J2452Fit& fit, const std::vector<ScaledPoint>& points) {
  const Eigen::VectorXd found =
      minimize_scaled(points, {fit.law.alpha, fit.law.beta, fit.q(0), fit.q(1), fit.q(2), 0.0, 0.0});
  const auto count = static_cast<Eigen::Index>(points.size());
  constexpr double kSetsScatterBelow = 0.01;  // Assumed: at 0.25, chance would hide every fourth loss
  Eigen::MatrixXd jacobian(count, found.size());
  std::vector<FittedPoint> fitted = fit.points;
  double squares = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const ScaledPoint& point = points[static_cast<std::size_t>(i)];
    jacobian.row(i) = calc_row(found, point).transpose();
    const double residual = calc_residual(found, point);
    squares += residual * residual;
    FittedPoint& at = fitted[static_cast<std::size_t>(i)];
    at.fitted_N = at.point.force_N + fit.force_0_N * residual;
  }
  std::vector<double> leverages;
  const Eigen::MatrixXd inverse = invert_normal(jacobian, leverages);
  const double middle = fit.speed_0_m_s / (fit.speed_0_m_s + fit.half_range_m_s);
  const Eigen::Vector2d at_middle(1.0, middle * middle);
  const double value = found.tail<kOffsetTerms>().dot(at_middle);
  const auto scatter = fit.set_scatter.has_value() ? find_set_scatter(fitted, jacobian) : std::nullopt;
  constexpr double kLeastFreedom = 2.0;  // Assumed: with less, the test finds no scatter of sets
  if (fit.includes_set_scatter() && (!scatter.has_value() || scatter->freedom < kLeastFreedom)) {
    throw RunFailure("too few sets to tell their scatter from a force that depends on speed alone");
  }
  const bool sets_scatter = scatter.has_value() && scatter->chance < kSetsScatterBelow;
  const double freedom = sets_scatter ? scatter->freedom : static_cast<double>(count - found.size());
  const Eigen::MatrixXd covariance = sets_scatter
                                         ? calc_law_covariance(fit.force_0_N, fitted, *scatter, jacobian, inverse)
                                         : calc_law_covariance(std::sqrt(squares / freedom), inverse);
  const double sd = std::sqrt(at_middle.dot(covariance.bottomRightCorner<kOffsetTerms, kOffsetTerms>() * at_middle));
  const double t = sd > 0.0 ? value / sd : 0.0;
  const double chance = boost::math::cdf(boost::math::complement(boost::math::students_t(freedom), t));
  return {fit.force_0_N * value, chance, found(0), found(1)};
}

}  // namespace

std::optional<std::string> doubt_parasitic_loss(const J2452Fit& fit) {
  constexpr double kUnlikely = 5e-4;
  constexpr double kLeastShare = 0.1;
  constexpr double kLeastBeta = 0.8;
  constexpr double kMostBeta = 1.4;
  constexpr std::size_t kLeastLoads = 3, kLeastFreedom = 3;
  std::vector<RollingPoint> points;
  std::vector<double> loads_N;
  double least_N = std::numeric_limits<double>::infinity();
  for (const FittedPoint& one : fit.points) {
    points.push_back(one.point);
    loads_N.push_back(one.point.load_N);
    least_N = std::min(least_N, one.point.force_N);
  }
  if (points.size() < kJ2452Coefficients + kOffsetTerms + kLeastFreedom) return std::nullopt;
  if (count_levels(loads_N) < kLeastLoads) return std::nullopt;
  OffsetForce offset;
  try {
    offset = find_offset_force(fit, scale_points(fit, points));
  } catch (const RunFailure&) {
    return std::nullopt;
  }
  const bool is_of_tire = offset.beta > kLeastBeta && offset.beta < kMostBeta;
  if (!is_of_tire || offset.chance >= kUnlikely || offset.value_N <= kLeastShare * least_N) return std::nullopt;
  return fmt::format(
      "the points show a force of some {:.1f} N that depends neither on load nor on pressure (p = {:.1g}; beside it, "
      "alpha is {:.2f} and beta {:.2f}): was the parasitic loss not subtracted?",
      offset.value_N, offset.chance, offset.alpha, offset.beta);
}

std::optional<std::string> doubt_sets(const J2452Fit& fit) {
  constexpr double kMisses = 0.03, kUnlikely = 0.001;
  if (!fit.set_scatter.has_value() || fit.set_scatter->chance >= kUnlikely) return std::nullopt;
  const SetScatter& scatter = *fit.set_scatter;
  const std::string text = fmt::format(
      "points of one load and pressure lie off the law together, by a standard deviation of {:.1f} % (p = {:.2g}): {}",
      1e2 * scatter.relative_sd, scatter.chance,
      fit.includes_set_scatter()
          ? "the intervals include this scatter. More sets would make them narrower; more points of each set would not"
          : fmt::format("the intervals take all points as independent, and are too narrow. They include such a scatter "
                        "of five sets or more; there are {}",
                        scatter.set_count()));
  const auto worst = std::max_element(scatter.set_errors.begin(), scatter.set_errors.end(),
                                      [](double one, double other) { return std::abs(one) < std::abs(other); });
  if (std::abs(*worst) <= kMisses) return text;
  const auto set = static_cast<std::size_t>(worst - scatter.set_errors.begin());
  const auto first = std::find(scatter.set_of_point.begin(), scatter.set_of_point.end(), set);
  const RollingPoint& point = fit.points[static_cast<std::size_t>(first - scatter.set_of_point.begin())].point;
  return text + fmt::format(
                    ". Those at {:.0f} N and {:.0f} kPa are off by {:+.0f} %: are loads and pressures of all sets "
                    "right, the pressures gauge, and the parasitic loss subtracted?",
                    point.load_N, point.pressure_Pa / 1e3, 1e2 * *worst);
}

ForceEstimate J2452Fit::estimate(double pressure_Pa, double load_N, double mean_x, double mean_x2) const {
  Vector5 found;
  found << law.alpha, law.beta, q;
  const Vector5 gradient =
      calc_gradient(found, std::log(pressure_Pa / pressure_0_Pa), std::log(load_N / load_0_N), mean_x, mean_x2);
  const double force = gradient(2) * q(0) + gradient(3) * q(1) + gradient(4) * q(2);
  const double variance = gradient.dot(covariance * gradient);
  return {force_0_N * force, force_0_N * std::sqrt(std::max(0.0, variance))};
}

ForceEstimate J2452Fit::estimate_force(const ReferenceCondition& at) const {
  const double x = (at.speed_m_s - speed_0_m_s) / half_range_m_s;
  return estimate(at.pressure_Pa, at.load_N, x, x * x);
}

ForceEstimate J2452Fit::estimate_mean(double pressure_Pa, double load_N, const SpeedMoments& moments) const {
  const double h = half_range_m_s;
  const double mean_x = (moments.mean_m_s - speed_0_m_s) / h;
  const double mean_x2 =
      (moments.mean_square_m2_s2 - 2.0 * speed_0_m_s * moments.mean_m_s + speed_0_m_s * speed_0_m_s) / (h * h);
  return estimate(pressure_Pa, load_N, mean_x, mean_x2);
}

J2452Fit fit_j2452(const std::vector<RollingPoint>& points, RandomPart random) {
  require_decided(points);
  J2452Fit fit;
  choose_scaling(points, fit);
  const std::vector<ScaledPoint> scaled = scale_points(fit, points);
  const Vector5 found = minimize_scaled(scaled, {-0.4, 1.0, 1.0, 0.1, 0.0});  // from an ordinary tire
  fit.q = found.tail<3>();
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(points.size()), kJ2452Coefficients);
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    const Vector5 gradient = calc_row(found, scaled[i]);
    jacobian.row(static_cast<Eigen::Index>(i)) = gradient.transpose();
    fit.points.push_back({points[i], fit.force_0_N * (gradient.tail<3>().dot(fit.q)), 0.0});
  }
  std::vector<double> leverages;
  const Eigen::MatrixXd inverse = invert_normal(jacobian, leverages);
  for (std::size_t i = 0; i < leverages.size(); ++i) fit.points[i].leverage = leverages[i];
  fit.statistics = calc_statistics(fit.points, kJ2452Coefficients);
  if (random == RandomPart::kPointsAndSets) fit.set_scatter = find_set_scatter(fit.points, jacobian);
  fit.covariance = fit.includes_set_scatter()
                       ? calc_law_covariance(fit.force_0_N, fit.points, *fit.set_scatter, jacobian, inverse)
                       : calc_law_covariance(fit.statistics.residual_sd_N / fit.force_0_N, inverse);
  put_coefficients(found, fit);
  warn_of_j2452(jacobian, fit);
  return fit;
}

}  // namespace rollrig::estimation
