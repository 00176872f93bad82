/// A drum test that a file gives row by row: speed, load and air over time.
#include <algorithm>

#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"
#include "scenarios/common/recorded_inputs.h"

namespace rollrig::scenarios::follow_drum {

/// Conditions of which the file gives most.
struct FollowDrumConditions : DrumConditions {
  FilePath program;
  Choice tire_state{"soaked", {"soaked", "warm"}};
  Choice reads_force_at_standstill{"no", {"no", "yes"}};
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
    visit(Field{"rest_before_min", between(0.0, 1e5),
                "Standstill after driving that lies before the soak; effects that remember, such as flat_spot, start "
                "accordingly; default: soaked for so long that nothing remembers"},
          p.rest_before_s);
    visit(Field{"tire_state", any_number(), "warm: the soak begins right after another run"}, p.tire_state);
    visit(Field{"force_at_standstill", any_number(),
                "yes: with --write-set, the set says that the torque read at standstill is the sensor's zero"},
          p.reads_force_at_standstill);
    visit_procedure(p, visit);
  }

  void complete(const RunSpec& spec) {
    run = measurements::read_run_inputs(program.path, *spec.rig.kind);
    load_N = *std::max_element(run.column(quantities::kLoad).begin(), run.column(quantities::kLoad).end());
    check_tire_carries(spec, "program", *load_N);
    if (!pressure_Pa.has_value()) pressure_Pa = find_default_pressure_Pa(spec);
    speed_m_s = run.column(quantities::kSpeed).front();
    ambient_K = run.column(quantities::kAmbient).front();
    if (run.has(quantities::kSurfaceTemperature)) surface_K = run.column(quantities::kSurfaceTemperature).front();
    if (!initial_tire_K.has_value()) initial_tire_K = ambient_K;
    started_warm = tire_state.value == "warm";
    force_at_standstill = reads_force_at_standstill.value == "yes";
    check_rest(spec, started_warm, rest_before_s);
  }
};

using Settings = OnlyConditions<FollowDrumConditions>;

struct Stretch {
  Reading reading;

  void visit(ResultSheet& visit) const {
    visit(Result{"start_s", "start", ".0f", "start of the window that is averaged"}, reading.window.start_s);
    visit(Result{"end_s", "end", ".0f", "its end"}, reading.window.end_s);
    visit(Result{"load_N", "load", ".0f", "mean load"}, reading.load_N);
    visit(Result{"speed_km_h", "", ".1f", "mean speed"}, reading.speed_m_s);
    visit(Result{"drum_torque_Nm", "torque", ".2f", "mean motor torque; none on a belt"}.or_left_out(),
          reading.drum_torque_Nm);
    visit(Result{"force_N", "force", ".2f", "the same at the surface"}, reading.force_N);
    visit(Result{"liner_temperature_degC", "liner", ".1f", "mean"}, reading.liner_temperature_K);
    visit(Result{"cavity_pressure_kPa", "", ".1f", "mean, gauge"}, reading.pressure_Pa);
  }
};

struct Results {
  FollowedRows rows;
  TireCourse tire;
  std::vector<Stretch> stretches;

  void visit(ResultSheet& visit) const {
    rows.visit(visit);
    tire.visit(visit);
    visit(ResultList{"stretches", "Stretches of constant load and speed",
                     "means over the last minute of each stretch of constant load and speed"},
          stretches);
    visit(
        Summary{"At the end, rolling at {stretches.last.speed_km_h} under {stretches.last.load_N} takes "
                "{stretches.last.force_N}. The liner was at most {liner_temperature_max_degC} warm."});
    visit(Summary{
        "The tire rolled {distance_km} in {duration_s}. Its liner was at most {liner_temperature_max_degC} warm."});
    visit(Headline{"Force of the last stretch", "{stretches.last.force_N}",
                   "at {stretches.last.load_N} and {stretches.last.speed_km_h}"});
    visit(Headline{"Highest liner temperature", "{liner_temperature_max_degC}"});
    visit(Headline{"Pressure at the end", "{cavity_pressure_end_kPa}"});
    visit(Headline{"Distance", "{distance_km}", "in {duration_s}"});
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  const measurements::MeasuredRun& run = settings.conditions.run;
  DrumProgram program(settings.conditions, spec);
  program.begin_test(run.id, {{}, {}, std::min(spec.rig.skim.load_N, run.column(quantities::kLoad).front())});
  program.follow("program", run, *spec.rig.kind);
  return program;
}

/// Every stretch of constant load and speed that is long enough to be averaged.
std::vector<Stretch> read_stretches(const FollowDrumConditions& conditions, const RunSpec& spec,
                                    const sim::Recording<double>& recording) {
  std::vector<Stretch> stretches;
  for (const LoadRange& range : find_test_ranges(recording, spec)) {
    const Window window = find_last_window(range, conditions.window_s, conditions.margin_s);
    const std::vector<double>& force = recording.channel(spec.rig.kind->traits.force);
    if (count_window_samples(recording.time_s, force, window, spec.sample_interval_s) == 0) continue;
    stretches.push_back({take_reading(recording, spec, window)});
  }
  return stretches;
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const FollowDrumConditions& conditions = settings.conditions;
  return {measure_rows(conditions.run), read_tire_course(outcome.recording, *conditions.pressure_Pa),
          read_stretches(conditions, spec, outcome.recording)};
}

Scenario make() {
  return make_drum_scenario(
      {"follow_drum", "Any program of speed and load that a file gives, row by row",
       "Soak at the first row's air, pressure, run-up to its speed at skim load or its own where that is less (none "
       "where it stands), then speed, load and air as the file has them; the first row is 0 s. Reads off every stretch "
       "of constant load and speed. `rollrig diagnose --plan` writes such files.",
       "formats.md: a run of a measurement set", "program"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::follow_drum
