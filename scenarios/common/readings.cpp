#include "scenarios/common/readings.h"

#include <cmath>

#include "measurements/sensor_file.h"
#include "models/ambient_correction.h"
#include "models/tire/drum_curvature.h"

namespace rollrig::scenarios {
namespace {

constexpr double kReferenceRadius_m = 1.0;
constexpr double kCoverageFactor = 2.0;

double radius_of(const RunSpec& spec) { return spec.rig.drum.diameter_m / 2.0; }

double calc_force_method_N(const Reading& reading, const RunSpec& spec) {
  const double loaded_radius_m = calc_loaded_radius_m(spec.tire.values, reading.load_N);
  return reading.spindle_force_N * (1.0 + loaded_radius_m / radius_of(spec));
}

}  // namespace

Reading take_reading(const sim::Recording<double>& recording, const Window& window, double interval_s) {
  const auto mean = [&](const char* channel) {
    return calc_window_mean(recording.time_s, recording.channel(channel), window, interval_s);
  };
  Reading reading;
  reading.window = window;
  reading.samples = count_window_samples(recording.time_s, recording.channel("drum_torque_Nm"), window, interval_s);
  reading.load_N = mean("load_N");
  reading.speed_m_s = mean("speed_km_h");
  reading.ambient_K = mean("ambient_degC");
  reading.drum_torque_Nm = mean("drum_torque_Nm");
  reading.spindle_force_N = mean("spindle_force_N");
  reading.liner_temperature_K = mean("liner_temperature_degC");
  reading.pressure_Pa = mean("cavity_pressure_kPa");
  return reading;
}

Cycle evaluate_cycle(const Reading& loaded, const Reading& skim, const RunSpec& spec) {
  Cycle cycle;
  cycle.loaded = loaded;
  cycle.skim = skim;
  cycle.parasitic_N = skim.drum_torque_Nm / radius_of(spec);
  cycle.rolling_resistance_N = loaded.drum_torque_Nm / radius_of(spec) - cycle.parasitic_N;
  cycle.rrc = cycle.rolling_resistance_N / loaded.load_N;
  cycle.force_method_N = calc_force_method_N(loaded, spec) - calc_force_method_N(skim, spec);
  return cycle;
}

std::vector<LoadRange> find_test_ranges(const sim::Recording<double>& recording, const RunSpec& spec, double from_s) {
  std::vector<double> time_s;
  std::vector<double> load_N;
  std::vector<double> speed_m_s;
  for (std::size_t i = 0; i < recording.row_count(); ++i) {
    if (recording.time_s[i] < from_s - 1e-9) continue;
    time_s.push_back(recording.time_s[i]);
    load_N.push_back(recording.channel("load_N")[i]);
    speed_m_s.push_back(recording.channel("speed_km_h")[i]);
  }
  return find_load_ranges(time_s, load_N, speed_m_s, calc_skim_limit_N(spec.rig), kShortestRange_s);
}

std::vector<Cycle> find_cycles(const sim::Recording<double>& recording, const RunSpec& spec,
                               const DrumConditions& conditions, double from_s) {
  const std::vector<LoadRange> ranges = find_test_ranges(recording, spec, from_s);
  const auto read = [&](const LoadRange& range) {
    return take_reading(recording, find_last_window(range, conditions.window_s, conditions.margin_s),
                        spec.sample_interval_s);
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
  const double to_2m = models::calc_drum_correction(1.0 / radius_of(spec), 1.0 / kReferenceRadius_m, tire_radius_m);
  return rrc * to_2m * models::calc_ambient_correction(ambient_K);
}

bool is_correction_valid(double ambient_K) { return models::is_ambient_correction_valid(ambient_K); }

models::SensorParameters find_torque_sensor(const RunSpec& spec) {
  constexpr const char* kTorque = "drum_torque_Nm";
  if (spec.sensors.has_value() && spec.sensors->count(kTorque) > 0) return spec.sensors->at(kTorque);
  return measurements::read_sensor_asset("source").at(kTorque);
}

RrcUncertainty calc_rrc_uncertainty(const Cycle& cycle, const RunSpec& spec) {
  const models::SensorParameters sensor = find_torque_sensor(spec);
  const double to_rrc = correct_rrc(1.0 / (radius_of(spec) * cycle.loaded.load_N), cycle.loaded.ambient_K, spec);
  const double variance = models::calc_difference_variance(sensor, cycle.loaded.samples, spec.sample_interval_s,
                                                           cycle.skim.window.start_s - cycle.loaded.window.start_s);
  RrcUncertainty uncertainty;
  uncertainty.offset_cancelled = kCoverageFactor * std::sqrt(variance) * to_rrc;
  uncertainty.offset_kept = kCoverageFactor * sensor.offset_sd * to_rrc;
  return uncertainty;
}

Json to_json(const Cycle& cycle) {
  return {{"start_s", cycle.loaded.window.start_s},
          {"end_s", cycle.loaded.window.end_s},
          {"skim_start_s", cycle.skim.window.start_s},
          {"skim_end_s", cycle.skim.window.end_s},
          {"load_N", cycle.loaded.load_N},
          {"speed_km_h", unit_of_key("speed_km_h").from_si(cycle.loaded.speed_m_s)},
          {"drum_torque_Nm", cycle.loaded.drum_torque_Nm},
          {"skim_torque_Nm", cycle.skim.drum_torque_Nm},
          {"parasitic_N", cycle.parasitic_N},
          {"rolling_resistance_N", cycle.rolling_resistance_N},
          {"rrc_N_per_kN", 1e3 * cycle.rrc},
          {"force_method_N", cycle.force_method_N},
          {"liner_temperature_degC", cycle.loaded.liner_temperature_K - kZeroCelsius_K},
          {"cavity_pressure_kPa", cycle.loaded.pressure_Pa / 1e3}};
}

namespace {

std::vector<std::string> cycle_row(const Cycle& cycle) {
  return {fmt::format("{:.0f}", cycle.loaded.window.end_s),
          fmt::format("{:.0f}", cycle.loaded.load_N),
          fmt::format("{:.0f}", 3.6 * cycle.loaded.speed_m_s),
          fmt::format("{:.2f}", cycle.loaded.drum_torque_Nm),
          fmt::format("{:.2f}", cycle.parasitic_N),
          fmt::format("{:.2f}", cycle.rolling_resistance_N),
          fmt::format("{:.3f}", 1e3 * cycle.rrc),
          fmt::format("{:.1f}", cycle.loaded.liner_temperature_K - kZeroCelsius_K),
          fmt::format("{:.1f}", cycle.loaded.pressure_Pa / 1e3)};
}

}  // namespace

void add_cycles(const std::string& title, const std::vector<Cycle>& cycles, Outcome& outcome) {
  ResultTable table{
      title, {"end s", "load N", "km/h", "torque Nm", "skim N", "F_r N", "RRc N/kN", "liner C", "kPa"}, {}};
  outcome.result["cycles"] = Json::array();
  for (const Cycle& cycle : cycles) {
    outcome.result["cycles"].push_back(to_json(cycle));
    table.rows.push_back(cycle_row(cycle));
  }
  outcome.tables.push_back(table);
}

}  // namespace rollrig::scenarios
