/// Skim tests spread over the warm-up (§3.2.7): does the parasitic loss change as the tire warms?
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios::transient_skim {

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

  void complete(const RunSpec& spec) { conditions.complete(spec); }

  Settings() {
    conditions.load_N = kVehicleLoad_N;  // §4.1.7: the load of all these tests
    conditions.pressure_Pa = kVehiclePressure_Pa;
  }
};

struct Results {
  std::vector<Cycle> cycles;
  double parasitic_fall_N = 0.0;
  double rolling_resistance_fall_N = 0.0;
  double parasitic_last_N = 0.0;
  double uncertainty_N = 0.0;

  void visit(ResultSheet& visit) const {
    visit(ResultList{"cycles", "Skim tests during the warm-up", "every load and its skim", kCycleWindows}, cycles);
    visit(Result{"parasitic_fall_N", "Parasitic loss, first less last", ".3f", "of skim readings"}, parasitic_fall_N);
    visit(Result{"rolling_resistance_fall_N", "F_r, first less last", ".2f", "of F_r"}, rolling_resistance_fall_N);
    visit(Result{"parasitic_last_N", "Parasitic loss, last", ".3f", "last skim reading"}, parasitic_last_N);
    visit(Result{"uncertainty_N", "Uncertainty of F_r (k = 2)", ".3f", "expanded, of one F_r, offset canceled"},
          uncertainty_N);
    visit(
        Summary{"From the first skim test to the last, the parasitic loss falls by {parasitic_fall_N} and rolling "
                "resistance by "
                "{rolling_resistance_fall_N}. Warm, the parasitic loss is {parasitic_last_N}."});
    visit(Headline{"Parasitic loss falls by", "{parasitic_fall_N}", "from the first skim test to the last"});
    visit(Headline{"Rolling resistance falls by", "{rolling_resistance_fall_N}",
                   "likewise; expanded uncertainty {uncertainty_N}"});
    visit(Headline{"Parasitic loss, warm", "{parasitic_last_N}"});
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  DrumProgram program(settings.conditions, spec);
  program.begin_test("transient-skim");
  for (int i = 1; i <= settings.repeats; ++i) {
    program.roll(fmt::format("load {}", i), settings.load_s);
    program.skim(fmt::format("skim {}", i), settings.skim_s);
  }
  return program;
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> cycles = find_cycles(outcome.recording, spec, settings.conditions);
  const Cycle& first = cycles.front();
  const Cycle& last = cycles.back();
  return {cycles, first.parasitic_N - last.parasitic_N, first.rolling_resistance_N - last.rolling_resistance_N,
          last.parasitic_N, calc_rrc_uncertainty(last, spec).offset_canceled * last.loaded.load_N};
}

Scenario make() {
  return make_drum_scenario(
      {"transient_skim", "Skim tests spread over the warm-up of a cold tire",
       "Soak, pressure, run-up, then loads of 5 min with a skim test of 3 min after each; the last minute of every "
       "load and skim is averaged, and F_r is taken with the skim test that follows.",
       "Kolekar and Narasimhan (2024) §3.2.7, §4.1.7"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::transient_skim
