/// Load sweep (§3.2.4.1): RRc at several loads, one after the other on a tire that stays warm.
#include <algorithm>

#include "scenarios/common/drum_bench.h"
#include "scenarios/common/sweep_evaluation.h"

namespace rollrig::scenarios {
namespace {

struct Settings {
  DrumConditions conditions;
  CycleTimes times;
  std::vector<double> loads_N;
  double measurement_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DrumConditions::visit(p.conditions, visit);
    CycleTimes::visit(p.times, visit);
    visit(Field{"loads_N", between(100.0, 100000.0),
                "Loads in the order in which they are run; default: those of Tables 3.3 and 3.4 for the tire"},
          p.loads_N);
    visit(Field{"measurement_min", between(1.0, 600.0), "Load of each measurement cycle (§3.2.1 item 8)", 10.0},
          p.measurement_s);
  }

  Settings() {
    conditions.pressure_Pa = kVehiclePressure_Pa;
    conditions.load_N = kVehicleLoad_N;
  }
};

std::vector<double> loads_of(const Settings& settings, const RunSpec& spec) {
  return settings.loads_N.empty() ? default_sweep_loads_N(spec) : settings.loads_N;
}

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  const DrumConditions& conditions = settings.conditions;
  const double skim_N = spec.rig.skim.load_N;
  DrumProgram program(conditions, spec.rig, spec.sample_interval_s);
  program.begin_test("load-sweep", *conditions.pressure_Pa, conditions.speed_m_s);
  program.mark_time_zero();
  for (const double load_N : loads_of(settings, spec)) {
    check_test_load(spec, "loads_N", load_N);
    program.roll(fmt::format("warm-up {:.0f} N", load_N), settings.times.warm_up_s, load_N);
    program.roll(fmt::format("warm-up skim {:.0f} N", load_N), settings.times.skim_s, skim_N);
    program.roll(fmt::format("measurement {:.0f} N", load_N), settings.measurement_s, load_N);
    program.roll(fmt::format("skim {:.0f} N", load_N), settings.times.skim_s, skim_N);
  }
  return program;
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<double> loads_N = loads_of(settings, spec);
  const std::vector<Cycle> all = find_cycles(outcome.recording, spec, settings.conditions, 0.0);
  std::vector<Cycle> points;  // of each load, the cycle after its warm-up cycle
  for (std::size_t i = 1; i < all.size(); i += 2) points.push_back(all[i]);
  add_cycles("Load sweep", points, outcome);
  std::vector<double> load_N, loss_N, rrc;
  for (const Cycle& point : points) {
    load_N.push_back(point.loaded.load_N);
    loss_N.push_back(point.rolling_resistance_N);
    rrc.push_back(point.rrc);
  }
  const auto [low, high] = std::minmax_element(rrc.begin(), rrc.end());
  outcome.result["rrc_span_N_per_kN"] = 1e3 * (*high - *low);
  outcome.lines.push_back({"RRc, largest less smallest", fmt::format("{:.3f} N/kN", 1e3 * (*high - *low))});
  if (has_two_values(loads_N)) {
    const double exponent = fit_power(load_N, loss_N);
    outcome.result["steady_state_load_exponent"] = exponent;
    outcome.lines.push_back({"F_r goes with load to the power", fmt::format("{:.3f} (steady state)", exponent)});
  }
}

}  // namespace

const Scenario& scenario_load_sweep() {
  static const Scenario scenario = make_drum_scenario<Settings>(
      {"load_sweep",
       "RRc at several loads, one speed, one cold pressure",
       "Soak, pressure, run-up, then at each load a warm-up cycle (30 min and 3 min skim) and a measurement cycle "
       "(10 min and 3 min skim), without a pause; the measurement cycle is reported.",
       "source §3.2.4.1, §4.1.3, Tables 3.3 and 3.4",
       {{"cycles", "the measurement cycle of each load"},
        {"rrc_span_N_per_kN", "largest less smallest RRc"},
        {"steady_state_load_exponent", "slope of ln F_r over ln load"}}},
      &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
