#include "estimation/drum_deceleration/coast_evaluation.h"

#include <algorithm>
#include <cmath>

namespace rollrig::estimation {
namespace {

/// The level at that pressure; of several loads, that with most runs.
const PressureLevel* find_level(const SpeedPoint& point, double pressure_Pa) {
  const PressureLevel* found = nullptr;
  for (const PressureLevel& level : point.levels) {
    if (!is_same_pressure(level.pressure_Pa, pressure_Pa)) continue;
    if (found == nullptr || level.runs > found->runs) found = &level;
  }
  return found;
}

/// Ratio of a level to the reference: what both share, and the same runs at two speeds, is counted once.
Interval calc_ratio(const Tables& tables, const PressureLevel& level, Eigen::Index speed,
                    const PressureLevel& reference, Eigen::Index reference_speed) {
  const double net = level.net_m_s2.value;
  const double net_ref = reference.net_m_s2.value;
  const double ratio = net / net_ref;
  if (&level == &reference) return {1.0, 0.0, 0.0, 1.0, 1.0};
  const auto shared = [&](const RunTable& table, double factor) -> VariancePart {
    const double own = calc_mean_covariance(table, speed, speed) / (net * net);
    const double other = calc_mean_covariance(table, reference_speed, reference_speed) / (net_ref * net_ref);
    const double both = calc_mean_covariance(table, speed, reference_speed) / (net * net_ref);
    return {factor * factor * std::max(0.0, own + other - 2.0 * both), calc_mean(table, speed).of_mean.freedom};
  };
  const double factor = 1.0 + tables.mass_ratio;
  const auto run = [&](Eigen::Index a, Eigen::Index b) {
    return factor * factor * calc_run_covariance(tables.loaded, tables.levels, a, b);
  };
  const auto n = static_cast<double>(level.runs);
  const auto n_ref = static_cast<double>(reference.runs);
  double loaded =
      run(speed, speed) / n / (net * net) + run(reference_speed, reference_speed) / n_ref / (net_ref * net_ref);
  const bool same_runs = level.pressure_Pa == reference.pressure_Pa && level.load_N == reference.load_N;
  if (same_runs) loaded -= 2.0 * run(speed, reference_speed) / std::max(n, n_ref) / (net * net_ref);
  std::vector<VariancePart> parts{shared(tables.drum_alone, 1.0)};
  if (tables.mass_ratio > 0.0) parts.push_back(shared(tables.wheel_alone, tables.mass_ratio));
  parts.push_back({std::max(0.0, loaded), calc_loaded_scatter(tables.loaded, tables.levels, speed).single_run.freedom});
  const Interval of_log = make_interval(std::log(ratio), parts);
  return {ratio, ratio * of_log.sd, of_log.freedom, std::exp(of_log.lower), std::exp(of_log.upper)};
}

}  // namespace

std::size_t find_reference_speed(const CoastSet& set) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < set.speeds_m_s.size(); ++i) {
    const auto off = [&](std::size_t k) { return std::abs(set.speeds_m_s[k] - set.reference_speed_m_s); };
    if (off(i) < off(nearest)) nearest = i;
  }
  return nearest;
}

void add_ratios(const CoastSet& set, const Tables& tables, DrumCoastdownFit& fit) {
  const std::size_t reference_speed = find_reference_speed(set);
  fit.reference_pressure_Pa =
      set.reference_pressure_Pa.value_or(tables.levels.pressures_Pa[tables.levels.pressures_Pa.size() / 2]);
  const PressureLevel* reference = find_level(fit.points[reference_speed], fit.reference_pressure_Pa);
  if (reference == nullptr || reference->net_m_s2.value <= 0.0) {
    fit.warnings.push_back(
        reference == nullptr ? "no ratios: at the reference speed no run has the reference pressure"
                             : "no ratios: at the reference speed and pressure the rolling resistance is not above 0");
    return;
  }
  for (std::size_t i = 0; i < fit.points.size(); ++i) {
    for (PressureLevel& level : fit.points[i].levels) {
      if (level.net_m_s2.value <= 0.0) continue;
      level.ratio = calc_ratio(tables, level, static_cast<Eigen::Index>(i), *reference,
                               static_cast<Eigen::Index>(reference_speed));
    }
  }
}

}  // namespace rollrig::estimation
