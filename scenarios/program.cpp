/// A drum test that a file gives row by row: speed, load and air over time.
#include <algorithm>

#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"
#include "scenarios/common/recorded_inputs.h"
#include "sim/core/file_io.h"

namespace rollrig::scenarios {
namespace {

/// Conditions of which the file gives most.
struct ProgramConditions : DrumConditions {
  FilePath program;
  Choice tire_state{"soaked", {"soaked", "warm"}};
  Choice force_at_standstill{"no", {"no", "yes"}};
  measurements::MeasuredRun run;  // what the file holds

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"program", any_number(),
                "CSV: time_s, speed_km_h, load_N, ambient_degC, and surface_temperature_degC where known; a load holds "
                "until the next row, all else goes straight from row to row. A run file of a drum set will do: "
                "measured columns are not read"},
          p.program);
    visit(Field{"pressure_kPa", between(50.0, 1000.0),
                "Gauge pressure set after the soak; default: the tire's [iso_28580] pressure"},
          p.pressure_Pa);
    visit(Field{"initial_tire_temperature_degC", between(-60.0, 120.0),
                "Tire at the start of the soak; default: as the air of the first row"},
          p.initial_tire_K);
    visit(Field{"soak_h", between(0.0, 48.0), "Rest at the air of the first row", 3.0}, p.soak_s);
    visit(Field{"pressure_check_min", between(0.0, 120.0), "From setting the pressure to verifying it", 10.0},
          p.pressure_check_s);
    visit(Field{"rest_before_min", between(0.0, 1e5),
                "Standstill after driving that lies before the soak; effects that remember, such as flat_spot, start "
                "accordingly; default: soaked for so long that nothing remembers"},
          p.rest_before_s);
    visit(Field{"tire_state", any_number(), "warm: the soak begins right after another run"}, p.tire_state);
    visit(Field{"force_at_standstill", any_number(),
                "yes: with --write-set, the set says that the torque read at standstill is the sensor's zero"},
          p.force_at_standstill);
    visit(Field{"run_up_s", between(1.0, 3600.0),
                "From standstill to the first row's speed, at skim load or the first row's where that is less; none "
                "where the first row stands. Assumed: 60 s",
                60.0},
          p.run_up_s);
    visit(Field{"window_s", between(1.0, 3600.0), "Averaged at the end of a stretch of constant load and speed", 60.0},
          p.window_s);
    visit(Field{"margin_s", between(0.0, 600.0),
                "Left out before and after a change of load (B.2: a few seconds). Assumed: 2 s", 2.0},
          p.margin_s);
  }

  const std::vector<double>& column(const char* name) const { return run.columns.at(name); }

  void complete(const RunSpec& spec) {
    run = measurements::read_run_inputs(program.path, measurements::SetKind::kDrum);
    load_N = *std::max_element(column("load_N").begin(), column("load_N").end());
    check_tire_carries(spec, "program", *load_N);
    if (!pressure_Pa.has_value()) pressure_Pa = find_default_pressure_Pa(spec);
    speed_m_s = column("speed_km_h").front();
    ambient_K = column("ambient_degC").front();
    if (run.has("surface_temperature_degC")) surface_K = column("surface_temperature_degC").front();
    if (!initial_tire_K.has_value()) initial_tire_K = ambient_K;
    started_warm = tire_state.value == "warm";
    if (started_warm && rest_before_s.has_value()) {
      throw InputError(setting_problem(spec, "rest_before_min", "a tire that starts warm has not rested",
                                       "rest_before_min, or tire_state = \"warm\""));
    }
  }
};

struct Settings {
  ProgramConditions conditions;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    ProgramConditions::visit(p.conditions, visit);
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  const ProgramConditions& conditions = settings.conditions;
  DrumProgram program(conditions, spec.rig, spec.sample_interval_s);
  program.begin_test_under(conditions.run.id, *conditions.pressure_Pa, conditions.speed_m_s,
                           std::min(spec.rig.skim.load_N, conditions.column("load_N").front()));
  program.mark_time_zero();
  program.follow("program", conditions.run);
  return program;
}

Json to_json(const Reading& reading, double radius_m) {
  return {{"start_s", reading.window.start_s},
          {"end_s", reading.window.end_s},
          {"load_N", reading.load_N},
          {"speed_km_h", unit_of_key("speed_km_h").from_si(reading.speed_m_s)},
          {"drum_torque_Nm", reading.drum_torque_Nm},
          {"force_N", reading.drum_torque_Nm / radius_m},
          {"liner_temperature_degC", reading.liner_temperature_K - kZeroCelsius_K},
          {"cavity_pressure_kPa", reading.pressure_Pa / 1e3}};
}

