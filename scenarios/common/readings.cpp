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

/// Loss and temperature under load from the start of a range to its end. Empty where it is too short.
std::optional<std::array<SettlingPoint, 3>> read_settling(const sim::Recording<double>& recording, const RunSpec& spec,
                                                          const LoadRange& range, const Window& end,
                                                          double parasitic_N) {
  constexpr double kFast_s = 180.0;  // Assumed: load, gas, and tread against carcass have settled
  const double window_s = end.end_s - end.start_s;
  const double start_s = range.start_s + kFast_s;
  const double step_s = 0.5 * (end.start_s - start_s);
  if (step_s < window_s) return std::nullopt;
  const auto point = [&](double from_s) {
    const Window window{from_s, from_s + window_s};
    const double force = calc_mean(recording, spec, window, spec.rig.kind->traits.force);
    return SettlingPoint{force / spec.rig.lever_m() - parasitic_N,
                         calc_mean(recording, spec, window, quantities::kLinerTemperature)};
  };
  return {{point(start_s), point(start_s + step_s), point(end.start_s)}};
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

std::optional<double> estimate_unsettled(const std::array<SettlingPoint, 3>& points) {
  const auto& [start, middle, end] = points;
  const double first_K = middle.liner_temperature_K - start.liner_temperature_K;
  const double second_K = end.liner_temperature_K - middle.liner_temperature_K;
  const double decay = second_K / first_K;
  if (!(std::abs(decay) <= kSlowestDecay)) return std::nullopt;
  const double left = decay * decay / (1.0 - decay * decay);
  const double steady_N = end.loss_N + (end.loss_N - start.loss_N) * left;
  return end.loss_N / steady_N - 1.0;
}

bool is_settling_unknown(const std::array<SettlingPoint, 3>& points) {
  constexpr double kStill_K = 0.3;  // Assumed: more than the noise of a mean
  const double last_K = points[2].liner_temperature_K - points[1].liner_temperature_K;
  return !estimate_unsettled(points).has_value() && std::abs(last_K) > kStill_K;
}

std::optional<std::string> warn_of_unsettled(const std::vector<SteadyCycle>& cycles) {
  const auto is_unknown = [](const SteadyCycle& steady) { return steady.cycle.is_settling_unknown; };
  if (std::any_of(cycles.begin(), cycles.end(), is_unknown)) {
    return "the tire still becomes warmer or colder, too far from steady state to say how far RRc is from it: "
           "settle_min is too short";
  }
  double most = 0.0;
  for (const SteadyCycle& steady : cycles) most = std::max(most, std::abs(steady.cycle.unsettled.value_or(0.0)));
  if (most <= kSettled) return std::nullopt;
  return fmt::format(
      "RRc is up to {:.1f} % away from that in steady state (unsettled_percent): settle_min is too short", 1e2 * most);
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
      Cycle cycle = evaluate_cycle(read(ranges[i]), read(ranges[i + 1]), spec);
      if (const auto points = read_settling(recording, spec, ranges[i], cycle.loaded.window, cycle.parasitic_N)) {
        cycle.unsettled = estimate_unsettled(*points);
        cycle.is_settling_unknown = is_settling_unknown(*points);
      }
      cycles.push_back(cycle);
    }
  }
  if (cycles.empty()) throw RunFailure("the run ended before a load and a skim test could be averaged");
  return cycles;
}

double correct_rrc(double rrc, double ambient_K, const RunSpec& spec) {
  const double tire_radius_m = spec.tire.values.geometry.outer_diameter_m / 2.0;
  const double to_2m =
      models::calc_drum_correction(spec.rig.curvature_per_m(), 1.0 / kReferenceRadius_m, tire_radius_m);
  const auto& iso = spec.tire.iso_28580;
  const double coefficient_per_K = iso.has_value() ? iso->ambient_coefficient_per_K : models::kAmbientCoefficient_per_K;
  return rrc * to_2m * models::calc_ambient_correction(ambient_K, coefficient_per_K);
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
  if (mean.unsettled.has_value()) {
    double sum = 0.0;
    for (const Cycle& cycle : cycles) sum += cycle.unsettled.value_or(*mean.unsettled);
    mean.unsettled = sum / n;
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
