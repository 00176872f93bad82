#include "estimation/rolling_law/j2452_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <boost/math/constants/constants.hpp>
#include <boost/math/tools/minima.hpp>

#include "estimation/least_squares/least_squares.h"
#include "sim/core/error.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

constexpr int kJ2452Coefficients = 5;
constexpr std::size_t kLeastJ2452Points = 6;  // one more than coefficients

using Vector5 = Eigen::Matrix<double, kJ2452Coefficients, 1>;

/// One point in the scaling of a fit.
struct ScaledPoint {
  double log_pressure = 0.0;
  double log_load = 0.0;
  double x = 0.0;
  double force = 0.0;
};

ScaledPoint scale_point(const J2452Fit& fit, const RollingPoint& point) {
  return {std::log(point.pressure_Pa / fit.pressure_0_Pa), std::log(point.load_N / fit.load_0_N),
          (point.speed_m_s - fit.speed_0_m_s) / fit.half_range_m_s, point.force_N / fit.force_0_N};
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

double calc_residual(const Vector5& found, const ScaledPoint& point) {
  const double level = std::exp(found(0) * point.log_pressure + found(1) * point.log_load);
  return level * (found(2) + point.x * (found(3) + point.x * found(4))) - point.force;
}

Vector5 minimize_scaled(const std::vector<ScaledPoint>& points) {
  LeastSquaresProblem problem;
  problem.residuals = points.size();
  problem.evaluate = [&points](const double* unknowns, double* residuals, double* jacobian) {
    const Vector5 at = Eigen::Map<const Vector5>(unknowns);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ScaledPoint& point = points[i];
      residuals[i] = calc_residual(at, point);
      if (jacobian == nullptr) continue;
      Eigen::Map<Vector5>(jacobian + i * kJ2452Coefficients) =
          calc_gradient(at, point.log_pressure, point.log_load, point.x, point.x * point.x);
    }
    return true;
  };
  LeastSquaresOptions options;
  options.most_iterations = 200;  // Assumed: a well-conditioned fit takes ten
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  std::vector<double> unknowns{-0.4, 1.0, 1.0, 0.1, 0.0};  // of an ordinary tire
  const LeastSquaresResult result = minimize_squares(problem, options, unknowns);
  if (!result.has_converged) {
    throw RunFailure("the fit of the law of SAE J2452 does not converge: " + result.message);
  }
  return Eigen::Map<const Vector5>(unknowns.data());
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
  const int freedom = fit.statistics.freedom;
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

}  // namespace

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

double J2452Fit::calc_prediction_sd_N(const ReferenceCondition& at) const {
  return std::hypot(estimate_force(at).sd_N, statistics.residual_sd_N);
}

J2452Fit fit_j2452(const std::vector<RollingPoint>& points) {
  require_decided(points);
  J2452Fit fit;
  choose_scaling(points, fit);
  std::vector<ScaledPoint> scaled;
  for (const RollingPoint& point : points) scaled.push_back(scale_point(fit, point));
  const Vector5 found = minimize_scaled(scaled);
  fit.q = found.tail<3>();
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(points.size()), kJ2452Coefficients);
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    const ScaledPoint& at = scaled[i];
    const Vector5 gradient = calc_gradient(found, at.log_pressure, at.log_load, at.x, at.x * at.x);
    jacobian.row(static_cast<Eigen::Index>(i)) = gradient.transpose();
    fit.points.push_back({points[i], fit.force_0_N * (gradient.tail<3>().dot(fit.q)), 0.0});
  }
  std::vector<double> leverages;
  const Eigen::MatrixXd inverse = invert_normal(jacobian, leverages);
  for (std::size_t i = 0; i < leverages.size(); ++i) fit.points[i].leverage = leverages[i];
  fit.statistics = calc_statistics(fit.points, kJ2452Coefficients);
  const double scaled_sd = fit.statistics.residual_sd_N / fit.force_0_N;
  fit.covariance = scaled_sd * scaled_sd * inverse;
  put_coefficients(found, fit);
  warn_of_j2452(jacobian, fit);
  return fit;
}

}  // namespace rollrig::estimation
