/// Warm-up of a cold tire at constant speed, as in §3.2.6, and what the source reads off it (§4.1.6, §6).
#include <cmath>

#include <boost/math/statistics/linear_regression.hpp>

#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {

using boost::math::statistics::simple_ordinary_least_squares;

namespace {

struct Settings {
  DrumConditions conditions;
  CycleTimes times;
  double start_window_s = 0.0;
  double band_low_K = 0.0;
  double band_high_K = 0.0;
  std::optional<double> until_tire_K;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DrumConditions::visit(p.conditions, visit);
    CycleTimes::visit(p.times, visit);
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
  const DrumConditions& conditions = settings.conditions;
  DrumProgram program(conditions, spec.rig, spec.sample_interval_s);
  program.begin_test(fmt::format("warm-up-{:.0f}", 3.6 * conditions.speed_m_s), *conditions.pressure_Pa,
                     conditions.speed_m_s);
  program.mark_time_zero();
  program.roll("warm-up", settings.times.warm_up_s, *conditions.load_N);
  if (settings.until_tire_K.has_value()) program.end_at_tire_temperature(*settings.until_tire_K);
  program.roll("skim", settings.times.skim_s, spec.rig.skim.load_N);
  return program;
}

/// Loss over the load phase, and what the source reads off the curve.
struct WarmUpCurve {
  double start_N = 0.0;
  bool has_band = false;
  double B_per_K = 0.0;
  double band_low_N = 0.0;
  double band_high_N = 0.0;
};

WarmUpCurve read_curve(const Settings& settings, const RunSpec& spec, const Cycle& cycle, const Outcome& outcome) {
  constexpr double kSettled_s = 5.0;       // speed controller and load cylinder have settled
  constexpr std::size_t kEnoughRows = 10;  // for a straight line through noise
  const sim::PhaseSpan& phase = outcome.recording.phase_named("warm-up");
  std::vector<double> start_times_s, start_N, band_dK, band_log;
  for (std::size_t i = 0; i < outcome.recording.row_count(); ++i) {
    const double time_s = outcome.recording.time_s[i];
    if (time_s < phase.start_s + kSettled_s || time_s > phase.end_s - settings.conditions.margin_s) continue;
    const double torque_Nm = outcome.recording.channel("drum_torque_Nm")[i];
    const double loss_N = torque_Nm / (spec.rig.drum.diameter_m / 2.0) - cycle.parasitic_N;
    const double liner_K = outcome.recording.channel("liner_temperature_degC")[i];
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
  curve.has_band = band_dK.size() >= kEnoughRows;
  if (curve.has_band) {
    const auto [intercept, slope] = simple_ordinary_least_squares(band_dK, band_log);
    curve.B_per_K = -slope;
    curve.band_low_N = std::exp(intercept);
    curve.band_high_N = std::exp(intercept + slope * (settings.band_high_K - settings.band_low_K));
  }
  return curve;
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> cycles = find_cycles(outcome.recording, spec, settings.conditions, 0.0);
  const Cycle& cycle = cycles.back();
  const WarmUpCurve curve = read_curve(settings, spec, cycle, outcome);
  const double excess = curve.start_N / cycle.rolling_resistance_N - 1.0;
  outcome.result = to_json(cycle);
  outcome.result["start_rolling_resistance_N"] = curve.start_N;
  outcome.result["start_excess_percent"] = 100.0 * excess;
  outcome.result["warm_up_s"] = outcome.recording.phase_named("warm-up").end_s;
  const auto or_null = [&curve](double value) { return curve.has_band ? Json(value) : Json(); };
  const double drop_N = curve.band_low_N - curve.band_high_N;
  outcome.result["band_B_per_degC"] = or_null(curve.B_per_K);
  outcome.result["band_low_N"] = or_null(curve.band_low_N);
  outcome.result["band_drop_N"] = or_null(drop_N);
  outcome.result["band_drop_percent"] = or_null(100.0 * (drop_N / curve.band_low_N));
  const auto add = [&outcome](const std::string& label, std::string value) {
    outcome.lines.push_back({label, std::move(value)});
  };
  add("Load, speed", fmt::format("{:.0f} N, {:.1f} km/h", cycle.loaded.load_N, 3.6 * cycle.loaded.speed_m_s));
  add("Pressure set / warm",
      fmt::format("{:.1f} / {:.1f} kPa", *settings.conditions.pressure_Pa / 1e3, cycle.loaded.pressure_Pa / 1e3));
  add("Liner temperature at the end", fmt::format("{:.1f} degC", cycle.loaded.liner_temperature_K - kZeroCelsius_K));
  add("Rolling resistance, start", fmt::format("{:.2f} N", curve.start_N));
  add("Rolling resistance, end", fmt::format("{:.2f} N, RRc {:.3f} N/kN", cycle.rolling_resistance_N, 1e3 * cycle.rrc));
  add("Start above end", fmt::format("{:.1f} %", 100.0 * excess));
  if (curve.has_band) {
    add(fmt::format("Fall from {:.0f} to {:.0f} degC", settings.band_low_K - kZeroCelsius_K,
                    settings.band_high_K - kZeroCelsius_K),
        fmt::format("{:.2f} % ({:.2f} N of {:.2f} N), B = {:.5f} 1/degC", 100.0 * drop_N / curve.band_low_N, drop_N,
                    curve.band_low_N, curve.B_per_K));
  }
}

}  // namespace

const Scenario& scenario_warm_up() {
  static const Scenario scenario = make_drum_scenario<Settings>(
      {"warm_up",
       "Warm-up cycle of a soaked tire: loss against temperature",
       "Soak, pressure, run-up, then the warm-up cycle: 30 min under load at constant speed and 3 min skim. Reads off "
       "the loss at the start and at the end, and its relative fall per degC between two liner temperatures.",
       "source §3.2.6, §4.1.6, §6",
       {{"start_rolling_resistance_N", "loss at 0 s, drawn back from the first minute"},
        {"rolling_resistance_N", "loss of the last minute"},
        {"start_excess_percent", "how far the start is above the end"},
        {"band_B_per_degC", "relative fall of the loss per degC between the two temperatures; null when not reached"},
        {"band_drop_percent", "fall between the two temperatures"},
        {"band_drop_N", "the same in N"}}},
      &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
