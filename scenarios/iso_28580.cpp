/// ISO 28580: the whole rolling-resistance test of one tire, as in §3.2.3.
#include <cmath>
#include <tuple>

#include "models/tire/conversion_laws.h"
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/iso_uncertainty.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios::iso_28580 {

struct Settings : CycleSettings {
  int measurement_cycles = 0;
  double measurement_s = 0.0;
  IsoAccuracies accuracies;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    CycleSettings::visit(p, visit);
    visit(Field{"measurement_cycles", between(0.0, 100.0), "Measurement cycles after the warm-up cycle (§3.2.1 item 8)",
                0.0},
          p.measurement_cycles);
    visit(Field{"measurement_min", between(1.0, 600.0), "Load of a measurement cycle; its skim is as the first", 10.0},
          p.measurement_s);
    IsoAccuracies::visit(p.accuracies, visit);
  }
};

struct Results {
  Cycle cycle;  // the measurement: the last cycle, which is the warm-up's own end when no measurement cycle follows
  double corrected_rrc = 0.0;
  RrcUncertainty uncertainty;
  double pressure_set_Pa = 0.0;
  double pressure_verified_Pa = 0.0;
  std::vector<Cycle> cycles;
  std::optional<double> mean_rrc;
  std::optional<double> rrc_sd;
  std::string tire_file_says;