/// Every stretch of constant load and speed that is long enough to be averaged.
std::vector<Reading> read_stretches(const ProgramConditions& conditions, const RunSpec& spec,
                                    const sim::Recording<double>& recording) {
  std::vector<Reading> readings;
  for (const LoadRange& range : find_test_ranges(recording, spec, 0.0)) {
    const Window window = find_last_window(range, conditions.window_s, conditions.margin_s);
    if (count_window_samples(recording.time_s, recording.channel("drum_torque_Nm"), window, spec.sample_interval_s) > 0)
      readings.push_back(take_reading(recording, window, spec.sample_interval_s));
  }
  return readings;
}

void add_stretches(const std::vector<Reading>& readings, double radius_m, Outcome& outcome) {
  ResultTable table{"Stretches of constant load and speed",
                    {"end s", "load N", "km/h", "torque Nm", "force N", "liner C", "kPa"},
                    {}};
  outcome.result["stretches"] = Json::array();
  for (const Reading& reading : readings) {
    outcome.result["stretches"].push_back(to_json(reading, radius_m));
    table.rows.push_back({fmt::format("{:.0f}", reading.window.end_s), fmt::format("{:.0f}", reading.load_N),
                          fmt::format("{:.0f}", 3.6 * reading.speed_m_s), fmt::format("{:.2f}", reading.drum_torque_Nm),
                          fmt::format("{:.2f}", reading.drum_torque_Nm / radius_m),
                          fmt::format("{:.1f}", reading.liner_temperature_K - kZeroCelsius_K),
                          fmt::format("{:.1f}", reading.pressure_Pa / 1e3)});
  }
  if (!readings.empty()) outcome.tables.push_back(table);
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const ProgramConditions& conditions = settings.conditions;
  const double radius_m = spec.rig.drum.diameter_m / 2.0;
  const auto last = [&](const char* channel) { return outcome.recording.channel(channel).back(); };
  const std::vector<double>& liner_K = outcome.recording.channel("liner_temperature_degC");
  const double duration_s = conditions.run.time_s.back() - conditions.run.time_s.front();
  const double distance_km = calc_distance_m(conditions.run) / 1e3;
  const double hottest_degC = *std::max_element(liner_K.begin(), liner_K.end()) - kZeroCelsius_K;
  outcome.settings["program_sha256"] = calc_sha256(read_text_file(conditions.program.path));
  outcome.result["duration_s"] = duration_s;
  outcome.result["distance_km"] = distance_km;
  outcome.result["liner_temperature_max_degC"] = hottest_degC;
  outcome.result["liner_temperature_end_degC"] = last("liner_temperature_degC") - kZeroCelsius_K;
  outcome.result["cavity_pressure_end_kPa"] = last("cavity_pressure_kPa") / 1e3;
  add_stretches(read_stretches(conditions, spec, outcome.recording), radius_m, outcome);
  outcome.lines = {{"Program", conditions.run.id},
                   {"Duration, distance", fmt::format("{:.1f} min, {:.2f} km", duration_s / 60.0, distance_km)},
                   {"Highest liner temperature", fmt::format("{:.1f} degC", hottest_degC)},
                   {"Pressure set / at the end", fmt::format("{:.1f} / {:.1f} kPa", *conditions.pressure_Pa / 1e3,
                                                             last("cavity_pressure_kPa") / 1e3)}};
  // What a set says of its run is what lay before it: the soak counts as rest.
  for (SetRun& run : outcome.set_runs) {
    const bool remembers = conditions.started_warm || conditions.rest_before_s.has_value();
    const double rested_s = conditions.rest_before_s.value_or(0.0) + conditions.soak_s + conditions.pressure_check_s;
    if (remembers && rested_s > 0.0) run.rest_before_s = rested_s;
    run.started_warm = conditions.started_warm && rested_s <= 0.0;
    run.force_at_standstill = conditions.force_at_standstill.value == "yes";
  }
}

}  // namespace

const Scenario& scenario_program() {
  static const Scenario scenario = make_drum_scenario<Settings>(
      {"program",
       "Any program of speed and load that a file gives, row by row",
       "Soak, pressure and run-up to the first row's speed, then speed, load and air as the file has them; its first "
       "row is 0 s. Reads off every stretch of constant load and speed. `rollrig diagnose --plan` writes such files.",
       "formats.md: a run of a measurement set",
       {{"duration_s", "of the file's rows"},
        {"distance_km", "rolled in them"},
        {"liner_temperature_max_degC", "highest liner temperature"},
        {"liner_temperature_end_degC", "liner temperature at the end"},
        {"cavity_pressure_end_kPa", "pressure at the end"},
        {"stretches",
         "torque, force at the drum's surface, temperature and pressure of the last minute of each stretch of constant "
         "load and speed"}}},
      &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
