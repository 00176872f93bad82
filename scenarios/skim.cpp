/// Skim test: the parasitic loss as a rig measures it, and what of it is the tire's (§3.2.1 item 6).
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios::skim {

struct Results {
  Cycle cycle;
  double rig_alone_N = 0.0;
  double tire_share_N = 0.0;

  void visit(ResultSheet& visit) const {
    const Reading& skim = cycle.skim;
    visit(Result{"skim_load_N", "", ".0f", "mean load"}, skim.load_N);
    visit(Result{"speed_km_h", "", ".1f", "mean speed"}, skim.speed_m_s);
    visit(JointLine{"Skim load, speed", "{skim_load_N}, {speed_km_h}"});
    visit(Result{"drum_torque_Nm", "Drum torque", ".3f", "mean motor torque; none on a belt"}.or_left_out(),
          skim.drum_torque_Nm);
    visit(Result{"parasitic_N", "Parasitic loss as measured", ".2f", "skim torque over drum radius"},
          cycle.parasitic_N);
    visit(Result{"rig_alone_N", "  of it the rig alone (simulated)", ".2f",
                 "what the rig alone loses, which only a simulation knows"},
          rig_alone_N);
    visit(Result{"tire_share_N", "  of it the tire (simulated)", ".2f", "what the tire still loses at skim load"},
          tire_share_N);
    visit(Result{"liner_temperature_degC", "Liner temperature", ".1f", "mean"}, skim.liner_temperature_K);
    visit(Summary{
        "The skim test reads a parasitic loss of {parasitic_N}: the rig alone loses {rig_alone_N}, the tire that still "
        "touches the drum {tire_share_N}."});
    visit(Headline{"Parasitic loss as measured", "{parasitic_N}", "at {skim_load_N} and {speed_km_h}"});
    visit(Headline{"Of it the rig alone", "{rig_alone_N}", "which only a simulation knows"});
    visit(Headline{"Of it the tire", "{tire_share_N}", "its loss at the skim load"});
  }
};

DrumProgram plan(const CycleSettings& settings, const RunSpec& spec) {
  DrumProgram program(settings.conditions, spec);
  program.begin_test("skim");
  program.roll("warm-up", *settings.warm_up_s);
  program.skim("skim", settings.skim_s);
  return program;
}

Results evaluate(const CycleSettings& settings, const RunSpec& spec, Outcome& outcome) {
  const sim::Recording<double>& recording = outcome.recording;
  Results results;
  results.cycle = find_cycles(recording, spec, settings.conditions).back();
  const Window& window = results.cycle.skim.window;
  results.rig_alone_N = calc_mean(recording, spec, window, quantities::kParasiticLoss);
  results.tire_share_N = calc_mean(recording, spec, window, quantities::kRollingResistance);
  return results;
}

Scenario make() {
  return make_drum_scenario(
      {"skim", "Skim test after a warm-up: parasitic loss as measured, and the tire's part in it",
       "Soak, pressure, run-up, 30 min under load, then 3 min at skim load; the last minute is averaged.",
       "Kolekar and Narasimhan (2024) §3.2.1 items 5 and 6, §5.2"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::skim
