// Tests that could come next on a dynamometer and on the road.
#include <catch2/catch.hpp>
#include <cmath>
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

TEST_CASE("weights on the roller's load cell tell its gain, and a scale and a counter what they are for", "[slow]") {
  const measurements::MeasurementSet set = tests::make_dyno_set({}, 1);
  const auto gains = judge(set, "", "torque_gain");
  // The gain may be none: what it is known to afterwards tells. No other test shows more of it an hour.
  CHECK(gains.at("dead_weights") > 0.1);
  CHECK(gains.at("dead_weights") > 2.0 * gains.at("steady_from_cold"));
  CHECK(gains.at("wheel_scale") < 0.01);  // no force is read
  const auto loads = judge(set, "", "load_record");
  CHECK(loads.at("wheel_scale") > 0.8);
  CHECK(loads.at("dead_weights") < 0.01);
  const auto straps = judge(set, "", "tie_down_load");
  CHECK(straps.at("wheel_scale") > 0.8);
  const auto speeds = judge(set, "", "speed_record");
  CHECK(speeds.at("light_barrier") > 0.8);
  CHECK(speeds.at("wheel_scale") < 0.01);
}

TEST_CASE("rollers that coast alone show nothing of the tire, and slow down by what they lose", "[fast]") {
  const measurements::MeasurementSet set = tests::make_dyno_set({}, 1);
  const auto bits = judge(set, "", "toe_camber_drag");
  CHECK(bits.at("lifted_coastdown") < 0.01);
  CHECK(bits.at("loaded_coastdown") > 0.2);
  const auto slip = judge(set, "", "slip_loss");
  CHECK(slip.at("loaded_coastdown") < 0.5 * slip.at("drive_and_brake"));  // hardly a force at the contact
  const double mass_kg = measurements::make_context(set).machine_mass_kg;
  for (const auto& test : diagnosis::make_dyno_tests(diagnosis::PreparedSet(set))) {
    if (test.id != "lifted_coastdown") continue;
    measurements::MeasurementSet coast = set;
    coast.runs = test.runs;
    tests::measure_again(coast, {});
    const measurements::MeasuredRun& run = coast.runs.front();
    const std::vector<double>& speed_m_s = run.columns.at("speed_km_h");
    std::size_t coasting = 0;
    for (std::size_t row = 1; row + 1 < speed_m_s.size(); ++row) {
      const double before_m_s = speed_m_s[row - 1] - speed_m_s[row];
      const double after_m_s = speed_m_s[row] - speed_m_s[row + 1];
      const double slowing_m_s2 = (before_m_s + after_m_s) / (run.time_s[row + 1] - run.time_s[row - 1]);
      const bool coasts = before_m_s > 0.0 && before_m_s < 2.0 && after_m_s > 0.5 * before_m_s;
      if (!coasts) continue;  // but driven, or at one of its ends
      CHECK(run.columns.at("loss_force_N")[row] == Approx(mass_kg * slowing_m_s2).epsilon(0.1));
      ++coasting;
    }
    CHECK(coasting > 30);
  }
}

TEST_CASE("with the vehicle turned round what moves the zero keeps its sign", "[fast]") {
  const measurements::MeasurementSet set = tests::make_dyno_set({}, 1);
  const auto bits = judge(set, "toe_camber_drag", "load_cross_talk");
  CHECK(bits.at("reversed_rotation") > bits.at("speed_steps_hot") + 0.1);
}

TEST_CASE("a coasting vehicle has no traction force, whatever the scale of that is", "[fast]") {
  measurements::MeasurementSet set = tests::make_road_set({}, 1, models::Baseline::kCombined);
  set.sensors.at("traction_force_N") = {5.0, 15.0, 13.0, 20.0, 0.0};
  for (const auto& test : diagnosis::make_road_tests(diagnosis::PreparedSet(set))) {
    if (test.id != "coastdown") continue;
    measurements::MeasurementSet coast = set;
    coast.runs = test.runs;
    const std::vector<double> planned_N = coast.runs.front().columns.at("traction_force_N");  // NaN: not read
    tests::measure_again(coast, {});
    const std::vector<double>& traction_N = coast.runs.front().columns.at("traction_force_N");
    double sum_N = 0.0;
    std::size_t count = 0;
    for (std::size_t row = 0; row < planned_N.size(); ++row) {
      if (std::isnan(planned_N[row])) continue;
      sum_N += traction_N[row];
      ++count;
    }
    REQUIRE(count > 60);
    CHECK(std::abs(sum_N / static_cast<double>(count)) < 60.0);  // of 300 to 900 N that drive it at these speeds
  }
}

TEST_CASE("a weighed vehicle tells a wrong mass from a wrong scale of the force", "[fast]") {
  measurements::MeasurementSet set = tests::make_road_set({}, 1, models::Baseline::kCombined);
  set.sensors.at("traction_force_N") = {5.0, 15.0, 13.0, 20.0, 0.0};
  const diagnosis::Study study(set);
  std::vector<OpenHypothesis> both{open(study, ""), open(study, "")};
  for (std::size_t i = 0; i < study.base.size(); ++i) {
    if (study.base[i].key == "vehicle.mass_kg") both[0].parameters[static_cast<Eigen::Index>(i)] = 1.0;
  }
  REQUIRE(both[0].parameters.norm() == 1.0);
  for (OpenHypothesis& one : both) one.spread *= 0.3;
  std::map<std::string, double> bits;
  for (const diagnosis::JudgedTest& one : diagnosis::judge_tests(study, both)) bits.emplace(one.test.id, one.bits);
  CHECK(bits.at("weighed_coastdown") > 0.9);
  CHECK(bits.at("weighed_coastdown") > bits.at("coastdown") + 0.1);
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
