#include "diagnosis/next_test/next_test.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "diagnosis/checks/rig_sensors.h"
#include "diagnosis/comparison/base_parameters.h"
#include "diagnosis/findings/verdict.h"
#include "diagnosis/kinds/kinds.h"
#include "measurements/replay.h"
#include "measurements/sensor_file.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

/// An effect on, its size a multiple of the middle of its prior.
models::ActiveEffect act(const std::string& id, double size = 1.0) {
  const models::Effect& effect = models::find_effect(id);
  std::vector<double> values;
  for (const models::EffectParameter& parameter : effect.info.parameters) values.push_back(parameter.prior.center());
  values.front() *= size;
  return tests::make_active(effect, values);
}

/// Skim, 25 min at 80 km/h, skim, at 1 Hz.
measurements::MeasuredRun plan_skim_run() {
  measurements::MeasuredRun run;
  run.id = "warm-up";
  run.session = "day";
  run.initial_tire_temperature_K = 298.15;
  run.cold_pressure_Pa = 280e3;
  constexpr double kSkim_s = 180.0;
  constexpr double kLoaded_s = 1500.0;
  for (double time_s = 0.0; time_s < 2.0 * kSkim_s + kLoaded_s; time_s += 1.0) {
    const bool loaded = time_s >= kSkim_s && time_s < kSkim_s + kLoaded_s;
    run.time_s.push_back(time_s);
    run.columns["speed_km_h"].push_back(80.0 / 3.6);
    run.columns["load_N"].push_back(loaded ? 5400.0 : 200.0);
    run.columns["ambient_degC"].push_back(298.15);
  }
  return run;
}

/// Runs of the asset tire on the asset rig with effects on, measured with noise.
measurements::MeasurementSet measure(const std::vector<models::ActiveEffect>& effects,
                                     std::vector<measurements::MeasuredRun> runs) {
  constexpr std::uint64_t kSeed = 1;
  measurements::MeasurementSet set;
  set.path = "simulated";
  set.name = "simulated";
  set.tire = tests::read_asset_tire();
  set.rig = tests::read_asset_rig();
  set.sensors = measurements::read_sensor_asset("source");
  for (measurements::MeasuredRun& run : runs) {
    models::Corner<double> corner(rigs::make_context(set.tire, *set.rig, set.baseline), effects);
    const auto recording = measurements::replay_drum_run<double>(set, run, measurements::make_drum_replay(run), corner);
    for (const auto& [channel, sensor] : set.sensors) run.columns[channel] = recording.channel(channel);
    set.runs.push_back(std::move(run));
  }
  return tests::add_noise(set, kSeed);
}

struct Raced {
  Raced(const measurements::MeasurementSet& measured, const std::vector<std::string>& effects)
      : set(measured), base(find_base_parameters(set.source(), set.context())), discrepancy(set) {
    ComparisonSettings settings;
    for (const std::string& id : effects) settings.effects.push_back(&models::find_effect(id));
    comparison = compare_models(set, base, discrepancy, settings);
  }

  std::vector<OpenHypothesis> find_open() const { return find_open_hypotheses(set, base, discrepancy, comparison, 1); }
  std::vector<JudgedTest> judge(const std::vector<OpenHypothesis>& open) const {
    return judge_tests(set, base, open, 0);
  }
  std::vector<NextTest> propose(int threads = 0) const { return propose_tests(set, base, find_open(), threads); }

  PreparedSet set;
  std::vector<estimation::FreeParameter> base;
  Discrepancy discrepancy;
  Comparison comparison;
};

/// A warm-up in which only what warms shows, with bearings that do: the torque's zero could drift as well.
const Raced& bearings_or_zero() {
  static const Raced compared(measure({act("bearing_warmup")}, {plan_skim_run()}),
                              {"bearing_warmup", "torque_zero_drift"});
  return compared;
}

/// The baseline and each of the effects, at the middle of its prior and as uncertain, all as likely.
std::vector<OpenHypothesis> make_open(const Raced& compared, const std::vector<std::string>& effects) {
  std::vector<OpenHypothesis> open;
  const double share = 1.0 / static_cast<double>(effects.size());
  for (const std::string& id : effects) {
    Hypothesis hypothesis;
    if (id != "none") hypothesis.effects.push_back({&models::find_effect(id), 1});
    const auto count = static_cast<Eigen::Index>(Model(compared.set, compared.base, hypothesis).parameter_count());
    Eigen::MatrixXd spread = Eigen::MatrixXd::Identity(count, count);
    spread.bottomRightCorner(compared.base.size(), compared.base.size()) *= 0.3;  // after some measurement
    open.push_back({hypothesis, Eigen::VectorXd::Zero(count), spread, share});
  }
  return open;
}

