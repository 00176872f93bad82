/// Skim tests at several small loads, extrapolated to zero load (§5.2).
#include <cmath>

#include <Eigen/Dense>

#include "scenarios/common/drum_bench.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios::skim_series {

struct Settings : CycleSettings {
  std::vector<double> skim_loads_N{400.0, 300.0, 200.0, 100.0, 50.0};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    CycleSettings::visit(p, visit);
    visit(Field{"skim_loads_N", between(10.0, 2000.0), "Loads of the series, in the order in which they are run"},
          p.skim_loads_N);
  }
};

struct Point {
  Reading reading;
  double tire_N = 0.0;

  void visit(ResultSheet& visit) const {
    visit(Result{"load_N", "load", ".0f", "mean load"}, reading.load_N);
    visit(Result{"force_N", "force", ".3f", "motor torque over drum radius"}, reading.force_N);
    visit(Result{"tire_N", "tire (simulated)", ".3f", "loss of the tire alone, which only a simulation knows"}, tire_N);
    visit(Result{"liner_temperature_degC", "liner", ".1f", "mean over the window"}, reading.liner_temperature_K);
  }
};

/// Straight line through force over load.
struct Extrapolation {
  double intercept_N = 0.0;
  double slope = 0.0;  // N/N
  double intercept_sd_N = 0.0;
};

struct Results {
  std::vector<Point> points;
  Extrapolation zero_load;
  double rig_alone_N = 0.0;

  void visit(ResultSheet& visit) const {
    visit(ResultList{"points", "Skim series", "load and force of each skim test"}, points);
    visit(
        Result{"intercept_N", "", ".3f", "force at zero load: the rig alone, as far as the tire's loss goes with load"},
        zero_load.intercept_N);
    visit(Result{"intercept_sd_N", "", ".3f", "its standard error from the torque sensor's noise and drift"},
          zero_load.intercept_sd_N);
    visit(JointLine{"Parasitic loss at zero load", "{intercept_N} +- {intercept_sd_N} (standard error, offset aside)"});
    visit(Result{"slope_N_per_kN", "Slope over load", ".3f", "rise of the force with load"}, zero_load.slope);
    visit(Result{"rig_alone_N", "Rig alone (simulated)", ".3f",
                 "what the rig alone loses, which only a simulation knows"},
          rig_alone_N);
    visit(Summary{
        "The parasitic loss of the rig is {intercept_N} +- {intercept_sd_N} (one standard error), by a straight line to "
        "load zero; the simulated rig truly loses {rig_alone_N}."});
    visit(Headline{"Parasitic loss at zero load", "{intercept_N} +- {intercept_sd_N}",
                   "by the straight line; +- is one standard error"});
    visit(Headline{"True loss of the rig", "{rig_alone_N}",
                   "of the simulated rig without a tire; the result should meet it"});
    visit(Headline{"Slope over load", "{slope_N_per_kN}"});
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  constexpr double kDistinct = 0.02;  // Assumed: twice what the range finder takes for a change of load
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
  DrumProgram program(settings.conditions, spec);
  program.begin_test("skim-series");
  program.roll("warm-up", *settings.warm_up_s);
  for (const double load_N : settings.skim_loads_N) {
    program.roll(fmt::format("skim {:.6g} N", load_N), settings.skim_s, load_N);
  }
  return program;
}

/// The line by least squares, with the standard error that a force's own makes.
Extrapolation extrapolate(const std::vector<Point>& points, double force_sd_N) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd design(n, 2);
  Eigen::VectorXd force_N(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Point& point = points[static_cast<std::size_t>(i)];
    design.row(i) << 1.0, point.reading.load_N;
    force_N[i] = point.reading.force_N;
  }
  const Eigen::Vector2d line = design.colPivHouseholderQr().solve(force_N);
  const Eigen::Matrix2d normal = design.transpose() * design;
  const Eigen::Matrix2d covariance = normal.inverse() * force_sd_N * force_sd_N;
  return {line[0], line[1], std::sqrt(covariance(0, 0))};
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const sim::Recording<double>& recording = outcome.recording;
  const std::vector<LoadRange> ranges = find_test_ranges(recording, spec);
  if (ranges.size() != settings.skim_loads_N.size() + 1) {
    throw RunFailure(
        fmt::format("{} ranges of load were found, {} were run", ranges.size(), settings.skim_loads_N.size() + 1));
  }
  Results results;
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    const Window window = find_last_window(ranges[i], settings.conditions.window_s, settings.conditions.margin_s);
    results.points.push_back(
        {take_reading(recording, spec, window), calc_mean(recording, spec, window, quantities::kRollingResistance)});
    results.rig_alone_N = calc_mean(recording, spec, window, quantities::kParasiticLoss);
  }
  const models::SensorParameters sensor = find_force_sensor(spec);
  const int samples = results.points.front().reading.samples;
  constexpr double kFarApart_s = 1e9;  // so that drift of the sensor counts in full
  const double mean_sd =
      std::sqrt(0.5 * models::calc_difference_variance(sensor, samples, spec.sample_interval_s, kFarApart_s));
  results.zero_load = extrapolate(results.points, mean_sd / spec.rig.lever_m());
  return results;
}

Scenario make() {
  return make_drum_scenario(
      {"skim_series", "Skim tests at several small loads, extrapolated to zero load",
       "Soak, pressure, run-up, 30 min under load, then a skim test of 3 min at each of several small loads; a "
       "straight line through the forces gives the loss at zero load.",
       "Kolekar and Narasimhan (2024) §5.2"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::skim_series
