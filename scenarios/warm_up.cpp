/// Warm-up of a cold tire at constant speed, as in §3.2.6, and what the source reads off it (§4.1.6, §6).
#include <cmath>

#include <boost/math/statistics/linear_regression.hpp>

#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios::warm_up {

using boost::math::statistics::simple_ordinary_least_squares;

struct Settings : CycleSettings {
  double start_window_s = 0.0;
  double band_low_K = 0.0;
  double band_high_K = 0.0;
  std::optional<double> until_tire_K;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    CycleSettings::visit(p, visit);
    visit(Field{"start_window_s", between(10.0, 600.0),
                "The loss at the start is a straight line through this long, drawn back to 0 s. Assumed: 60 s", 60.0},
          p.start_window_s);
    visit(Field{"band_low_degC", between(-60.0, 200.0), "Liner temperature from which B is read (§4.1.6)", 30.0},
          p.band_low_K);
    visit(Field{"band_high_degC", between(-60.0, 200.0), "Liner temperature to which B is read (§4.1.6)", 35.0},
          p.band_high_K);
    visit(Field{"until_tire_degC", between(-60.0, 200.0), "Ends the load when the tire reaches it; default: never"},
          p.until_tire_K);
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  DrumProgram program(settings.conditions, spec);
  program.begin_test(fmt::format("warm-up-{:.0f}", 3.6 * settings.conditions.speed_m_s));
  program.roll("warm-up", *settings.warm_up_s);
  if (settings.until_tire_K.has_value()) program.end_at_tire_temperature(*settings.until_tire_K);
  program.skim("skim", settings.skim_s);
  return program;
}

/// What the source reads off the loss over the load phase.
struct WarmUpCurve {
  double start_N = 0.0;
  std::optional<double> B_per_K;  // these where the band was passed
  std::optional<double> band_low_N;
  std::optional<double> band_drop_N;
  std::optional<double> band_drop;  // of band_low_N
};

struct Results {
  Cycle cycle;
  WarmUpCurve curve;
  double start_excess = 0.0;
  double warm_up_s = 0.0;
  double pressure_set_Pa = 0.0;
  std::string band;

  void visit(ResultSheet& visit) const {
    cycle.visit(visit);
    visit(JointLine{"Load, speed", "{load_N}, {speed_km_h}"});
    visit(Result{"pressure_set_kPa", "", ".1f", "as set before the test, gauge"}, pressure_set_Pa);
    visit(JointLine{"Pressure set / warm", "{pressure_set_kPa} / {cavity_pressure_kPa}"});
    visit(JointLine{"Liner temperature at the end", "{liner_temperature_degC}"});
    Cycle::visit_lines(visit);
    visit(Result{"start_rolling_resistance_N", "Rolling resistance, start", ".2f",
                 "loss at 0 s, drawn back from the first minute"},
          curve.start_N);
    visit(JointLine{"Rolling resistance, end", "{rolling_resistance_N}, RRc {rrc_N_per_kN}"});
    visit(JointLine{"  by the force method", "{force_method_N}"});
    visit(Result{"start_excess_percent", "Start above end", ".1f", "how far the start is above the end"}, start_excess);
    visit(Result{"warm_up_s", "Time under load", ".0f", "end of the time under load"}, warm_up_s);
    visit(Result{"band_B_per_degC", "", ".5f",
                 "relative fall of the loss per degC between the two temperatures; null when not reached"},
          curve.B_per_K);
    visit(Result{"band_low_N", "", ".2f", "loss at the lower of the two temperatures"}, curve.band_low_N);
    visit(Result{"band_drop_N", "", ".2f", "fall between the two temperatures"}, curve.band_drop_N);
    visit(Result{"band_drop_percent", "", ".2f", "the same, of the loss at the lower"}, curve.band_drop);
    visit(JointLine{"Fall from " + band, "{band_drop_percent} ({band_drop_N} of {band_low_N}), B = {band_B_per_degC}"});
    visit(Summary{
        "As the tire warms up, its rolling resistance falls from {start_rolling_resistance_N} to "
        "{rolling_resistance_N}: a cold start takes {start_excess_percent} more. Warm, its coefficient (RRc) is "
        "{rrc_N_per_kN} at {load_N} and {speed_km_h}."});
    visit(Headline{"RRc, warm", "{rrc_N_per_kN}", "{rolling_resistance_N} at {load_N} and {speed_km_h}"});
    visit(Headline{"Cold start above warm", "{start_excess_percent}",
                   "rolling resistance falls from {start_rolling_resistance_N} to {rolling_resistance_N}"});
    visit(Headline{"Fall per kelvin", "{band_B_per_degC}", "from " + band});
    visit(Headline{"Liner temperature, warm", "{liner_temperature_degC}", "after {warm_up_s} under load"});
  }
};