const JudgedTest& find_judged(const std::vector<JudgedTest>& judged, const std::string& id) {
  return *std::find_if(judged.begin(), judged.end(), [&](const JudgedTest& one) { return one.test.id == id; });
}

const JudgedTest& find_described(const std::vector<JudgedTest>& judged, const std::string& description) {
  return *std::find_if(judged.begin(), judged.end(),
                       [&](const JudgedTest& one) { return one.test.description == description; });
}

double calc_mean_bits_per_hour(const std::vector<JudgedTest>& judged) {
  double sum = 0.0;
  for (const JudgedTest& one : judged) sum += one.bits / one.test.hours;
  return sum / static_cast<double>(judged.size());
}

PredictedOutcome make_outcome(double mean, double sd) {
  return {Eigen::VectorXd::Constant(1, mean), Eigen::MatrixXd::Constant(1, 1, sd * sd)};
}

/// Mutual information of two normal distributions and which of them was drawn from, by quadrature.
double integrate_information_bits(double w, double mean, double sd) {
  const auto density = [](double x, double m, double s) {
    return std::exp(-0.5 * (x - m) * (x - m) / (s * s)) / (s * std::sqrt(2.0 * M_PI));
  };
  const auto gain = [&](double x) {
    const double p = density(x, 0.0, 1.0);
    const double q = density(x, mean, sd);
    const double mixture = w * p + (1.0 - w) * q;
    return (p > 0.0 ? w * p * std::log2(p / mixture) : 0.0) + (q > 0.0 ? (1.0 - w) * q * std::log2(q / mixture) : 0.0);
  };
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(gain, -30.0, 30.0, 12, 1e-9);
}

}  // namespace

TEST_CASE("information lies between nothing and the entropy, below the exact value", "[fast]") {
  for (const double w : {0.5, 0.1}) {
    const std::vector<double> weights{w, 1.0 - w};
    CHECK(calc_information_bits(weights, {make_outcome(0.0, 1.0), make_outcome(0.0, 1.0)}) ==
          Approx(0.0).margin(1e-12));
    CHECK(calc_information_bits(weights, {make_outcome(0.0, 1.0), make_outcome(50.0, 1.0)}) ==
          Approx(calc_entropy_bits(weights)));
    for (const double mean : {0.5, 1.0, 2.0, 4.0}) {
      for (const double sd : {0.5, 1.0, 3.0}) {
        const double bound = calc_information_bits(weights, {make_outcome(0.0, 1.0), make_outcome(mean, sd)});
        const double exact = integrate_information_bits(w, mean, sd);
        INFO("w " << w << " mean " << mean << " sd " << sd);
        CHECK(bound > 0.0);
        CHECK(bound <= exact + 1e-6);
        CHECK(bound >= 0.25 * exact);  // of use, not merely a bound
      }
    }
  }
}

TEST_CASE("an expected log Bayes factor is half the squared distance of equal normals", "[fast]") {
  CHECK(calc_divergence_nats(make_outcome(0.0, 2.0), make_outcome(6.0, 2.0)) == Approx(4.5));
  CHECK(4.0 * calc_overlap_distance_nats(make_outcome(0.0, 2.0), make_outcome(6.0, 2.0)) == Approx(4.5));
  CHECK(calc_divergence_nats(make_outcome(1.0, 1.0), make_outcome(1.0, 1.0)) == Approx(0.0).margin(1e-12));
}

TEST_CASE("every test of the menu runs on paper and takes its hours", "[fast]") {
  const Raced& compared = bearings_or_zero();
  std::set<std::string> ids;
  for (const PlannedTest& test : make_test_menu(compared.set)) {
    INFO(test.id);
    ids.insert(test.id);
    double rolling_h = 0.0;
    for (const measurements::MeasuredRun& run : test.runs) rolling_h += run.time_s.back() / 3600.0;
    CHECK(test.hours >= rolling_h + 0.5);  // set-up
    CHECK(test.hours < 24.0);
    CHECK(
        !predict_outcomes(compared.set, compared.base, make_open(compared, {"none", "bearing_warmup"}), test).empty());
  }
  CHECK(ids.size() == make_test_menu(compared.set).size());
}

