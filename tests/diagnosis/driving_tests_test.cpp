// Tests that could come next on a dynamometer and on the road.
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "diagnosis/kinds/kinds.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "diagnosis/next_test/next_test.h"
#include "diagnosis/next_test/predicted_test.h"
#include "tests/diagnosis/driving_sets.h"

using namespace rollrig;
using diagnosis::OpenHypothesis;

namespace {

/// A hypothesis whose parameters are known to a third of their priors.
OpenHypothesis open(const diagnosis::Study& study, const std::string& effect) {
  diagnosis::Hypothesis hypothesis;
  if (!effect.empty()) hypothesis = hypothesis.with({&diagnosis::find_term(effect), 1});
  const auto count = static_cast<Eigen::Index>(study.make_model(hypothesis).parameter_count());
  return {hypothesis, Eigen::VectorXd::Zero(count), Eigen::MatrixXd::Identity(count, count) / 3.0, 0.5};
}

/// What a test of the menu tells two hypotheses apart by, by its id.
std::map<std::string, double> judge(const measurements::MeasurementSet& measured, const std::string& a,
                                    const std::string& b) {
  const diagnosis::Study study(measured);
  const std::vector<OpenHypothesis> both{open(study, a), open(study, b)};
  std::map<std::string, double> bits;
  for (const diagnosis::JudgedTest& one : diagnosis::judge_tests(study, both)) {
    INFO(one.test.id);
    CHECK(one.test.hours > 0.0);
    CHECK(diagnosis::PredictedTest(study, both, one.test).is_possible());
    CHECK(bits.emplace(one.test.id, one.bits).second);
    CHECK(one.bits >= 0.0);
    CHECK(one.bits <= 1.0 + 1e-9);
  }
  return bits;
}

}  // namespace

TEST_CASE("every test of a dynamometer can be simulated, and drive and brake force shows slip", "[fast]") {
  const auto bits = judge(tests::make_dyno_set({}, 1), "", "slip_loss");
  CHECK(bits.size() >= 10);
  CHECK(bits.at("drive_and_brake") > 0.5);
  CHECK(bits.at("drive_and_brake") > bits.at("soak_with_pressure"));
}

TEST_CASE("every test of the road can be simulated, and a cold start shows the tire's temperature", "[fast]") {
  measurements::MeasurementSet set = tests::make_road_set({}, 1);
  set.sensors.at("traction_force_N") = {5.0, 15.0, 13.0, 20.0, 0.0};
  const auto bits = judge(set, "", "tire_temperature");
  CHECK(bits.size() >= 5);
  CHECK(bits.at("steady_from_cold") > 0.3);
}

TEST_CASE("a test of the road on five days tells more than on one, and takes five times as long", "[fast]") {
  const measurements::MeasurementSet set = tests::make_road_set({}, 1);
  const auto bits = judge(set, "", "tire_temperature");
  std::map<std::string, diagnosis::PlannedTest> menu;
  for (const auto& test : diagnosis::make_road_tests(diagnosis::PreparedSet(set))) menu.emplace(test.id, test);
  for (const char* id : {"steady_from_cold", "cold_air", "warm_steps", "ramps", "rests"}) {
    INFO(id);
    const std::string repeated = std::string(id) + "_repeated";
    CHECK(bits.at(repeated) > bits.at(id));
    CHECK(menu.at(repeated).hours == Approx(5.0 * menu.at(id).hours));
    std::set<std::string> ids, sessions;
    for (const auto& run : menu.at(repeated).runs) ids.insert(run.id), sessions.insert(run.session);
    CHECK(ids.size() == 5 * menu.at(id).runs.size());
    CHECK(sessions.size() == 5);
  }
}
