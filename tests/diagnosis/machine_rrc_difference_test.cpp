// The coefficient on one machine less that on the other: its sign, its size as a laboratory reads it, its interval.
#include "diagnosis/pair/rrc_difference.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "diagnosis/comparison/model.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using diagnosis::PreparedSet;

namespace {

measurements::MeasurementSet make_machine(const std::vector<models::ActiveEffect>& effects, std::size_t runs,
                                          const std::string& name) {
  measurements::MeasurementSet set = tests::make_gap_set(effects, runs);
  set.name = name;
  set.path = name + "/set.toml";
  return set;
}

models::ActiveEffect make_gain_error(double percent) {
  return tests::make_active(models::find_effect("torque_gain"), {percent});
}

Eigen::VectorXd simulate_baseline(const PreparedSet& set) {
  const diagnosis::Model model(set, {}, {});
  Eigen::VectorXd simulated;
  REQUIRE(
      model.simulate(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.unknown_count())), 1, simulated, nullptr));
  return simulated;
}

/// Mean force at the surface of the drum between two times of a run.
double read_force_N(const measurements::MeasuredRun& run, double radius_m, double from_s, double to_s) {
  const std::vector<double>& torque_Nm = run.columns.at("drum_torque_Nm");
  double sum_N = 0.0;
  int samples = 0;
  for (std::size_t i = 0; i < run.time_s.size(); ++i) {
    if (run.time_s[i] < from_s || run.time_s[i] >= to_s) continue;
    sum_N += torque_Nm[i] / radius_m;
    ++samples;
  }
  return sum_N / samples;
}

}  // namespace

TEST_CASE("a gain error makes the coefficient of its machine larger or smaller by the same share", "[fast]") {
  const measurements::MeasurementSet exact = make_machine({}, 1, "exact");
  const double radius_m = 0.5 * exact.rig->drum.diameter_m;
  // Run 1: skim to 300 s, 80 km/h to 1,700 s, 110 km/h to 2,740 s, skim; at 5,400 N. A laboratory reads last minutes.
  const measurements::MeasuredRun& run = exact.runs.front();
  const auto last_minute_N = [&](double end_s) { return read_force_N(run, radius_m, end_s - 60.0, end_s); };
  const double loaded_N = 0.5 * (last_minute_N(1700.0) + last_minute_N(2740.0));
  const double skim_N = 0.5 * (last_minute_N(300.0) + last_minute_N(3040.0));
  const double rrc_N_per_kN = 1e3 * (loaded_N - skim_N) / 5400.0;
  for (const double percent : {3.0, -3.0, 8.0}) {
    const measurements::MeasurementSet wrong = make_machine({make_gain_error(percent)}, 1, "wrong");
    const double expected = 1e-2 * percent * rrc_N_per_kN;
    const PreparedSet first({wrong, exact}), second({exact, wrong});
    CHECK(read_rrc_difference(first, simulate_baseline(first)).value_N_per_kN == Approx(expected).epsilon(0.02));
    CHECK(read_rrc_difference(second, simulate_baseline(second)).value_N_per_kN == Approx(-expected).epsilon(0.02));
  }
}

TEST_CASE("the ratio of two machines that agree is 1, and that of a torque in another unit is of the unit", "[fast]") {
  const measurements::MeasurementSet exact = make_machine({}, 1, "exact");
  measurements::MeasurementSet scaled = make_machine({}, 1, "scaled");
  const PreparedSet alike({exact, scaled});
  CHECK(read_rrc_ratio(alike, simulate_baseline(alike)) == Approx(1.0).epsilon(1e-6));
  for (measurements::MeasuredRun& run : scaled.runs) {
    for (double& value : run.columns.at("drum_torque_Nm")) value *= 0.737562;
  }
  const PreparedSet pair({exact, scaled});
  CHECK(read_rrc_ratio(pair, simulate_baseline(pair)) == Approx(0.737562).epsilon(0.005));
}

TEST_CASE("without a skim test the offset of the sensor widens the interval, also where the run-up is at skim load",
          "[fast]") {
  const measurements::MeasurementSet exact = make_machine({}, 1, "exact");
  const auto cut = [](measurements::MeasurementSet set, const std::string& name, std::size_t first) {
    set.path = name + "/set.toml";
    measurements::MeasuredRun& only = set.runs.front();
    const auto keep = [first](std::vector<double>& values) {
      values = std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first), values.begin() + 2700);
    };
    keep(only.time_s);
    for (auto& [channel, values] : only.columns) keep(values);
    return set;
  };
  const auto width = [](const std::vector<measurements::MeasurementSet>& sets) {
    const PreparedSet pair(sets);
    const rollrig::RrcEstimate read = read_rrc_difference(pair, simulate_baseline(pair));
    CHECK(std::abs(read.value_N_per_kN) < 0.1);
    return read.high_95_N_per_kN - read.low_95_N_per_kN;
  };
  const double with_skim = width({exact, make_machine({}, 1, "other")});
  const double without = width({cut(exact, "a", 300), cut(exact, "b", 300)});
  CHECK(without > 2.0 * with_skim);
  CHECK(without < 2.0);
  // Two seconds at skim load are no skim test.
  CHECK(width({cut(exact, "a", 298), cut(exact, "b", 298)}) < 2.0);
}

TEST_CASE("an offset of a sensor makes no difference of coefficients where there is a skim test", "[fast]") {
  const measurements::MeasurementSet exact = make_machine({}, 2, "exact");
  measurements::MeasurementSet shifted = make_machine({}, 2, "shifted");
  for (measurements::MeasuredRun& run : shifted.runs) {
    tests::add_to_channel(run, "drum_torque_Nm", [](double) { return 3.0; });
  }
  const PreparedSet pair({shifted, exact});
  CHECK(read_rrc_difference(pair, simulate_baseline(pair)).value_N_per_kN == Approx(0.0).margin(1e-3));
}

TEST_CASE("the interval of the difference of coefficients holds the true one", "[fast]") {
  const measurements::MeasurementSet a = make_machine({}, 3, "a"), b = make_machine({make_gain_error(2.0)}, 3, "b");
  const PreparedSet clean({a, b});
  const Eigen::VectorXd simulated = simulate_baseline(clean);
  const double expected = read_rrc_difference(clean, simulated).value_N_per_kN;
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  constexpr int kSets = 60;
  int held = 0;
  double width_N_per_kN = 0.0;
  for (int i = 0; i < kSets; ++i) {
    std::vector<measurements::MeasurementSet> sets{a, b};
    for (measurements::MeasurementSet& set : sets) {
      const models::SensorParameters& sensor = set.sensors.at("drum_torque_Nm");
      for (measurements::MeasuredRun& run : set.runs) {
        for (double& value : run.columns["drum_torque_Nm"]) value += sensor.noise_sd * normal(engine);
      }
    }
    const rollrig::RrcEstimate read = read_rrc_difference(PreparedSet(sets), simulated);
    if (read.low_95_N_per_kN <= expected && expected <= read.high_95_N_per_kN) ++held;
    width_N_per_kN += (read.high_95_N_per_kN - read.low_95_N_per_kN) / kSets;
  }
  CHECK(held >= 54);
  // White noise of 0.15 N m alone would be far less; the sensor's drift is in the interval, too.
  CHECK(width_N_per_kN < 0.3);
}