TEST_CASE("identical hypotheses leave nothing to learn, and none teaches more than there is to know", "[fast]") {
  const Raced& compared = bearings_or_zero();
  for (const JudgedTest& one : compared.judge(make_open(compared, {"rim_heat", "rim_heat"}))) {
    INFO(one.test.id);
    CHECK(one.bits == Approx(0.0).margin(1e-6));
    CHECK(one.splits.empty());
  }
  for (const JudgedTest& one : compared.judge(make_open(compared, {"none", "slow_leak", "load_exponent"}))) {
    INFO(one.test.id);
    CHECK(one.bits >= 0.0);
    CHECK(one.bits <= std::log2(3.0) + 1e-9);
  }
}

TEST_CASE("warming bearings and a drifting zero are split by the torque at standstill", "[fast]") {
  const Raced& compared = bearings_or_zero();
  std::vector<OpenHypothesis> open = compared.find_open();
  REQUIRE(open.size() >= 2);
  CHECK(open[0].hypothesis.ids() == std::vector<std::string>{"bearing_warmup"});
  CHECK(open[1].hypothesis.ids() == std::vector<std::string>{"torque_zero_drift"});
  CHECK(open[0].probability == Approx(open[1].probability));  // the set cannot tell them apart
  const std::vector<NextTest> proposed = compared.propose();
  REQUIRE(!proposed.empty());
  std::vector<JudgedTest> judged = compared.judge(open);
  const std::string best = find_described(judged, proposed.front().test).test.id;
  CHECK((best == "standstill_torque" || best == "standstill_at_loads" || best == "drum_alone"));  // the zero is read
  CHECK(proposed.front().splits.size() == 2);
  CHECK(proposed.front().expected_bits_per_hour > 2.0 * calc_mean_bits_per_hour(judged));
  open.resize(2);  // without both at once
  for (OpenHypothesis& one : open) one.probability = 0.5;
  judged = compared.judge(open);
  CHECK(find_judged(judged, "standstill_torque").bits > 0.9);  // of one bit
}

TEST_CASE("a proposal does not depend on the number of threads", "[fast]") {
  const std::vector<NextTest> one = bearings_or_zero().propose(1);
  const std::vector<NextTest> two = bearings_or_zero().propose(2);
  REQUIRE(one.size() == two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].test == two[i].test);
    CHECK(one[i].expected_bits_per_hour == two[i].expected_bits_per_hour);
  }
}

TEST_CASE("bearings that warm and a loss of the tire in skim are split best by their row of the menu", "[fast]") {
  const Raced& compared = bearings_or_zero();
  const std::vector<JudgedTest> judged = compared.judge(make_open(compared, {"bearing_warmup", "tire_loss_in_skim"}));
  const auto most = [&](const auto& value) {
    return *std::max_element(judged.begin(), judged.end(),
                             [&](const JudgedTest& a, const JudgedTest& b) { return value(a) < value(b); });
  };
  const std::set<std::string> row{"drum_alone", "standstill_torque", "skim_at_loads", "skim_at_loads_hot"};
  CHECK(row.count(most([](const JudgedTest& one) { return one.bits; }).test.id) == 1);
  CHECK(find_judged(judged, "drum_alone").splits.size() == 2);
  CHECK(find_judged(judged, "skim_at_loads").splits.size() == 2);
  // An hour, tests that need no soak tell more.
  const JudgedTest best = most([](const JudgedTest& one) { return one.bits / one.test.hours; });
  CHECK(best.splits.size() == 2);
  CHECK(best.bits / best.test.hours > 1.5 * calc_mean_bits_per_hour(judged));
}

TEST_CASE("readings beyond the usual channels tell what they are for", "[fast]") {
  const Raced& compared = bearings_or_zero();
  const auto clocks = compared.judge(make_open(compared, {"none", "clock_shift"}));
  CHECK(find_judged(clocks, "speed_steps_with_pulse").bits > find_judged(clocks, "speed_steps_hot").bits);
  CHECK(find_judged(clocks, "standstill_torque").bits < 0.05);
  const auto rims = compared.judge(make_open(compared, {"none", "rim_heat"}));
  CHECK(find_judged(rims, "rim_thermocouple").bits > find_judged(rims, "short_soak").bits);
  CHECK(find_judged(rims, "standstill_torque").bits < 0.05);
  const auto zeros = compared.judge(make_open(compared, {"none", "torque_zero_drift"}));
  CHECK(find_judged(zeros, "soak_with_pressure").bits < 0.2 * find_judged(zeros, "standstill_torque").bits);
}