  void visit(ResultSheet& visit) const {
    cycle.visit(visit);
    visit(Result{"rrc_25degC_2m_N_per_kN", "", ".3f", "RRc corrected to 25 degC and the 2 m drum"}, corrected_rrc);
    visit(Result{"rrc_uncertainty_N_per_kN", "", ".3f", "expanded (k = 2), from the torque sensor, offset canceled"},
          uncertainty.offset_canceled);
    visit(Result{"rrc_uncertainty_offset_kept_N_per_kN", "", ".3f", "the same from the offset alone, not canceled"},
          uncertainty.offset_kept);
    visit(Result{"pressure_set_kPa", "", ".1f", "as set after the soak, gauge"}, pressure_set_Pa);
    visit(Result{"pressure_verified_kPa", "", ".1f", "at the end of the check, which the standard asks for, gauge"},
          pressure_verified_Pa);
    visit(ResultList{"cycles", "Cycles", "every cycle, when there are several", kCycleWindows, true}, cycles);
    visit(Result{"rrc_cycles_mean_N_per_kN", "", ".3f", "mean of RRc over the cycles"}.or_left_out(), mean_rrc);
    visit(Result{"rrc_cycles_sd_N_per_kN", "", ".3f", "sample standard deviation of RRc over the cycles"}.or_left_out(),
          rrc_sd);
    visit(JointLine{"Load", "{load_N}"});
    visit(JointLine{"Speed", "{speed_km_h}"});
    visit(JointLine{"Pressure set / verified / warm",
                    "{pressure_set_kPa} / {pressure_verified_kPa} / {cavity_pressure_kPa}"});
    visit(JointLine{"Liner temperature", "{liner_temperature_degC}"});
    Cycle::visit_lines(visit);
    visit(JointLine{"Rolling resistance", "{rolling_resistance_N}"});
    visit(JointLine{"  by the force method", "{force_method_N}"});
    visit(JointLine{"RRc", "{rrc_N_per_kN}"});
    visit(JointLine{"RRc at 25 degC, 2 m drum",
                    "{rrc_25degC_2m_N_per_kN} +- {rrc_uncertainty_N_per_kN} (k = 2, torque sensor)"});
    visit(JointLine{"  zero error of the torque",
                    "+- {rrc_uncertainty_offset_kept_N_per_kN}, canceled by the skim test"});
    visit(Remark{"  tire file says"}, tire_file_says);
    visit(
        JointLine{"RRc of all cycles", "{rrc_cycles_mean_N_per_kN} +- {rrc_cycles_sd_N_per_kN} (standard deviation)"});
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  DrumProgram program(settings.conditions, spec);
  program.begin_test("iso-28580");
  program.roll("warm-up", *settings.warm_up_s);
  program.skim("skim", settings.skim_s);
  for (int i = 1; i <= settings.measurement_cycles; ++i) {
    program.roll(fmt::format("measurement {}", i), settings.measurement_s);
    program.skim(fmt::format("skim {}", i), settings.skim_s);
  }
  return program;
}

/// Mean and sample standard deviation of RRc over the cycles.
std::pair<double, double> calc_repeatability(const std::vector<Cycle>& cycles) {
  double mean = 0.0;
  for (const Cycle& cycle : cycles) mean += cycle.rrc / static_cast<double>(cycles.size());
  double squares = 0.0;
  for (const Cycle& cycle : cycles) squares += (cycle.rrc - mean) * (cycle.rrc - mean);
  return {mean, cycles.size() > 1 ? std::sqrt(squares / static_cast<double>(cycles.size() - 1)) : 0.0};
}

/// The pressure after the check, against what was set: the standard asks to verify it.
double find_verified_pressure_Pa(const sim::Recording<double>& recording) {
  const double end_s = recording.phase_named("pressure check").end_s;
  return recording.channel(quantities::kCavityPressure)[recording.row_at(end_s)];
}

/// F_r of the last cycle at another speed and pressure, quasi-static and without sensors.
double simulate_resistance_N(Settings settings, RunSpec spec, double speed_m_s, double pressure_Pa) {
  settings.conditions.speed_m_s = speed_m_s;
  settings.conditions.pressure_Pa = pressure_Pa;
  spec.fidelity = Fidelity::kQuasiStatic;
  spec.sensors.reset();
  Outcome outcome;
  simulate_on_drum(spec, settings.conditions, plan(settings, spec), {}, outcome);
  return find_cycles(outcome.recording, spec, settings.conditions).back().rolling_resistance_N;
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> cycles = find_cycles(outcome.recording, spec, settings.conditions);
  Results results;
  results.cycle = cycles.back();
  const double ambient_K = results.cycle.loaded.ambient_K;
  results.corrected_rrc = correct_rrc(results.cycle.rrc, ambient_K, spec);
  results.uncertainty = calc_rrc_uncertainty(results.cycle, spec);
  results.pressure_set_Pa = *settings.conditions.pressure_Pa;
  results.pressure_verified_Pa = find_verified_pressure_Pa(outcome.recording);
  if (cycles.size() > 1) {
    std::tie(results.mean_rrc, results.rrc_sd) = calc_repeatability(cycles);
    results.cycles = cycles;
  }
  if (spec.tire.iso_28580.has_value()) {
    const double reference = spec.tire.iso_28580->rrc;
    results.tire_file_says = fmt::format("{}, difference {:+.2f} %", show_number("rrc_N_per_kN", ".3f", reference),
                                         100.0 * (results.corrected_rrc / reference - 1.0));
  }
  constexpr double kTooShort = 0.02;  // Assumed: more than tires of class C1 lack after the standard's warm-up
  if (std::abs(results.cycle.unsettled.value_or(0.0)) > kTooShort) {
    outcome.warnings.push_back(
        fmt::format("RRc is {:.1f} % away from that in steady state: warm_up_min is too short for this tire",
                    1e2 * std::abs(*results.cycle.unsettled)));
  }
  if (!models::is_ambient_correction_valid(ambient_K)) {
    outcome.warnings.push_back("the correction to 25 degC holds from 20 to 30 degC only");
  }
  outcome.make_measurement_model = [&spec, settings, cycles] {
    const auto simulate = [&](double speed_m_s, double pressure_Pa) {
      return simulate_resistance_N(settings, spec, speed_m_s, pressure_Pa);
    };
    return make_iso_model(spec, cycles, *settings.conditions.pressure_Pa, settings.accuracies, simulate);
  };
  return results;
}

Scenario make() {
  Scenario scenario = make_drum_scenario(
      {"iso_28580", "Whole ISO 28580 test: soak, pressure, run-up, warm-up, measurement, skim",
       "3 h soak at test temperature; pressure set and verified after 10 min; run-up at skim load; 30 min under "
       "load at 80 km/h, of which the last minute is the measurement; 3 min skim at 200 N, of which the last "
       "minute gives the parasitic loss. With measurement_cycles, further cycles of 10 min load and 3 min skim "
       "follow, and the last of them is the measurement. Ranges are found from the load signal.",
       "ISO 28580:2009 as in Kolekar and Narasimhan (2024) §3.2.1, §3.2.3, B.2"},
      &plan, &evaluate);
  scenario.has_uncertainty = true;
  return scenario;
}

}  // namespace rollrig::scenarios::iso_28580
