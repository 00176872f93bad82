/// Pressure sweep (§3.2.4.2): RRc at several cold pressures, each from a soaked tire.
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/sweep_evaluation.h"

namespace rollrig::scenarios {
namespace {

struct Settings {
  DrumConditions conditions;
  CycleTimes times;
  std::vector<double> pressures_Pa{250e3, 280e3, 300e3};  // §3.2.4.2

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DrumConditions::visit(p.conditions, visit);
    CycleTimes::visit(p.times, visit);
    visit(Field{"pressures_kPa", between(50.0, 1000.0), "Gauge pressures, each set on a soaked tire"}, p.pressures_Pa);
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  const DrumConditions& conditions = settings.conditions;
  DrumProgram program(conditions, spec.rig, spec.sample_interval_s);
  for (const double pressure_Pa : settings.pressures_Pa) {
    const std::string at = fmt::format("{:.6g} kPa", pressure_Pa / 1e3);
    program.begin_test(fmt::format("pressure-{:.6g}", pressure_Pa / 1e3), pressure_Pa, conditions.speed_m_s);
    program.mark_time_zero();
    program.roll("warm-up " + at, settings.times.warm_up_s, *conditions.load_N);
    program.roll("skim " + at, settings.times.skim_s, spec.rig.skim.load_N);
    program.end_test();
  }
  return program;
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> cycles = find_cycles(outcome.recording, spec, settings.conditions, 0.0);
  add_cycles("Pressure sweep", cycles, outcome);
  std::vector<double> loss_N;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    outcome.result["cycles"][i]["pressure_set_kPa"] = settings.pressures_Pa[i] / 1e3;
    loss_N.push_back(cycles[i].rolling_resistance_N);
  }
  if (!has_two_values(settings.pressures_Pa)) return;
  const double exponent = fit_power(settings.pressures_Pa, loss_N);
  outcome.result["steady_state_pressure_exponent"] = exponent;
  outcome.result["first_to_second_ratio"] = loss_N[0] / loss_N[1];
  outcome.lines = {
      {"F_r goes with set pressure to the power", fmt::format("{:.3f} (steady state)", exponent)},
      {fmt::format("F_r at {:.0f} kPa over {:.0f} kPa", settings.pressures_Pa[0] / 1e3, settings.pressures_Pa[1] / 1e3),
       fmt::format("{:.4f}", loss_N[0] / loss_N[1])}};
}

}  // namespace

const Scenario& scenario_pressure_sweep() {
  static const Scenario scenario = make_drum_scenario<Settings>(
      {"pressure_sweep",
       "RRc at several cold pressures, one load, one speed",
       "For each pressure: soak, pressure set and verified, run-up, warm-up cycle (30 min and 3 min skim), run-down.",
       "source §3.2.4.2, §4.1.4, (4.1)",
       {{"cycles", "the cycle of each pressure"},
        {"steady_state_pressure_exponent", "slope of ln F_r over ln set pressure"},
        {"first_to_second_ratio", "F_r at the first pressure over that at the second, as in (4.1)"}}},
      &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