TEST_CASE("without a gap the test is proposed that would show what is not excluded", "[fast]") {
  const Raced compared(measure({}, {plan_skim_run()}), {"standing_wave"});
  const std::vector<OpenHypothesis> open = compared.find_open();
  REQUIRE(open.size() == 2);
  CHECK(open[0].hypothesis.effects.empty());
  const std::vector<NextTest> proposed = compared.propose();
  REQUIRE(!proposed.empty());
  CHECK(proposed.front().test == find_judged(compared.judge(open), "fast_steps").test.description);
}

TEST_CASE("a sensor tells what it is for, and nothing of what it does not see", "[fast]") {
  const Raced& compared = bearings_or_zero();
  const auto find = [](const std::vector<NextSensor>& sensors, const std::string& word) -> const NextSensor* {
    for (const NextSensor& one : sensors) {
      if (one.sensor.find(word) != std::string::npos) return &one;
    }
    return nullptr;
  };
  const auto propose = [&](const std::vector<std::string>& effects) {
    return propose_sensors(compared.set, compared.base, make_open(compared, effects));
  };
  const std::vector<NextSensor> surface = propose({"none", "surface_warming"});
  REQUIRE(find(surface, "surface") != nullptr);
  CHECK(surface.front().sensor == find(surface, "surface")->sensor);
  CHECK(surface.front().expected_bits > 0.0);
  CHECK(surface.front().expected_bits <= 1.0);
  const std::vector<NextSensor> rim = propose({"none", "rim_heat"});
  REQUIRE(find(rim, "rim") != nullptr);
  CHECK(find(rim, "load cell") == nullptr);
  CHECK(find(rim, "light barrier") == nullptr);
  // Bearings or tire: only the spindle's force knows which, among all that could be fitted.
  const std::vector<NextSensor> bearings = propose({"bearing_warmup", "tire_loss_in_skim"});
  for (const NextSensor& one : bearings) CHECK(one.expected_bits >= 0.01);
  CHECK(find(bearings, "surface") == nullptr);
  CHECK(find(bearings, "gauge") == nullptr);
  // Nothing but the torque's own zero drifts: no other sensor sees it, but one of the same force does.
  const std::vector<NextSensor> zero = propose({"none", "torque_zero_drift"});
  for (const NextSensor& one : zero) CHECK(find({one}, "spindle") != nullptr);
}

TEST_CASE("identical hypotheses and a lone one leave no sensor worth its hours", "[fast]") {
  const Raced& compared = bearings_or_zero();
  CHECK(propose_sensors(compared.set, compared.base, make_open(compared, {"rim_heat", "rim_heat"})).empty());
  CHECK(propose_sensors(compared.set, compared.base, make_open(compared, {"rim_heat"})).empty());
}

TEST_CASE("a sensor that the rig has is not proposed", "[fast]") {
  const Raced& compared = bearings_or_zero();
  const PlannedTest test = make_drum_sensor_test(compared.set);
  for (const std::string& channel : compared.set.channels()) {
    CHECK(std::find(test.extra.sensors.begin(), test.extra.sensors.end(), channel) == test.extra.sensors.end());
  }
  CHECK(test.extra.sensors.size() >= 5);
}

TEST_CASE("weights on a lever read the zero and reversed rotation turns it over", "[fast]") {
  const Raced& compared = bearings_or_zero();
  const auto zeros = compared.judge(make_open(compared, {"none", "torque_zero_drift"}));
  // The drift is the same with weights on; a tire standing for minutes shows less of it than before and after a run.
  CHECK(find_judged(zeros, "dead_weights").bits < find_judged(zeros, "standstill_torque").bits);
  // Friction that goes with load keeps its sign in reversed rotation: turning round does not hide it.
  const auto friction = compared.judge(make_open(compared, {"none", "bearing_load_friction"}));
  CHECK(find_judged(friction, "reversed_rotation").bits > 0.05);
  CHECK(find_judged(friction, "dead_weights").bits < 0.01);
  const auto inertia = compared.judge(make_open(compared, {"none", "inertia_error"}));
  const double by_ramps = find_judged(inertia, "ramps").bits;
  CHECK(by_ramps > find_judged(inertia, "drum_alone").bits);
  CHECK(by_ramps > 0.1);
}

