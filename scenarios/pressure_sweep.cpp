/// Pressure sweep (§3.2.4.2): RRc at several cold pressures, each from a soaked tire.
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/settling.h"

namespace rollrig::scenarios::pressure_sweep {

struct Settings : SteadyCycleSettings {
  std::vector<double> pressures_Pa{250e3, 280e3, 300e3};  // §3.2.4.2

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    SteadyCycleSettings::visit(p, visit);
    visit(Field{"pressures_kPa", between(50.0, 1000.0), "Gauge pressures, each set on a soaked tire"}, p.pressures_Pa);
  }
};

struct PressureCycle {
  SteadyCycle steady;
  double pressure_set_Pa = 0.0;

  void visit(ResultSheet& visit) const {
    steady.visit(visit);
    visit(Result{"pressure_set_kPa", "set", ".0f", "as set after the soak, gauge"}, pressure_set_Pa);
  }
};

struct Results {
  std::vector<PressureCycle> cycles;
  std::optional<double> exponent;
  std::optional<double> first_to_second;

  void visit(ResultSheet& visit) const {
    visit(ResultList{"cycles", "Pressure sweep", "the cycle of each pressure", kCycleWindows}, cycles);
    visit(Result{"steady_state_pressure_exponent", "", ".3f", "slope of ln F_r over ln set pressure"}.or_left_out(),
          exponent);
    visit(JointLine{"F_r goes with set pressure to the power", "{steady_state_pressure_exponent} (steady state)"});
    visit(Result{"first_to_second_ratio", "F_r at the first pressure over the second", ".4f",
                 "F_r at the first pressure over that at the second, as in (4.1)"}
              .or_left_out(),
          first_to_second);
    visit(Summary{
        "RRc is {cycles.first.rrc_N_per_kN} at {cycles.first.pressure_set_kPa} and {cycles.last.rrc_N_per_kN} at "
        "{cycles.last.pressure_set_kPa}: rolling resistance goes with pressure to the power "
        "{steady_state_pressure_exponent}."});
    visit(Summary{
        "RRc is {cycles.first.rrc_N_per_kN} at {cycles.first.pressure_set_kPa} and {cycles.last.rrc_N_per_kN} at "
        "{cycles.last.pressure_set_kPa}."});
    visit(Headline{"RRc at {cycles.first.pressure_set_kPa}", "{cycles.first.rrc_N_per_kN}", "first pressure"});
    visit(Headline{"RRc at {cycles.last.pressure_set_kPa}", "{cycles.last.rrc_N_per_kN}", "last pressure"});
    visit(Headline{"Pressure exponent", "{steady_state_pressure_exponent}",
                   "rolling resistance goes with pressure to this power"});
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  DrumProgram program(settings.conditions, spec);
  for (const double pressure_Pa : settings.pressures_Pa) {
    const std::string at = fmt::format("{:.6g} kPa", pressure_Pa / 1e3);
    program.begin_test(fmt::format("pressure-{:.6g}", pressure_Pa / 1e3), {pressure_Pa, {}, {}});
    program.roll("warm-up " + at, *settings.warm_up_s + settings.settle_s);
    program.skim("skim " + at, settings.skim_s);
    program.end_test();
  }
  return program;
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  Results results;
  std::vector<SteadyCycle> steady;
  std::vector<double> loss_N;
  Settings held = settings;
  held.settle_s = kHeld_s;
  const SettlingTest settling = simulate_settling(settings, held, spec, &plan);
  for (const Cycle& cycle : find_cycles(outcome.recording, spec, settings.conditions)) {
    steady.push_back({cycle, settling.find_unsettled(loss_N.size(), loss_N.size())});
    results.cycles.push_back({steady.back(), settings.pressures_Pa[loss_N.size()]});
    loss_N.push_back(cycle.rolling_resistance_N);
  }
  if (const auto warning = warn_of_unsettled(steady)) outcome.warnings.push_back(*warning);
  if (!has_two_values(settings.pressures_Pa)) return results;
  if (const auto warning = warn_of_no_power(loss_N)) {
    outcome.warnings.push_back(*warning);
  } else {
    results.exponent = fit_power(settings.pressures_Pa, loss_N);
    results.first_to_second = loss_N[0] / loss_N[1];
  }
  return results;
}

Scenario make() {
  return make_drum_scenario(
      {"pressure_sweep", "RRc at several cold pressures, one load, one speed",
       "For each pressure: soak, pressure set and verified, run-up, warm-up cycle (30 min and 3 min skim), run-down. "
       "The warm-up cycle is longer by settle_min, after which the tire is in steady state.",
       "Kolekar and Narasimhan (2024) §3.2.4.2, §4.1.4, (4.1)"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::pressure_sweep
