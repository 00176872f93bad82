/// ISO 28580: the whole rolling-resistance test of one tire, as in §3.2.3.
#include <algorithm>
#include <cmath>

#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {
namespace {

struct Settings {
  DrumConditions conditions;
  CycleTimes times;
  int measurement_cycles = 0;
  double measurement_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DrumConditions::visit(p.conditions, visit);
    CycleTimes::visit(p.times, visit);
    visit(Field{"measurement_cycles", between(0.0, 100.0), "Measurement cycles after the warm-up cycle (§3.2.1 item 8)",
                0.0},
          p.measurement_cycles);
    visit(Field{"measurement_min", between(1.0, 600.0), "Load of a measurement cycle; its skim is as the first", 10.0},
          p.measurement_s);
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  const DrumConditions& conditions = settings.conditions;
  const double skim_N = spec.rig.skim.load_N;
  DrumProgram program(conditions, spec.rig, spec.sample_interval_s);
  program.begin_test("iso-28580", *conditions.pressure_Pa, conditions.speed_m_s);
  program.mark_time_zero();
  program.roll("warm-up", settings.times.warm_up_s, *conditions.load_N);
  program.roll("skim", settings.times.skim_s, skim_N);
  for (int i = 1; i <= settings.measurement_cycles; ++i) {
    program.roll(fmt::format("measurement {}", i), settings.measurement_s, *conditions.load_N);
    program.roll(fmt::format("skim {}", i), settings.times.skim_s, skim_N);
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
  return recording.channel("cavity_pressure_kPa")[recording.row_at(end_s)];
}

void fill_lines(const Settings& settings, const RunSpec& spec, const Cycle& cycle, double corrected,
                const RrcUncertainty& uncertainty, double verified_Pa, Outcome& outcome) {
  const auto add = [&outcome](const char* label, std::string value) {
    outcome.lines.push_back({label, std::move(value)});
  };
  add("Load", fmt::format("{:.0f} N", cycle.loaded.load_N));
  add("Speed", fmt::format("{:.1f} km/h", 3.6 * cycle.loaded.speed_m_s));
  add("Pressure set / verified / warm",
      fmt::format("{:.1f} / {:.1f} / {:.1f} kPa", *settings.conditions.pressure_Pa / 1e3, verified_Pa / 1e3,
                  cycle.loaded.pressure_Pa / 1e3));
  add("Liner temperature", fmt::format("{:.1f} degC", cycle.loaded.liner_temperature_K - kZeroCelsius_K));
  add("Drum torque", fmt::format("{:.2f} Nm", cycle.loaded.drum_torque_Nm));
  add("Parasitic loss (skim)", fmt::format("{:.2f} N", cycle.parasitic_N));
  add("Rolling resistance", fmt::format("{:.2f} N", cycle.rolling_resistance_N));
  add("  by the force method", fmt::format("{:.2f} N", cycle.force_method_N));
  add("RRc", fmt::format("{:.3f} N/kN", 1e3 * cycle.rrc));
  add("RRc at 25 degC, 2 m drum",
      fmt::format("{:.3f} +- {:.3f} N/kN (k = 2, torque)", 1e3 * corrected, 1e3 * uncertainty.offset_cancelled));
  if (spec.tire.iso_28580.has_value()) {
    const double reference = spec.tire.iso_28580->rrc;
    add("  tire file says",
        fmt::format("{:.3f} N/kN, difference {:+.2f} %", 1e3 * reference, 100.0 * (corrected / reference - 1.0)));
  }
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> cycles = find_cycles(outcome.recording, spec, settings.conditions, 0.0);
  // The measurement is the last cycle's: the warm-up's own end when no measurement cycle follows.
  const Cycle& cycle = cycles.back();
  const double corrected = correct_rrc(cycle.rrc, cycle.loaded.ambient_K, spec);
  const RrcUncertainty uncertainty = calc_rrc_uncertainty(cycle, spec);
  const double verified_Pa = find_verified_pressure_Pa(outcome.recording);
  outcome.result = to_json(cycle);
  outcome.result["rrc_25degC_2m_N_per_kN"] = 1e3 * corrected;
  outcome.result["rrc_uncertainty_N_per_kN"] = 1e3 * uncertainty.offset_cancelled;
  outcome.result["rrc_uncertainty_offset_kept_N_per_kN"] = 1e3 * uncertainty.offset_kept;
  outcome.result["pressure_set_kPa"] = *settings.conditions.pressure_Pa / 1e3;
  outcome.result["pressure_verified_kPa"] = verified_Pa / 1e3;
  fill_lines(settings, spec, cycle, corrected, uncertainty, verified_Pa, outcome);
  if (cycles.size() > 1) {
    const auto [mean, sd] = calc_repeatability(cycles);
    add_cycles("Cycles", cycles, outcome);
    outcome.result["rrc_cycles_mean_N_per_kN"] = 1e3 * mean;
    outcome.result["rrc_cycles_sd_N_per_kN"] = 1e3 * sd;
  }
  if (!is_correction_valid(cycle.loaded.ambient_K)) {
    outcome.warnings.push_back("the correction to 25 degC holds from 20 to 30 degC only");
  }
}

}  // namespace

const Scenario& scenario_iso_28580() {
  static const Scenario scenario = make_drum_scenario<Settings>(
      {"iso_28580",
       "Whole ISO 28580 test: soak, pressure, run-up, warm-up, measurement, skim",
       "3 h soak at test temperature; pressure set and verified after 10 min; run-up at skim load; 30 min under "
       "load at 80 km/h, of which the last minute is the measurement; 3 min skim at 200 N, of which the last "
       "minute gives the parasitic loss. With measurement_cycles, further cycles of 10 min load and 3 min skim "
       "follow, and the last of them is the measurement. Ranges are found from the load signal.",
       "ISO 28580:2009 as in source §3.2.1, §3.2.3, B.2",
       {{"drum_torque_Nm", "mean motor torque of the measurement"},
        {"parasitic_N", "skim torque over drum radius"},
        {"rolling_resistance_N", "F_r = T_t/R - F_pl"},
        {"force_method_N", "F_r from the spindle force"},
        {"rrc_N_per_kN", "F_r over load"},
        {"rrc_25degC_2m_N_per_kN", "corrected to 25 degC and the 2 m drum"},
        {"rrc_uncertainty_N_per_kN", "expanded (k = 2), from the torque sensor, offset canceled"},
        {"rrc_uncertainty_offset_kept_N_per_kN", "the same from the offset alone, not canceled"},
        {"liner_temperature_degC", "mean of the measurement"},
        {"cavity_pressure_kPa", "mean of the measurement, gauge"},
        {"cycles", "every cycle, when there are several"}}},
      &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
