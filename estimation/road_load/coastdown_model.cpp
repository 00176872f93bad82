#include "estimation/road_load/coastdown_model.h"

#include <cmath>
#include <numeric>

#include <boost/math/quadrature/gauss.hpp>

#include "models/vehicle/vehicle.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

double mean_of(const std::vector<double>& values, std::size_t first, std::size_t end) {
  return std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(first),
                         values.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
         static_cast<double>(end - first);
}

/// Mean conditions over rows [first, end) of a run, as factors.
BinConditions make_conditions(const CoastdownRun& run, const RoadLoadFitOptions& options, double effective_mass_kg,
                              std::size_t first, std::size_t end) {
  const CoastdownConditions& given = run.conditions;
  const int h = run.heading;
  BinConditions at;
  const double ambient_K =
      given.ambient_K.empty() ? options.reference_temperature_K : mean_of(given.ambient_K, first, end);
  const double pressure_Pa = given.ambient_pressure_Pa.empty() ? options.reference_pressure_Pa
                                                               : mean_of(given.ambient_pressure_Pa, first, end);
  const double density = models::calc_air_density_kg_per_m3(pressure_Pa, ambient_K);
  at.rolling = 1.0 / (1.0 + options.rolling_fall_per_K * (ambient_K - options.reference_temperature_K));
  at.density = density / calc_reference_density_kg_m3(options);
  const double wind_m_s = given.wind_m_s.empty() ? 0.0 : h * mean_of(given.wind_m_s, first, end);
  const double slope = given.slope.empty() ? 0.0 : h * mean_of(given.slope, first, end);
  at.offset_N = find_test_mass_kg(options, effective_mass_kg) * kStandardGravity_m_s2 * slope;
  if (options.drag_area_m2.has_value()) {
    const double half = 0.5 * density * *options.drag_area_m2;
    at.offset_N += half * wind_m_s * wind_m_s;
    at.offset_N_s_per_m = 2.0 * half * wind_m_s;
  } else {
    at.wind_m_s = wind_m_s;
  }
  return at;
}

void add_trace(const CoastdownRun& run, const RoadLoadFitOptions& options, double mass_kg, FitRun& fit) {
  fit.cells = cut_into_cells(run, {options.bin_width_m_s, options.speed_from_m_s, options.speed_to_m_s});
  for (std::size_t i = 0; i + 1 < fit.cells.size(); ++i) {
    const SpeedCell& upper = fit.cells[i];
    const SpeedCell& lower = fit.cells[i + 1];
    FitBin bin;
    bin.high_m_s = upper.nominal_speed_m_s;
    bin.low_m_s = lower.nominal_speed_m_s;
    bin.upper_cell = static_cast<int>(i);
    bin.upper_samples = upper.samples;
    bin.lower_samples = lower.samples;
    bin.follows = i > 0;
    bin.at = make_conditions(run, options, mass_kg, upper.first_sample, lower.end_sample);
    fit.bins.push_back(bin);
  }
}

void add_bins(const CoastdownRun& run, const RoadLoadFitOptions& options, double mass_kg, FitRun& fit) {
  constexpr double kSame_m_s = 1e-6;
  for (std::size_t i = 0; i < run.bins.size(); ++i) {
    const SpeedBin& given = run.bins[i];
    if (given.low_m_s < options.speed_from_m_s - kSame_m_s || given.high_m_s > options.speed_to_m_s + kSame_m_s) {
      continue;
    }
    FitBin bin;
    bin.high_m_s = given.high_m_s;
    bin.low_m_s = given.low_m_s;
    bin.duration_s = given.duration_s;
    bin.follows = !fit.bins.empty() && std::abs(fit.bins.back().low_m_s - bin.high_m_s) < kSame_m_s;
    bin.at = make_conditions(run, options, mass_kg, i, i + 1);
    fit.bins.push_back(bin);
  }
}

}  // namespace

double calc_reference_density_kg_m3(const RoadLoadFitOptions& options) {
  return models::calc_air_density_kg_per_m3(options.reference_pressure_Pa, options.reference_temperature_K);
}

std::vector<FitRun> make_fit_runs(const CoastdownData& data, const RoadLoadFitOptions& options,
                                  double effective_mass_kg) {
  std::vector<FitRun> runs;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const CoastdownRun& run = data.runs[i];
    FitRun fit;
    fit.index = i;
    fit.heading = run.heading;
    if (run.bins.empty()) {
      add_trace(run, options, effective_mass_kg, fit);
    } else {
      add_bins(run, options, effective_mass_kg, fit);
    }
    if (!fit.bins.empty()) runs.push_back(std::move(fit));
  }
  return runs;
}

