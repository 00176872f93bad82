#include "estimation/rolling_law/j1269_fit.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/error.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

/// One term of the law: a power of the load and one of the reciprocal of pressure.
struct MultipointTerm {
  const char* name;
  const char* unit;
  int load_power;
  int pressure_power;
};

const std::vector<MultipointTerm>& list_j1269_terms(MultipointForm form) {
  static const std::vector<MultipointTerm> bilinear{
      {"A0", "N", 0, 0}, {"A1", "N/N", 1, 0}, {"A2", "N kPa", 0, 1}, {"A3", "N kPa/N", 1, 1}};
  static const std::vector<MultipointTerm> proportional{{"A1", "N/N", 1, 0}, {"A3", "N kPa/N", 1, 1}};
  return form == MultipointForm::kBilinear ? bilinear : proportional;
}

Eigen::VectorXd make_multipoint_row(const MultipointFit& fit, double load_N, double pressure_Pa) {
  const std::vector<MultipointTerm>& terms = list_j1269_terms(fit.form);
  Eigen::VectorXd row(static_cast<Eigen::Index>(terms.size()));
  for (std::size_t i = 0; i < terms.size(); ++i) {
    row(static_cast<Eigen::Index>(i)) = std::pow(load_N / fit.load_0_N, terms[i].load_power) *
                                        std::pow(fit.pressure_0_Pa / pressure_Pa, terms[i].pressure_power);
  }
  return row;
}

std::size_t count_levels_of(const std::vector<RollingPoint>& points, double RollingPoint::*member) {
  std::vector<double> values;
  for (const RollingPoint& point : points) values.push_back(point.*member);
  return count_levels(values);
}

void require_multipoint(const std::vector<RollingPoint>& points, MultipointForm form) {
  const std::size_t least = list_j1269_terms(form).size();
  if (points.size() < least) {
    throw InputError({fmt::format("too few points for a law of load and pressure: {}", points.size()), "", 0, "", "",
                      fmt::format("at least {} points", least), ""});
  }
  if (count_levels_of(points, &RollingPoint::speed_m_s) > 1) {
    throw InputError({"the points of SAE J1269 have one speed", "", 0, "speed_km_h", "several",
                      "one speed within 2 %; for several speeds: rollrig fit j2452", ""});
  }
  const std::size_t least_loads = form == MultipointForm::kBilinear ? 2 : 1;
  const std::size_t loads = count_levels_of(points, &RollingPoint::load_N);
  if (loads < least_loads) {
    throw InputError({fmt::format("the points have only {}", format_count(loads, "load")), "", 0, "load_N", "",
                      "at least 2 loads that differ by more than 2 %, or --form proportional", ""});
  }
  const std::size_t pressures = count_levels_of(points, &RollingPoint::pressure_Pa);
  if (pressures < 2) {
    throw InputError({fmt::format("the points have only {}", format_count(pressures, "pressure")), "", 0,
                      "pressure_kPa", "", "at least 2 pressures that differ by more than 2 %", ""});
  }
}

void choose_multipoint_scaling(const std::vector<RollingPoint>& points, MultipointFit& fit) {
  const auto n = static_cast<double>(points.size());
  double log_load = 0.0, log_pressure = 0.0;
  for (const RollingPoint& point : points) {
    log_load += std::log(point.load_N) / n;
    log_pressure += std::log(point.pressure_Pa) / n;
    fit.speed_m_s += point.speed_m_s / n;
    fit.mean_coefficient += point.force_N / point.load_N / n;
  }
  fit.load_0_N = std::exp(log_load);
  fit.pressure_0_Pa = std::exp(log_pressure);
}

void put_multipoint_coefficients(MultipointFit& fit) {
  const std::vector<MultipointTerm>& terms = list_j1269_terms(fit.form);
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double unit =
        std::pow(fit.load_0_N, -terms[i].load_power) * std::pow(fit.pressure_0_Pa / 1e3, terms[i].pressure_power);
    fit.coefficients.push_back(make_student_estimate(terms[i].name, unit * fit.scaled(at),
                                                     unit * std::sqrt(fit.covariance(at, at)), fit.statistics.freedom,
                                                     terms[i].unit));
  }
}

void warn_of_multipoint(const Eigen::MatrixXd& design, MultipointFit& fit) {
  constexpr double kUnlikely = 0.01;
  if (fit.statistics.freedom == 0) {
    fit.warnings.push_back(
        "as many coefficients as points: the law passes through all of them, and no standard deviation is known");
  }
  const auto& lack = fit.statistics.lack_of_fit;
  if (lack.has_value() && lack->p < kUnlikely) {
    fit.warnings.push_back(fmt::format(
        "lack of fit: the points leave the law by more than repeated points scatter (F = {:.3g}, p = {:.2g})", lack->F,
        lack->p));
  }
  if (const auto doubt = doubt_largest_residual(fit.points, fit.statistics, design)) fit.warnings.push_back(*doubt);
  if (std::abs(fit.speed_m_s / kReferenceSpeed_m_s - 1.0) > 0.02) {
    fit.warnings.push_back(
        fmt::format("the speed is {:.1f} km/h, and that of SAE J1269 is 80 km/h", kKmhPerMs * fit.speed_m_s));
  }
}

}  // namespace

ForceEstimate MultipointFit::estimate_force(double load_N, double pressure_Pa) const {
  const Eigen::VectorXd row = make_multipoint_row(*this, load_N, pressure_Pa);
  return {row.dot(scaled), std::sqrt(std::max(0.0, row.dot(covariance * row)))};
}

MultipointFit fit_multipoint(const std::vector<RollingPoint>& points, MultipointForm form) {
  require_multipoint(points, form);
  MultipointFit fit;
  fit.form = form;
  choose_multipoint_scaling(points, fit);
  const auto rows = static_cast<Eigen::Index>(points.size());
  const auto columns = static_cast<Eigen::Index>(list_j1269_terms(form).size());
  Eigen::MatrixXd design(rows, columns);
  Eigen::VectorXd force_N(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const RollingPoint& point = points[static_cast<std::size_t>(i)];
    design.row(i) = make_multipoint_row(fit, point.load_N, point.pressure_Pa).transpose();
    force_N(i) = point.force_N;
  }
  std::vector<double> leverages;
  const Eigen::MatrixXd inverse = invert_normal(design, leverages);
  fit.scaled = design.colPivHouseholderQr().solve(force_N);
  for (std::size_t i = 0; i < points.size(); ++i) {
    fit.points.push_back({points[i], design.row(static_cast<Eigen::Index>(i)).dot(fit.scaled), leverages[i]});
  }
  fit.statistics = calc_statistics(fit.points, static_cast<int>(columns));
  fit.covariance = std::pow(fit.statistics.residual_sd_N, 2) * inverse;
  put_multipoint_coefficients(fit);
  warn_of_multipoint(design, fit);
  return fit;
}

}  // namespace rollrig::estimation
