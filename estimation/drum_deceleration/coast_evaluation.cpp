#include "estimation/drum_deceleration/coast_evaluation.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>

#include <algorithm>
#include <cmath>

#include "models/deceleration_method.h"

namespace rollrig::estimation {
namespace {

/// Parts of the variance of a net deceleration that all levels share: the means of the lifted runs.
std::vector<VariancePart> list_shared_parts(const Tables& tables, Eigen::Index speed) {
  std::vector<VariancePart> parts{calc_mean(tables.drum_alone, speed).of_mean};
  if (tables.mass_ratio > 0.0) {
    VariancePart wheel = calc_mean(tables.wheel_alone, speed).of_mean;
    wheel.variance *= tables.mass_ratio * tables.mass_ratio;
    parts.push_back(wheel);
  }
  return parts;
}

std::vector<VariancePart> scaled(std::vector<VariancePart> parts, double factor) {
  for (VariancePart& part : parts) part.variance *= factor * factor;
  return parts;
}

double calc_net(const Tables& tables, double loaded_m_s2, Eigen::Index speed) {
  const double wheel = tables.mass_ratio > 0.0 ? calc_mean(tables.wheel_alone, speed).mean : 0.0;
  const models::CoastDecelerations<double> a{loaded_m_s2, calc_mean(tables.drum_alone, speed).mean, wheel};
  return models::calc_net_deceleration(a, tables.mass_ratio);
}

VariancePart calc_level_part(const Tables& tables, const LoadedScatter& scatter, std::size_t level) {
  const double factor = 1.0 + tables.mass_ratio;
  return {factor * factor * scatter.single_run.variance / scatter.counts[level], scatter.single_run.freedom};
}

void add_levels(const CoastSet& set, const Tables& tables, Eigen::Index speed, SpeedPoint& point) {
  const LoadedScatter scatter = calc_loaded_scatter(tables.loaded, tables.levels, speed);
  for (std::size_t i = 0; i < scatter.counts.size(); ++i) {
    if (scatter.counts[i] == 0) continue;
    PressureLevel level;
    level.pressure_Pa = tables.levels.pressures_Pa[i];
    level.load_N = tables.levels.loads_N[i];
    level.runs = static_cast<std::size_t>(scatter.counts[i]);
    level.loaded_m_s2 = scatter.means_m_s2[i];
    std::vector<VariancePart> parts = list_shared_parts(tables, speed);
    parts.push_back(calc_level_part(tables, scatter, i));
    const double net = calc_net(tables, level.loaded_m_s2, speed);
    level.net_m_s2 = make_interval(net, parts);
    if (const std::optional<double> mass_kg = set.calc_drum_mass_kg()) {
      level.force_N = make_interval(*mass_kg * net, scaled(parts, *mass_kg));
    }
    point.levels.push_back(level);
  }
  double net_sum = 0.0;
  for (const PressureLevel& level : point.levels) net_sum += level.net_m_s2.value;
  point.repeat_scatter = (1.0 + tables.mass_ratio) * std::sqrt(scatter.single_run.variance) *
                         static_cast<double>(point.levels.size()) / net_sum;
}

/// Standard deviation from run to run over the mean, by the chi-squared distribution.
std::optional<Interval> calc_repeatability(const MeanOfRuns& mean) {
  if (mean.runs < 2) return std::nullopt;
  const double freedom = static_cast<double>(mean.runs) - 1.0;
  const boost::math::chi_squared_distribution<double> chi2(freedom);
  Interval interval;
  interval.value = mean.sd / mean.mean;
  interval.sd = interval.value / std::sqrt(2.0 * freedom);
  interval.freedom = freedom;
  interval.lower = interval.value * std::sqrt(freedom / boost::math::quantile(chi2, 0.975));
  interval.upper = interval.value * std::sqrt(freedom / boost::math::quantile(chi2, 0.025));
  return interval;
}

std::vector<double> list_pressures(const SpeedPoint& point) {
  std::vector<double> pressures_Pa;
  for (const PressureLevel& level : point.levels) pressures_Pa.push_back(level.pressure_Pa);
  return pressures_Pa;
}

/// Variance of ln(net) of the levels that runs at one pressure explain, mean over the levels.
VariancePart calc_repeat_part(const Tables& tables, const LoadedScatter& scatter, const SpeedPoint& point) {
  VariancePart part{0.0, scatter.single_run.freedom};
  std::size_t level = 0;
  for (std::size_t i = 0; i < scatter.counts.size(); ++i) {
    if (scatter.counts[i] == 0) continue;
    const double net = point.levels[level++].net_m_s2.value;
    part.variance +=
        calc_level_part(tables, scatter, i).variance / (net * net) / static_cast<double>(point.levels.size());
  }
  return part;
}

void add_exponent(const Tables& tables, Eigen::Index speed, SpeedPoint& point) {
  std::vector<double> net;
  for (const PressureLevel& level : point.levels) net.push_back(level.net_m_s2.value);
  const bool positive = std::all_of(net.begin(), net.end(), [](double value) { return value > 0.0; });
  if (net.size() < 2 || !positive) return;
  const PowerLaw law = fit_power_law(list_pressures(point), net);
  const LoadedScatter scatter = calc_loaded_scatter(tables.loaded, tables.levels, speed);
  const VariancePart repeat = calc_repeat_part(tables, scatter, point);
  double by_shared = 0.0;  // of the slope by what all levels share
  for (std::size_t i = 0; i < net.size(); ++i) by_shared -= law.weights[i] / net[i];
  std::vector<VariancePart> parts = scaled(list_shared_parts(tables, speed), by_shared);
  parts.push_back({repeat.variance * law.weights_squared, repeat.freedom});
  point.exponent_by_repeats = make_interval(law.slope, parts);
  point.pressure_exponent = point.exponent_by_repeats;
  if (net.size() <= 2) return;  // the law has no rest
  const double freedom = static_cast<double>(net.size()) - 2.0;
  point.level_scatter = std::sqrt(law.residual_variance);
  if (repeat.freedom > 0.0 && repeat.variance > 0.0) {
    const boost::math::fisher_f_distribution<double> fisher(freedom, repeat.freedom);
    point.lack_of_fit_p = boost::math::cdf(boost::math::complement(fisher, law.residual_variance / repeat.variance));
  }
  // Few levels may lie on a line by chance. The scatter about it counts where it is more than that of repeats.
  constexpr double kLevel = 0.05;  // of significance
  point.is_exponent_by_law = point.lack_of_fit_p.value_or(0.0) < kLevel;
  if (!point.is_exponent_by_law) return;
  parts.back() = {law.residual_variance * law.weights_squared, freedom};
  point.pressure_exponent = make_interval(law.slope, parts);
}

/// By how much the exponent moves with the wheel's share of the mass, which is often not known.
void add_mass_ratio_slope(const Tables& tables, Eigen::Index speed, SpeedPoint& point) {
  constexpr double kStep = 1e-3;
  if (!point.pressure_exponent.has_value() || calc_mean(tables.wheel_alone, speed).runs == 0) return;
  Tables more = tables;
  more.mass_ratio += kStep;
  std::vector<double> net;
  for (const PressureLevel& level : point.levels) net.push_back(calc_net(more, level.loaded_m_s2, speed));
  if (std::any_of(net.begin(), net.end(), [](double value) { return value <= 0.0; })) return;
  const double slope = fit_power_law(list_pressures(point), net).slope;
  point.exponent_per_mass_ratio = (slope - point.pressure_exponent->value) / kStep;
}

/// The law of pressure: of the runs at one load, since a force at another load is another force.
void add_pressure_law(const CoastSet& set, const Tables& tables, Eigen::Index speed, SpeedPoint& point) {
  Tables at_load = tables;
  at_load.levels = keep_main_load(tables.levels);
  SpeedPoint part;
  add_levels(set, at_load, speed, part);
  if (part.levels.empty()) return;
  add_exponent(at_load, speed, part);
  add_mass_ratio_slope(at_load, speed, part);
  point.pressure_exponent = part.pressure_exponent;
  point.exponent_by_repeats = part.exponent_by_repeats;
  point.is_exponent_by_law = part.is_exponent_by_law;
  point.exponent_per_mass_ratio = part.exponent_per_mass_ratio;
  point.level_scatter = part.level_scatter;
  point.lack_of_fit_p = part.lack_of_fit_p;
}

/// First direction over second at each pressure that has both; the lifted part is shared and all but drops out.
void add_directions(const CoastSet& set, const Tables& tables, Eigen::Index speed,
                    const std::vector<std::string>& directions, SpeedPoint& point) {
  if (directions.size() != 2) return;
  std::vector<double> logs;
  for (const std::vector<Eigen::Index>& rows : tables.levels.rows) {
    double sums[2] = {0.0, 0.0};
    int counts[2] = {0, 0};
    for (const Eigen::Index row : rows) {
      const double value = tables.loaded.value_m_s2(row, speed);
      if (std::isnan(value)) continue;
      const int side = set.runs[tables.loaded.runs[static_cast<std::size_t>(row)]].direction == directions[0] ? 0 : 1;
      sums[side] += value;
      ++counts[side];
    }
    if (counts[0] == 0 || counts[1] == 0) continue;
    const double first = calc_net(tables, sums[0] / counts[0], speed);
    const double second = calc_net(tables, sums[1] / counts[1], speed);
    if (first > 0.0 && second > 0.0) logs.push_back(std::log(first / second));
  }
  if (logs.size() < 2) return;
  const Eigen::Map<Eigen::ArrayXd> all(logs.data(), static_cast<Eigen::Index>(logs.size()));
  const auto n = static_cast<double>(logs.size());
  const double variance = (all - all.mean()).square().sum() / (n - 1.0);
  const Interval of_log = make_interval(all.mean(), {{variance / n, n - 1.0}});
  point.direction_sd = std::sqrt(variance);
  point.direction_ratio =
      Interval{std::expm1(of_log.value), of_log.sd, of_log.freedom, std::expm1(of_log.lower), std::expm1(of_log.upper)};
}

}  // namespace

PowerLaw fit_power_law(const std::vector<double>& pressures_Pa, const std::vector<double>& net_m_s2) {
  const auto n = static_cast<double>(pressures_Pa.size());
  double mean_x = 0.0, mean_y = 0.0, spread = 0.0;
  for (std::size_t i = 0; i < pressures_Pa.size(); ++i) {
    mean_x += std::log(pressures_Pa[i]) / n;
    mean_y += std::log(net_m_s2[i]) / n;
  }
  for (const double pressure_Pa : pressures_Pa) spread += std::pow(std::log(pressure_Pa) - mean_x, 2);
  PowerLaw law;
  for (std::size_t i = 0; i < pressures_Pa.size(); ++i) {
    law.weights.push_back((std::log(pressures_Pa[i]) - mean_x) / spread);
    law.slope += law.weights.back() * std::log(net_m_s2[i]);
    law.weights_squared += law.weights.back() * law.weights.back();
  }
  for (std::size_t i = 0; i < pressures_Pa.size() && pressures_Pa.size() > 2; ++i) {
    const double rest = std::log(net_m_s2[i]) - mean_y - law.slope * (std::log(pressures_Pa[i]) - mean_x);
    law.residual_variance += rest * rest / (n - 2.0);
  }
  return law;
}

Tables make_tables(const CoastSet& set, const DrumCoastdownFit& fit) {
  Tables tables{collect(set, fit.analyses, CoastState::kLoaded, CoastBody::kDrum),
                collect(set, fit.analyses, CoastState::kLifted, CoastBody::kDrum),
                collect(set, fit.analyses, CoastState::kLifted, CoastBody::kWheel),
                {},
                fit.mass_ratio};
  tables.levels = group_by_pressure(set, tables.loaded);
  return tables;
}

SpeedPoint evaluate_speed(const CoastSet& set, const Tables& tables, const DrumCoastdownFit& fit, std::size_t index) {
  const auto speed = static_cast<Eigen::Index>(index);
  SpeedPoint point;
  point.speed_m_s = set.speeds_m_s[index];
  const MeanOfRuns drum = calc_mean(tables.drum_alone, speed);
  if (drum.runs > 0) {
    point.drum_alone_m_s2 = make_interval(drum.mean, {drum.of_mean});
    point.drum_repeatability = calc_repeatability(drum);
  }
  const MeanOfRuns wheel = calc_mean(tables.wheel_alone, speed);
  if (wheel.runs > 0) point.wheel_alone_m_s2 = make_interval(wheel.mean, {wheel.of_mean});
  if (drum.runs == 0 || (tables.mass_ratio > 0.0 && wheel.runs == 0)) return point;
  add_levels(set, tables, speed, point);
  if (point.levels.empty()) return point;
  add_pressure_law(set, tables, speed, point);
  add_directions(set, tables, speed, fit.directions, point);
  return point;
}

}  // namespace rollrig::estimation
