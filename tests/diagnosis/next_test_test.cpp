#include "diagnosis/next_test/next_test.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "diagnosis/findings/lead.h"
#include "diagnosis/next_test/predicted_test.h"
#include "diagnosis/thresholds.h"
#include "tests/diagnosis/compared_set.h"

using namespace rollrig;
using namespace rollrig::diagnosis;
using tests::bearings_or_zero;
using tests::find_judged;
using tests::make_open;

namespace {

const JudgedTest& find_described(const std::vector<JudgedTest>& judged, const std::string& description) {
  return *std::find_if(judged.begin(), judged.end(),
                       [&](const JudgedTest& one) { return one.test.description == description; });
}

double calc_mean_bits_per_hour(const std::vector<JudgedTest>& judged) {
  double sum = 0.0;
  for (const JudgedTest& one : judged) sum += one.bits / one.test.hours;
  return sum / static_cast<double>(judged.size());
}

}  // namespace

TEST_CASE("every test of the menu runs on paper and takes its hours", "[fast]") {
  const Study& study = bearings_or_zero().study;
  std::set<std::string> ids;
  for (const PlannedTest& test : make_test_menu(study.set)) {
    INFO(test.id);
    ids.insert(test.id);
    double rolling_h = 0.0;
    for (const measurements::MeasuredRun& run : test.runs) rolling_h += run.time_s.back() / 3600.0;
    CHECK(test.hours >= rolling_h + 0.5);  // set-up
    CHECK(test.hours < 24.0);
    CHECK(PredictedTest(study, make_open(study, {"none", "bearing_warmup"}), test).is_possible());
  }
  CHECK(ids.size() == make_test_menu(study.set).size());
}

TEST_CASE("identical hypotheses leave nothing to learn, and none teaches more than there is to know", "[fast]") {
  const Study& study = bearings_or_zero().study;
  for (const JudgedTest& one : judge_tests(study, make_open(study, {"rim_heat", "rim_heat"}))) {
    INFO(one.test.id);
    CHECK(one.bits == Approx(0.0).margin(1e-6));
    CHECK(one.splits.empty());
  }
  for (const JudgedTest& one : judge_tests(study, make_open(study, {"none", "slow_leak", "load_exponent"}))) {
    INFO(one.test.id);
    CHECK(one.bits >= 0.0);
    CHECK(one.bits <= std::log2(3.0) + 1e-9);
  }
}

TEST_CASE("warming bearings and a drifting zero are split by the torque at standstill", "[slow]") {
  const Study& study = bearings_or_zero().study;
  std::vector<OpenHypothesis> open = bearings_or_zero().find_open();
  REQUIRE(open.size() >= 2);
  CHECK(open[0].hypothesis.names() == std::vector<std::string>{"bearing_warmup"});
  CHECK(open[1].hypothesis.names() == std::vector<std::string>{"torque_zero_drift"});
  CHECK(open[0].probability == Approx(open[1].probability));  // the set cannot tell them apart
  const std::vector<diagnosis::ProposedTest> proposed = bearings_or_zero().propose();
  REQUIRE(!proposed.empty());
  std::vector<JudgedTest> judged = judge_tests(study, open);
  const std::string best = find_described(judged, proposed.front().test).test.id;
  CHECK((best == "standstill_torque" || best == "standstill_at_loads" || best == "drum_alone"));  // the zero is read
  CHECK(proposed.front().splits.size() == 2);
  CHECK(proposed.front().expected_bits_per_hour > 2.0 * calc_mean_bits_per_hour(judged));
  open.resize(2);  // without both at once
  for (OpenHypothesis& one : open) one.probability = 0.5;
  judged = judge_tests(study, open);
  CHECK(find_judged(judged, "standstill_torque").bits > 0.9);  // of one bit
}

TEST_CASE("a proposal does not depend on the number of threads", "[slow]") {
  tests::ComparedSet set = tests::compare_bearings_or_zero();
  set.study.settings.threads = 1;
  const std::vector<diagnosis::ProposedTest> one = set.propose();
  set.study.settings.threads = 2;
  const std::vector<diagnosis::ProposedTest> two = set.propose();
  REQUIRE(one.size() == two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].test == two[i].test);
    CHECK(one[i].expected_bits_per_hour == two[i].expected_bits_per_hour);
  }
}

TEST_CASE("bearings that warm and a loss of the tire in skim are split best by their row of the menu", "[fast]") {
  const Study& study = bearings_or_zero().study;
  const std::vector<JudgedTest> judged = judge_tests(study, make_open(study, {"bearing_warmup", "tire_loss_in_skim"}));
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
  const Study& study = bearings_or_zero().study;
  const auto clocks = judge_tests(study, make_open(study, {"none", "clock_shift"}));
  CHECK(find_judged(clocks, "speed_steps_with_pulse").bits > find_judged(clocks, "speed_steps_hot").bits);
  CHECK(find_judged(clocks, "standstill_torque").bits < 0.05);
  const auto rims = judge_tests(study, make_open(study, {"none", "rim_heat"}));
  CHECK(find_judged(rims, "rim_thermocouple").bits > find_judged(rims, "short_soak").bits);
  CHECK(find_judged(rims, "standstill_torque").bits < 0.05);
  const auto zeros = judge_tests(study, make_open(study, {"none", "torque_zero_drift"}));
  CHECK(find_judged(zeros, "soak_with_pressure").bits < 0.2 * find_judged(zeros, "standstill_torque").bits);
}