double CoastdownModel::wind_m_s(const FitRun& run, const Eigen::VectorXd& coefficients) const {
  if (run.wind_column < 0) return 0.0;
  const double drag = drag_N_s2_per_m2_.value_or(coefficients(2));
  const double twice = coefficients(run.wind_column);
  return std::abs(twice) < 2.0 * kMostFittedWind_m_s * drag ? twice / (2.0 * drag) : 0.0;
}

// The wind w that d_1 = 2 C w means adds C w^2 = d_1^2/(4 C) to both headings.
Eigen::VectorXd CoastdownModel::factors(const FitRun& run, const FitBin& bin, double speed_m_s, double wind_m_s) const {
  Eigen::VectorXd factors = Eigen::VectorXd::Zero(count_);
  const double air_m_s = air_speed_m_s(bin, speed_m_s);
  factors(0) = bin.at.rolling;
  factors(1) = bin.at.rolling * speed_m_s;
  factors(2) = bin.at.density * air_m_s * std::abs(air_m_s);
  if (uses_headings_) factors(3) = run.heading;
  if (run.wind_column < 0) return factors;
  factors(run.wind_column) = run.heading * speed_m_s + wind_m_s;
  if (!drag_N_s2_per_m2_.has_value()) factors(2) -= wind_m_s * wind_m_s;
  return factors;
}

double CoastdownModel::rest_N(const FitRun& run, const FitBin& bin, const Eigen::VectorXd& coefficients,
                              double speed_m_s, double wind_m_s) const {
  double rest = bin.at.offset_N + bin.at.offset_N_s_per_m * speed_m_s;
  if (drag_N_s2_per_m2_.has_value() && run.wind_column >= 0) rest -= 0.5 * wind_m_s * coefficients(run.wind_column);
  return rest;
}

double CoastdownModel::force_N(const FitRun& run, const FitBin& bin, const Eigen::VectorXd& coefficients,
                               double speed_m_s) const {
  const double wind = wind_m_s(run, coefficients);
  return factors(run, bin, speed_m_s, wind).dot(coefficients) + rest_N(run, bin, coefficients, speed_m_s, wind);
}

DecelerationCurve CoastdownModel::deceleration(const FitRun& run, const FitBin& bin,
                                               const Eigen::VectorXd& coefficients, double speed_m_s) const {
  DecelerationCurve curve;
  const double air_m_s = air_speed_m_s(bin, speed_m_s);
  curve.value_m_s2 = force_N(run, bin, coefficients, speed_m_s) / mass_kg_;
  double slope = bin.at.rolling * coefficients(1) + 2.0 * bin.at.density * coefficients(2) * std::abs(air_m_s) +
                 bin.at.offset_N_s_per_m;
  if (run.wind_column >= 0) slope += run.heading * coefficients(run.wind_column);
  curve.slope_per_s = slope / mass_kg_;
  curve.bend_per_m = 2.0 * bin.at.density * coefficients(2) / mass_kg_;
  return curve;
}

CoastdownModel::Passage CoastdownModel::pass(const FitRun& run, const FitBin& bin,
                                             const Eigen::VectorXd& coefficients) const {
  using Rule = boost::math::quadrature::gauss<double, 7>;
  Passage passage;
  passage.gradient = Eigen::VectorXd::Zero(count_);
  const double middle = 0.5 * (bin.high_m_s + bin.low_m_s);
  const double half = 0.5 * (bin.high_m_s - bin.low_m_s);
  const double wind = wind_m_s(run, coefficients);
  const auto add = [&](double node, double weight) {
    const double speed = middle + half * node;
    const Eigen::VectorXd phi = factors(run, bin, speed, wind);
    const double force = phi.dot(coefficients) + rest_N(run, bin, coefficients, speed, wind);
    passage.possible = passage.possible && force > 0.0;
    const double time = weight * half * mass_kg_ / force;
    passage.duration_s += time;
    passage.mean_speed_m_s += time * speed;
    passage.gradient -= time / force * phi;
  };
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    const double node = Rule::abscissa()[i];
    add(node, Rule::weights()[i]);
    if (node != 0.0) add(-node, Rule::weights()[i]);
  }
  passage.mean_speed_m_s /= passage.duration_s;
  return passage;
}

}  // namespace rollrig::estimation
