/// Skim tests spread over the warm-up (§3.2.7): does the parasitic loss change as the tire warms?
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {
namespace {

struct Settings {
  DrumConditions conditions;
  double load_s = 0.0;
  double skim_s = 0.0;
  int repeats = 0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DrumConditions::visit(p.conditions, visit);
    visit(Field{"load_min", between(1.0, 120.0),
                "Load before each skim test. Assumed: 5 min (Figure 3.12 has no scale)", 5.0},
          p.load_s);
    visit(Field{"skim_min", between(0.5, 60.0), "Each skim test (§3.2.1 item 7)", 3.0}, p.skim_s);
    visit(Field{"repeats", between(1.0, 100.0),
                "Number of loads with a skim test after each. Assumed: 6, for 30 min of load", 6.0},
          p.repeats);
  }

  Settings() {
    conditions.load_N = 5400.0;      // §4.1.7: the load of all these tests
    conditions.pressure_Pa = 280e3;  // §3.3.1.2: the pressure that goes with it
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  const DrumConditions& conditions = settings.conditions;
  DrumProgram program(conditions, spec.rig, spec.sample_interval_s);
  program.begin_test("transient-skim", *conditions.pressure_Pa, conditions.speed_m_s);
  program.mark_time_zero();
  for (int i = 1; i <= settings.repeats; ++i) {
    program.roll(fmt::format("load {}", i), settings.load_s, *conditions.load_N);
    program.roll(fmt::format("skim {}", i), settings.skim_s, spec.rig.skim.load_N);
  }
  return program;
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> cycles = find_cycles(outcome.recording, spec, settings.conditions, 0.0);
  add_cycles("Skim tests during the warm-up", cycles, outcome);
  const double fall_N = cycles.front().parasitic_N - cycles.back().parasitic_N;
  outcome.result["parasitic_fall_N"] = fall_N;
  outcome.result["rolling_resistance_fall_N"] =
      cycles.front().rolling_resistance_N - cycles.back().rolling_resistance_N;
  outcome.result["parasitic_last_N"] = cycles.back().parasitic_N;
  outcome.result["uncertainty_N"] =
      calc_rrc_uncertainty(cycles.back(), spec).offset_cancelled * cycles.back().loaded.load_N;
  outcome.lines = {
      {"Parasitic loss, first to last",
       fmt::format("{:.3f} to {:.3f} N", cycles.front().parasitic_N, cycles.back().parasitic_N)},
      {"Rolling resistance, first to last",
       fmt::format("{:.2f} to {:.2f} N", cycles.front().rolling_resistance_N, cycles.back().rolling_resistance_N)}};
}

}  // namespace

const Scenario& scenario_transient_skim() {
  static const Scenario scenario = make_drum_scenario<Settings>(
      {"transient_skim",
       "Skim tests spread over the warm-up of a cold tire",
       "Soak, pressure, run-up, then loads of 5 min with a skim test of 3 min after each; the last minute of every "
       "load and skim is averaged, and F_r is taken with the skim test that follows.",
       "source §3.2.7, §4.1.7",
       {{"cycles", "every load with its skim test"},
        {"parasitic_fall_N", "first skim reading less the last"},
        {"rolling_resistance_fall_N", "first F_r less the last"},
        {"uncertainty_N", "expanded (k = 2), of one F_r, offset canceled"}}},
      &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
