/// Load sweep (§3.2.4.1): RRc at several loads, one after the other on a tire that stays warm.
#include <algorithm>

#include "scenarios/common/drum_bench.h"
#include "scenarios/common/settling.h"

namespace rollrig::scenarios::load_sweep {

struct Settings : SteadyCycleSettings {
  std::vector<double> loads_N;
  double measurement_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    SteadyCycleSettings::visit(p, visit);
    visit(Field{"loads_N", between(100.0, 100000.0),
                "Loads in the order in which they are run; default: those of Tables 3.3 and 3.4 for the tire"},
          p.loads_N);
    visit(Field{"measurement_min", between(1.0, 600.0),
                "Load of each measurement cycle (§3.2.1 item 8), after settle_min", 10.0},
          p.measurement_s);
  }

  void complete(const RunSpec& spec) {
    complete_as_on_vehicle(conditions, spec);
    SteadyCycleSettings::complete(spec);
  }
};

struct Results {
  std::vector<SteadyCycle> cycles;
  double rrc_span = 0.0;
  std::optional<double> load_exponent;

  void visit(ResultSheet& visit) const {
    visit(ResultList{"cycles", "Load sweep", "the measurement cycle of each load", kCycleWindows}, cycles);
    visit(Result{"rrc_span_N_per_kN", "RRc, largest less smallest", ".3f", "largest less smallest RRc"}, rrc_span);
    visit(Result{"steady_state_load_exponent", "", ".3f", "slope of ln F_r over ln load"}.or_left_out(), load_exponent);
    visit(JointLine{"F_r goes with load to the power", "{steady_state_load_exponent} (steady state)"});
    visit(
        Summary{"RRc is {cycles.first.rrc_N_per_kN} at {cycles.first.load_N} and {cycles.last.rrc_N_per_kN} at "
                "{cycles.last.load_N}: rolling resistance goes with load to the power {steady_state_load_exponent}."});
    visit(
        Summary{"RRc is {cycles.first.rrc_N_per_kN} at {cycles.first.load_N} and {cycles.last.rrc_N_per_kN} at "
                "{cycles.last.load_N}."});
    visit(Headline{"RRc at {cycles.first.load_N}", "{cycles.first.rrc_N_per_kN}", "first load"});
    visit(Headline{"RRc at {cycles.last.load_N}", "{cycles.last.rrc_N_per_kN}", "last load"});
    visit(Headline{"Load exponent", "{steady_state_load_exponent}", "rolling resistance goes with load to this power"});
    visit(Headline{"RRc, largest less smallest", "{rrc_span_N_per_kN}"});
  }
};

std::vector<double> loads_of(const Settings& settings, const RunSpec& spec) {
  return settings.loads_N.empty() ? default_sweep_loads_N(spec) : settings.loads_N;
}

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  DrumProgram program(settings.conditions, spec);
  program.begin_test("load-sweep");
  for (const double load_N : loads_of(settings, spec)) {
    check_test_load(spec, "loads_N", load_N);
    program.roll(fmt::format("warm-up {:.0f} N", load_N), *settings.warm_up_s, load_N);
    program.skim(fmt::format("warm-up skim {:.0f} N", load_N), settings.skim_s);
    program.roll(fmt::format("measurement {:.0f} N", load_N), settings.settle_s + settings.measurement_s, load_N);
    program.skim(fmt::format("skim {:.0f} N", load_N), settings.skim_s);
  }
  return program;
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> all = find_cycles(outcome.recording, spec, settings.conditions);
  Results results;
  std::vector<double> load_N, loss_N, rrc;
  Settings held = settings;
  held.settle_s = kHeld_s;
  const SettlingTest settling = simulate_settling(settings, held, spec, &plan);
  for (std::size_t i = 1; i < all.size(); i += 2) {  // of each load, the cycle after its warm-up cycle
    results.cycles.push_back({all[i], settling.find_unsettled(i, i)});
    load_N.push_back(all[i].loaded.load_N);
    loss_N.push_back(all[i].rolling_resistance_N);
    rrc.push_back(all[i].rrc);
  }
  const auto [low, high] = std::minmax_element(rrc.begin(), rrc.end());
  results.rrc_span = *high - *low;
  if (const auto warning = warn_of_unsettled(results.cycles)) outcome.warnings.push_back(*warning);
  if (!has_two_values(loads_of(settings, spec))) return results;
  if (const auto warning = warn_of_no_power(loss_N)) {
    outcome.warnings.push_back(*warning);
  } else {
    results.load_exponent = fit_power(load_N, loss_N);
  }
  return results;
}

Scenario make() {
  return make_drum_scenario(
      {"load_sweep", "RRc at several loads, one speed, one cold pressure",
       "Soak, pressure, run-up, then at each load a warm-up cycle (30 min and 3 min skim) and a measurement cycle "
       "(10 min and 3 min skim), without a pause; the measurement cycle is reported. It is longer by settle_min: ten "
       "minutes after a skim test, the tire is not in steady state.",
       "Kolekar and Narasimhan (2024) §3.2.4.1, §4.1.3, Tables 3.3 and 3.4"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::load_sweep