TEST_CASE("weights on a lever are read with the gain that a bent sensor has at their torque", "[fast]") {
  const Raced& compared = bearings_or_zero();
  const models::Corner<double> corner(compared.set.context(),
                                      {tests::make_active(models::find_effect("torque_gain"), {2.0, -0.3})});
  measurements::MeasuredRun run;
  run.time_s = {0.0, 1.0, 2.0};
  run.columns = {{"load_N", {0.0, 0.0, 0.0}}, {"ambient_degC", {298.15, 298.15, 298.15}}};
  run.columns[measurements::kHungTorque] = {0.0, 60.0, 600.0};
  sim::Recording<double> recording;
  recording.channels.push_back({"drum_torque_Nm"});
  recording.values = {{0.0, 0.0, 0.0}};
  const std::vector<double> read_Nm = read_channel(compared.set, run, corner, recording, "drum_torque_Nm");
  CHECK(read_Nm[0] == 0.0);
  CHECK(read_Nm[1] == Approx(61.2));  // 60 N at a radius of 1 m
  CHECK(read_Nm[2] > 600.0);
  CHECK(read_Nm[2] < 600.0 + 0.6 * 12.0);
}

TEST_CASE("to repeat a run that could not show an effect tells next to nothing of it", "[fast]") {
  Raced compared(measure({}, {plan_skim_run()}), {"bearing_load_friction"});
  compared.comparison.candidates.clear();  // as an effect that was not refitted
  const std::vector<OpenHypothesis> open = compared.find_open();
  REQUIRE(open.size() == 2);
  const measurements::MeasuredRun run = plan_skim_run();
  PlannedTest again{"again", "again", 1.0, {run}, {}, false};
  measurements::MeasuredRun& rows = again.runs.front();
  rows.time_s.clear();
  rows.columns.clear();
  for (std::size_t row = 0; row < run.time_s.size(); row += static_cast<std::size_t>(kVirtualRow_s)) {
    rows.time_s.push_back(run.time_s[row]);
    for (const auto& [column, values] : run.columns) rows.columns[column].push_back(values[row]);
    for (const std::string& channel : compared.set.channels()) rows.columns[channel].push_back(0.0);
  }
  const std::vector<double> even{0.5, 0.5};
  CHECK(calc_information_bits(even, predict_outcomes(compared.set, compared.base, open, again)) < 0.05);
}

TEST_CASE("with nothing open no test is proposed", "[fast]") {
  Raced compared = bearings_or_zero();
  compared.comparison.candidates.resize(1);
  compared.comparison.effects.clear();
  CHECK(compared.propose().empty());
}

TEST_CASE("the proposed test, run, splits what it said it would", "[slow]") {
  const std::vector<std::string> effects{"tire_loss_in_skim", "load_exponent"};
  const std::vector<models::ActiveEffect> truth{act("tire_loss_in_skim", 1.5)};
  const Raced before(measure(truth, {plan_skim_run()}), effects);
  const auto find_factor = [](const Raced& compared) {
    const auto find = [&](const std::string& id) -> const Candidate& {
      return *std::find_if(compared.comparison.candidates.begin(), compared.comparison.candidates.end(),
                           [&](const Candidate& one) { return one.fit.hypothesis.name() == id; });
    };
    return expected_log_bayes_factor(compared.discrepancy, find("tire_loss_in_skim"), find("load_exponent"));
  };
  REQUIRE(find_factor(before) < thresholds::kToldApart_nats);
  const std::vector<NextTest> proposed = before.propose();
  REQUIRE(!proposed.empty());
  CHECK(proposed.front().splits.size() >= 2);
  std::vector<measurements::MeasuredRun> runs{plan_skim_run()};
  for (const PlannedTest& test : make_test_menu(before.set)) {
    if (test.description == proposed.front().test) runs.insert(runs.end(), test.runs.begin(), test.runs.end());
  }
  REQUIRE(runs.size() >= 2);
  const Raced after(measure(truth, runs), effects);
  CHECK(find_factor(after) >= thresholds::kToldApart_nats);
  CHECK(after.comparison.candidates.front().fit.hypothesis.contains(models::find_effect("tire_loss_in_skim")));
}
