/// Skim tests at several small loads, extrapolated to zero load (§5.2).
#include <cmath>

#include <Eigen/Dense>

#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {
namespace {

struct Settings {
  DrumConditions conditions;
  CycleTimes times;
  std::vector<double> skim_loads_N{400.0, 300.0, 200.0, 100.0, 50.0};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DrumConditions::visit(p.conditions, visit);
    CycleTimes::visit(p.times, visit);
    visit(Field{"skim_loads_N", between(10.0, 2000.0), "Loads of the series, in the order in which they are run"},
          p.skim_loads_N);
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  constexpr double kDistinct = 0.02;  // twice what the range finder takes for a change of load
  for (std::size_t i = 0; i < settings.skim_loads_N.size(); ++i) {
    const double former_N = i > 0 ? settings.skim_loads_N[i - 1] : *settings.conditions.load_N;
    if (std::abs(settings.skim_loads_N[i] - former_N) >= kDistinct * former_N) continue;
    throw TableReader(spec.settings, "[settings]")
        .problem("skim_loads_N", "a load follows one that it cannot be told from",
                 "neighbors that differ by 2 %, from the warm-up's load on");
  }
  if (settings.skim_loads_N.size() < 2) {
    throw TableReader(spec.settings, "[settings]")
        .problem("skim_loads_N", "a straight line needs two loads at least", "two or more different loads");
  }
  const DrumConditions& conditions = settings.conditions;
  DrumProgram program(conditions, spec.rig, spec.sample_interval_s);
  program.begin_test("skim-series", *conditions.pressure_Pa, conditions.speed_m_s);
  program.mark_time_zero();
  program.roll("warm-up", settings.times.warm_up_s, *conditions.load_N);
  for (const double load_N : settings.skim_loads_N) {
    program.roll(fmt::format("skim {:.6g} N", load_N), settings.times.skim_s, load_N);
  }
  return program;
}

/// Straight line through force over load, with standard errors.
struct Extrapolation {
  double intercept_N = 0.0;
  double slope = 0.0;  // N/N
  double intercept_sd_N = 0.0;
};

Extrapolation extrapolate(const std::vector<Reading>& readings, double radius_m, double force_sd_N) {
  const auto n = static_cast<Eigen::Index>(readings.size());
  Eigen::MatrixXd design(n, 2);
  Eigen::VectorXd force_N(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Reading& reading = readings[static_cast<std::size_t>(i)];
    design.row(i) << 1.0, reading.load_N;
    force_N[i] = reading.drum_torque_Nm / radius_m;
  }
  const Eigen::Vector2d line = design.colPivHouseholderQr().solve(force_N);
  const Eigen::Matrix2d normal = design.transpose() * design;
  const Eigen::Matrix2d covariance = normal.inverse() * force_sd_N * force_sd_N;
  return {line[0], line[1], std::sqrt(covariance(0, 0))};
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const double radius_m = spec.rig.drum.diameter_m / 2.0;
  std::vector<Reading> readings;
  ResultTable table{"Skim series", {"load N", "torque Nm", "force N", "tire N (simulated)", "liner C"}, {}};
  outcome.result["points"] = Json::array();
  double rig_alone_N = 0.0;
  const std::vector<LoadRange> ranges = find_test_ranges(outcome.recording, spec, 0.0);
  if (ranges.size() != settings.skim_loads_N.size() + 1) {
    throw RunFailure(
        fmt::format("{} ranges of load were found, {} were run", ranges.size(), settings.skim_loads_N.size() + 1));
  }
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    const double load_N = ranges[i].load_N;
    const Window window = find_last_window(ranges[i], settings.conditions.window_s, settings.conditions.margin_s);
    const Reading reading = take_reading(outcome.recording, window, spec.sample_interval_s);
    const auto simulated = [&](const char* channel) {
      return calc_window_mean(outcome.recording.time_s, outcome.recording.channel(channel), window,
                              spec.sample_interval_s);
    };
    const double force_N = reading.drum_torque_Nm / radius_m;
    rig_alone_N = simulated("parasitic_N");
    outcome.result["points"].push_back({{"load_N", reading.load_N}, {"force_N", force_N}});
    table.rows.push_back({fmt::format("{:.0f}", load_N), fmt::format("{:.3f}", reading.drum_torque_Nm),
                          fmt::format("{:.3f}", force_N), fmt::format("{:.3f}", simulated("rolling_resistance_N")),
                          fmt::format("{:.1f}", reading.liner_temperature_K - kZeroCelsius_K)});
    readings.push_back(reading);
  }
  const models::SensorParameters sensor = find_torque_sensor(spec);
  const double mean_sd_Nm =
      std::sqrt(0.5 * models::calc_difference_variance(sensor, readings.front().samples, spec.sample_interval_s, 1e9));
  const Extrapolation zero_load = extrapolate(readings, radius_m, mean_sd_Nm / radius_m);
  outcome.tables.push_back(table);
  outcome.result["intercept_N"] = zero_load.intercept_N;
  outcome.result["intercept_sd_N"] = zero_load.intercept_sd_N;
  outcome.result["slope_N_per_kN"] = 1e3 * zero_load.slope;
  outcome.result["rig_alone_N"] = rig_alone_N;
  outcome.lines = {{"Parasitic loss at zero load", fmt::format("{:.3f} +- {:.3f} N (standard error, offset aside)",
                                                               zero_load.intercept_N, zero_load.intercept_sd_N)},
                   {"Slope over load", fmt::format("{:.3f} N/kN", 1e3 * zero_load.slope)},
                   {"Rig alone", fmt::format("{:.3f} N (simulated)", rig_alone_N)}};
}

}  // namespace

const Scenario& scenario_skim_series() {
  static const Scenario scenario = make_drum_scenario<Settings>(
      {"skim_series",
       "Skim tests at several small loads, extrapolated to zero load",
       "Soak, pressure, run-up, 30 min under load, then a skim test of 3 min at each of several small loads; a "
       "straight line through the forces gives the loss at zero load.",
       "source §5.2",
       {{"intercept_N", "force at zero load: the rig alone, as far as the tire's loss goes with load"},
        {"intercept_sd_N", "its standard error from the torque sensor's noise and drift"},
        {"slope_N_per_kN", "rise of the force with load"},
        {"rig_alone_N", "what the rig alone loses, which only a simulation knows"},
        {"points", "load and force of each skim test"}}},
      &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
