/// Skim test: the parasitic loss as a rig measures it, and what of it is the tire's (§3.2.1 item 6).
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {
namespace {

struct Settings {
  DrumConditions conditions;
  CycleTimes times;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DrumConditions::visit(p.conditions, visit);
    CycleTimes::visit(p.times, visit);
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  const DrumConditions& conditions = settings.conditions;
  DrumProgram program(conditions, spec.rig, spec.sample_interval_s);
  program.begin_test("skim", *conditions.pressure_Pa, conditions.speed_m_s);
  program.mark_time_zero();
  program.roll("warm-up", settings.times.warm_up_s, *conditions.load_N);
  program.roll("skim", settings.times.skim_s, spec.rig.skim.load_N);
  return program;
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> cycles = find_cycles(outcome.recording, spec, settings.conditions, 0.0);
  const Cycle& cycle = cycles.back();
  const auto simulated = [&](const char* channel) {
    return calc_window_mean(outcome.recording.time_s, outcome.recording.channel(channel), cycle.skim.window,
                            spec.sample_interval_s);
  };
  const double rig_N = simulated("parasitic_N");
  const double tire_N = simulated("rolling_resistance_N");
  outcome.result = {{"skim_load_N", cycle.skim.load_N},
                    {"speed_km_h", unit_of_key("speed_km_h").from_si(cycle.skim.speed_m_s)},
                    {"drum_torque_Nm", cycle.skim.drum_torque_Nm},
                    {"parasitic_N", cycle.parasitic_N},
                    {"rig_alone_N", rig_N},
                    {"tire_share_N", tire_N},
                    {"liner_temperature_degC", cycle.skim.liner_temperature_K - kZeroCelsius_K}};
  outcome.lines = {
      {"Skim load, speed", fmt::format("{:.0f} N, {:.1f} km/h", cycle.skim.load_N, 3.6 * cycle.skim.speed_m_s)},
      {"Drum torque", fmt::format("{:.3f} Nm", cycle.skim.drum_torque_Nm)},
      {"Parasitic loss as measured", fmt::format("{:.3f} N", cycle.parasitic_N)},
      {"  of it the rig alone", fmt::format("{:.3f} N (simulated)", rig_N)},
      {"  of it the tire", fmt::format("{:.3f} N (simulated)", tire_N)},
      {"Liner temperature", fmt::format("{:.1f} degC", cycle.skim.liner_temperature_K - kZeroCelsius_K)}};
}

}  // namespace

const Scenario& scenario_skim() {
  static const Scenario scenario = make_drum_scenario<Settings>(
      {"skim",
       "Skim test after a warm-up: parasitic loss as measured, and the tire's part in it",
       "Soak, pressure, run-up, 30 min under load, then 3 min at skim load; the last minute is averaged.",
       "source §3.2.1 items 5 and 6, §5.2",
       {{"parasitic_N", "skim torque over drum radius"},
        {"rig_alone_N", "what the rig alone loses, which only a simulation knows"},
        {"tire_share_N", "what the tire still loses at skim load"}}},
      &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
