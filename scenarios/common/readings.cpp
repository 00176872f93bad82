#include "scenarios/common/readings.h"

#include <algorithm>
#include <cmath>

#include <boost/math/statistics/linear_regression.hpp>

#include "measurements/sensor_file.h"
#include "models/tire/conversion_laws.h"
#include "models/tire/drum_curvature.h"
#include "models/wheel/rolling_wheel.h"

namespace rollrig::scenarios {
namespace {

constexpr double kReferenceRadius_m = 1.0;
constexpr double kCoverageFactor = 2.0;

double calc_force_method_N(const Reading& reading, const RunSpec& spec) {
  const double loaded_radius_m = calc_loaded_radius_m(spec.tire.values, reading.load_N);
  return reading.spindle_force_N * models::calc_rolling_ratio(loaded_radius_m, spec.rig.curvature_per_m());
}

}  // namespace

double calc_mean(const sim::Recording<double>& recording, const RunSpec& spec, const Window& window,
                 const Quantity& quantity) {
  return calc_window_mean(recording.time_s, recording.channel(quantity), window, spec.sample_interval_s);
}

Reading take_reading(const sim::Recording<double>& recording, const RunSpec& spec, const Window& window) {
  const Quantity& force = spec.rig.kind->traits.force;
  const auto mean = [&](const Quantity& quantity) { return calc_mean(recording, spec, window, quantity); };
  Reading reading;
  reading.window = window;
  reading.samples = count_window_samples(recording.time_s, recording.channel(force), window, spec.sample_interval_s);
  reading.load_N = mean(quantities::kLoad);
  reading.speed_m_s = mean(quantities::kSpeed);
  reading.ambient_K = mean(quantities::kAmbient);
  reading.force_N = mean(force) / spec.rig.lever_m();
  if (reads_torque(spec.rig.kind->traits)) reading.drum_torque_Nm = mean(force);
  reading.spindle_force_N = mean(quantities::kSpindleForce);
  reading.liner_temperature_K = mean(quantities::kLinerTemperature);
  reading.pressure_Pa = mean(quantities::kCavityPressure);
  return reading;
}

Cycle evaluate_cycle(const Reading& loaded, const Reading& skim, const RunSpec& spec) {
  Cycle cycle;
  cycle.loaded = loaded;
  cycle.skim = skim;
  cycle.parasitic_N = skim.force_N;
  cycle.rolling_resistance_N = loaded.force_N - cycle.parasitic_N;
  cycle.rrc = cycle.rolling_resistance_N / loaded.load_N;
  cycle.force_method_N = calc_force_method_N(loaded, spec) - calc_force_method_N(skim, spec);
  return cycle;
}

std::vector<LoadRange> find_test_ranges(const sim::Recording<double>& recording, const RunSpec& spec) {
  const auto first = static_cast<std::ptrdiff_t>(recording.row_at(0.0));
  const auto from_zero = [first](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + first, values.end());
  };
  return find_load_ranges(from_zero(recording.time_s), from_zero(recording.channel(quantities::kLoad)),
                          from_zero(recording.channel(quantities::kSpeed)), calc_skim_limit_N(spec.rig),
                          kShortestRange_s);
}

std::vector<Cycle> find_cycles(const sim::Recording<double>& recording, const RunSpec& spec,
                               const DrumConditions& conditions) {
  const std::vector<LoadRange> ranges = find_test_ranges(recording, spec);
  const auto read = [&](const LoadRange& range) {
    return take_reading(recording, spec, find_last_window(range, conditions.window_s, conditions.margin_s));
  };
  std::vector<Cycle> cycles;
  for (std::size_t i = 0; i + 1 < ranges.size(); ++i) {
    if (ranges[i].loaded && !ranges[i + 1].loaded) {
      cycles.push_back(evaluate_cycle(read(ranges[i]), read(ranges[i + 1]), spec));
    }
  }
  if (cycles.empty()) throw RunFailure("the run ended before a load and a skim test could be averaged");
  return cycles;
}