TEST_CASE("without a gap the test is proposed that would show what is not excluded", "[fast]") {
  const tests::ComparedSet compared(tests::measure_on_drum({}, {tests::plan_skim_run()}), {"standing_wave"});
  const std::vector<OpenHypothesis> open = compared.find_open();
  REQUIRE(open.size() == 2);
  CHECK(open[0].hypothesis.terms.empty());
  const std::vector<diagnosis::ProposedTest> proposed = compared.propose();
  REQUIRE(!proposed.empty());
  CHECK(proposed.front().test == find_judged(judge_tests(compared.study, open), "fast_steps").test.description);
}

TEST_CASE("weights on a lever read the zero and reversed rotation turns it over", "[fast]") {
  const Study& study = bearings_or_zero().study;
  const auto zeros = judge_tests(study, make_open(study, {"none", "torque_zero_drift"}));
  // The drift is the same with weights on; a tire standing for minutes shows less of it than before and after a run.
  CHECK(find_judged(zeros, "dead_weights").bits < find_judged(zeros, "standstill_torque").bits);
  // Friction that goes with load keeps its sign in reversed rotation: turning round does not hide it.
  const auto friction = judge_tests(study, make_open(study, {"none", "bearing_load_friction"}));
  CHECK(find_judged(friction, "reversed_rotation").bits > 0.05);
  CHECK(find_judged(friction, "dead_weights").bits < 0.01);
  const auto inertia = judge_tests(study, make_open(study, {"none", "inertia_error"}));
  const double by_ramps = find_judged(inertia, "ramps").bits;
  CHECK(by_ramps > find_judged(inertia, "drum_alone").bits);
  CHECK(by_ramps > 0.1);
}

TEST_CASE("to repeat a run that could not show an effect tells next to nothing of it", "[fast]") {
  tests::ComparedSet compared(tests::measure_on_drum({}, {tests::plan_skim_run()}), {"bearing_load_friction"});
  compared.comparison.candidates.clear();  // as an effect that was not refitted
  const std::vector<OpenHypothesis> open = compared.find_open();
  REQUIRE(open.size() == 2);
  const measurements::MeasuredRun run = tests::plan_skim_run();
  PlannedTest again{"again", "again", 1.0, {run}, {}, false};
  measurements::MeasuredRun& rows = again.runs.front();
  rows.time_s.clear();
  rows.columns.clear();
  for (std::size_t row = 0; row < run.time_s.size(); row += static_cast<std::size_t>(kVirtualRow_s)) {
    rows.time_s.push_back(run.time_s[row]);
    for (const auto& [column, values] : run.columns) rows.columns[column].push_back(values[row]);
    for (const Quantity& channel : compared.study.set.channels()) rows.columns[channel].push_back(0.0);
  }
  const std::vector<double> even{0.5, 0.5};
  CHECK(calc_information_bits(even, PredictedTest(compared.study, open, again).find_outcomes()) < 0.05);
}

TEST_CASE("with nothing open no test is proposed", "[fast]") {
  tests::ComparedSet compared = tests::compare_bearings_or_zero();
  compared.comparison.candidates.resize(1);
  compared.study.settings.terms.clear();
  CHECK(compared.propose().empty());
}

TEST_CASE("the proposed test, run, splits what it said it would", "[slow]") {
  const std::vector<std::string> effects{"tire_loss_in_skim", "load_exponent"};
  const std::vector<models::ActiveEffect> truth{tests::act("tire_loss_in_skim", 1.5)};
  const tests::ComparedSet before(tests::measure_on_drum(truth, {tests::plan_skim_run()}), effects);
  const auto find_factor = [](const tests::ComparedSet& compared) {
    const auto find = [&](const std::string& id) -> const Candidate& {
      return *std::find_if(compared.comparison.candidates.begin(), compared.comparison.candidates.end(),
                           [&](const Candidate& one) { return one.fit.hypothesis.name() == id; });
    };
    return expected_log_bayes_factor(compared.study, find("tire_loss_in_skim"), find("load_exponent"));
  };
  REQUIRE(find_factor(before) < thresholds::kToldApart_nats);
  const std::vector<diagnosis::ProposedTest> proposed = before.propose();
  REQUIRE(!proposed.empty());
  CHECK(proposed.front().splits.size() >= 2);
  std::vector<measurements::MeasuredRun> runs{tests::plan_skim_run()};
  for (const PlannedTest& test : make_test_menu(before.study.set)) {
    if (test.description == proposed.front().test) runs.insert(runs.end(), test.runs.begin(), test.runs.end());
  }
  REQUIRE(runs.size() >= 2);
  const tests::ComparedSet after(tests::measure_on_drum(truth, runs), effects);
  CHECK(find_factor(after) >= thresholds::kToldApart_nats);
  CHECK(after.comparison.candidates.front().fit.hypothesis.contains(find_term("tire_loss_in_skim")));
}