WarmUpCurve read_curve(const Settings& settings, const RunSpec& spec, const Cycle& cycle, const Outcome& outcome) {
  constexpr double kSettled_s = 5.0;       // Assumed: speed controller and load cylinder have settled
  constexpr std::size_t kEnoughRows = 10;  // Assumed: for a straight line through noise
  const sim::PhaseSpan& phase = outcome.recording.phase_named("warm-up");
  const std::vector<double>& force = outcome.recording.channel(spec.rig.kind->traits.force);
  const std::vector<double>& liner_temperature_K = outcome.recording.channel(quantities::kLinerTemperature);
  std::vector<double> start_times_s, start_N, band_dK, band_log;
  for (std::size_t i = 0; i < outcome.recording.row_count(); ++i) {
    const double time_s = outcome.recording.time_s[i];
    if (time_s < phase.start_s + kSettled_s || time_s > phase.end_s - settings.conditions.margin_s) continue;
    const double loss_N = force[i] / spec.rig.lever_m() - cycle.parasitic_N;
    const double liner_K = liner_temperature_K[i];
    if (time_s <= kSettled_s + settings.start_window_s) {
      start_times_s.push_back(time_s);
      start_N.push_back(loss_N);
    }
    if (liner_K >= settings.band_low_K && liner_K <= settings.band_high_K && loss_N > 0.0) {
      band_dK.push_back(liner_K - settings.band_low_K);
      band_log.push_back(std::log(loss_N));
    }
  }
  WarmUpCurve curve;
  curve.start_N = simple_ordinary_least_squares(start_times_s, start_N).first;
  if (band_dK.size() >= kEnoughRows) {
    const auto [intercept, slope] = simple_ordinary_least_squares(band_dK, band_log);
    curve.B_per_K = -slope;
    curve.band_low_N = std::exp(intercept);
    curve.band_drop_N = *curve.band_low_N - std::exp(intercept + slope * (settings.band_high_K - settings.band_low_K));
    curve.band_drop = *curve.band_drop_N / *curve.band_low_N;
  }
  return curve;
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  Results results;
  results.cycle = find_cycles(outcome.recording, spec, settings.conditions).back();
  results.curve = read_curve(settings, spec, results.cycle, outcome);
  results.start_excess = results.curve.start_N / results.cycle.rolling_resistance_N - 1.0;
  results.warm_up_s = outcome.recording.phase_named("warm-up").end_s;
  results.pressure_set_Pa = *settings.conditions.pressure_Pa;
  results.band =
      fmt::format("{:.0f} to {:.0f} degC", settings.band_low_K - kZeroCelsius_K, settings.band_high_K - kZeroCelsius_K);
  return results;
}

Scenario make() {
  return make_drum_scenario(
      {"warm_up", "Warm-up cycle of a soaked tire: loss against temperature",
       "Soak, pressure, run-up, then the warm-up cycle: 30 min under load at constant speed and 3 min skim. Reads off "
       "the loss at the start and at the end, and its relative fall per degC between two liner temperatures.",
       "Kolekar and Narasimhan (2024) §3.2.6, §4.1.6, §6"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::warm_up