double correct_rrc(double rrc, double ambient_K, const RunSpec& spec) {
  const double tire_radius_m = spec.tire.values.geometry.outer_diameter_m / 2.0;
  const double to_2m =
      models::calc_drum_correction(spec.rig.curvature_per_m(), 1.0 / kReferenceRadius_m, tire_radius_m);
  return rrc * to_2m * models::calc_ambient_correction(ambient_K, find_ambient_coefficient_per_K(spec));
}

double find_ambient_coefficient_per_K(const RunSpec& spec) {
  const models::TireFile& tire = spec.tire;
  if (tire.iso_28580.has_value()) return tire.iso_28580->ambient_coefficient_per_K;
  if (!tire.service.has_value()) return models::kAmbientCoefficient_per_K;
  return models::find_iso_test(*tire.service, tire.values.geometry.rim_diameter_m).ambient_coefficient_per_K;
}

models::SensorParameters find_force_sensor(const RunSpec& spec) {
  const Quantity& force = spec.rig.kind->traits.force;
  const models::SensorSet& usual = spec.rig.kind->default_sensors;
  if (spec.sensors.has_value() && spec.sensors->count(force) > 0) return spec.sensors->at(force);
  return usual.count(force) > 0 ? usual.at(force) : measurements::read_sensor_asset("source").at(force);
}

RrcUncertainty calc_rrc_uncertainty(const Cycle& cycle, const RunSpec& spec) {
  const models::SensorParameters sensor = find_force_sensor(spec);
  const double to_rrc = correct_rrc(1.0 / (spec.rig.lever_m() * cycle.loaded.load_N), cycle.loaded.ambient_K, spec);
  const double variance = models::calc_difference_variance(sensor, cycle.loaded.samples, spec.sample_interval_s,
                                                           cycle.skim.window.start_s - cycle.loaded.window.start_s);
  RrcUncertainty uncertainty;
  uncertainty.offset_canceled = kCoverageFactor * std::sqrt(variance) * to_rrc;
  uncertainty.offset_kept = kCoverageFactor * sensor.offset_sd * to_rrc;
  return uncertainty;
}

bool has_two_values(const std::vector<double>& x) {
  return std::adjacent_find(x.begin(), x.end(), std::not_equal_to<>()) != x.end();
}

double fit_power(const std::vector<double>& x, const std::vector<double>& y) {
  const auto logarithms = [](std::vector<double> values) {
    for (double& value : values) value = std::log(value);
    return values;
  };
  return boost::math::statistics::simple_ordinary_least_squares(logarithms(x), logarithms(y)).second;
}

std::optional<std::string> warn_of_no_power(const std::vector<double>& loss_N) {
  const double least_N = *std::min_element(loss_N.begin(), loss_N.end());
  if (least_N > 0.0) return std::nullopt;
  return fmt::format("a rolling resistance of {:.2f} N is not positive, so that no power law is fitted", least_N);
}

Cycle average_cycles(const std::vector<Cycle>& cycles) {
  Cycle mean = cycles.back();
  mean.parasitic_N = mean.rolling_resistance_N = mean.rrc = mean.force_method_N = 0.0;
  const auto n = static_cast<double>(cycles.size());
  for (const Cycle& cycle : cycles) {
    mean.parasitic_N += cycle.parasitic_N / n;
    mean.rolling_resistance_N += cycle.rolling_resistance_N / n;
    mean.rrc += cycle.rrc / n;
    mean.force_method_N += cycle.force_method_N / n;
  }
  for (Reading Cycle::*part : {&Cycle::loaded, &Cycle::skim}) {
    std::optional<double>& torque_Nm = (mean.*part).drum_torque_Nm;
    if (!torque_Nm.has_value()) continue;
    torque_Nm = 0.0;
    for (const Cycle& cycle : cycles) *torque_Nm += *(cycle.*part).drum_torque_Nm / n;
  }
  return mean;
}

std::vector<double> default_sweep_loads_N(const RunSpec& spec) {
  if (!spec.tire.sweep_loads_N.empty()) return spec.tire.sweep_loads_N;
  const double iso_N = spec.tire.iso_28580.has_value() ? spec.tire.iso_28580->load_N : 1.25 * kVehicleLoad_N;
  return {iso_N, 0.5 * (iso_N + kVehicleLoad_N), kVehicleLoad_N};
}

}  // namespace rollrig::scenarios
