#include <algorithm>
#include <catch2/catch.hpp>

#include "diagnosis/checks/rig_sensors.h"
#include "diagnosis/kinds/kinds.h"
#include "tests/diagnosis/compared_set.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/machines.h"

using namespace rollrig;
using namespace rollrig::diagnosis;
using tests::bearings_or_zero;
using tests::make_open;

TEST_CASE("a sensor tells what it is for, and nothing of what it does not see", "[fast]") {
  const Study& study = bearings_or_zero().study;
  const auto find = [](const std::vector<NextSensor>& sensors, const std::string& word) -> const NextSensor* {
    for (const NextSensor& one : sensors) {
      if (one.sensor.find(word) != std::string::npos) return &one;
    }
    return nullptr;
  };
  const auto propose = [&](const std::vector<std::string>& effects) {
    return propose_sensors(study, make_open(study, effects));
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
  const Study& study = bearings_or_zero().study;
  CHECK(propose_sensors(study, make_open(study, {"rim_heat", "rim_heat"})).empty());
  CHECK(propose_sensors(study, make_open(study, {"rim_heat"})).empty());
}

TEST_CASE("a sensor that the rig has is not proposed", "[fast]") {
  const Study& study = bearings_or_zero().study;
  const PlannedTest test = make_drum_sensor_test(study.set);
  for (const Quantity& channel : study.set.channels()) {
    CHECK(std::find(test.extra.sensors.begin(), test.extra.sensors.end(), channel) == test.extra.sensors.end());
  }
  CHECK(test.extra.sensors.size() >= 5);
}

TEST_CASE("weights on a lever are read with the gain that a bent sensor has at their torque", "[fast]") {
  const Study& study = bearings_or_zero().study;
  const models::Corner<double> corner(study.set.context(),
                                      {tests::make_active(models::find_effect("torque_gain"), {2.0, -0.3})});
  measurements::MeasuredRun run;
  run.time_s = {0.0, 1.0, 2.0};
  run.columns["load_N"] = {0.0, 0.0, 0.0};
  run.columns["ambient_degC"] = {298.15, 298.15, 298.15};
  const double radius_m = study.set.source().rig->drum.diameter_m / 2.0;
  run.columns["hung_torque_Nm"] = {0.0, 60.0 * radius_m, 600.0 * radius_m};
  sim::Recording<double> recording;
  recording.channels.push_back({models::quantities::kDrumTorque});
  recording.values = {{0.0, 0.0, 0.0}};
  const std::vector<double> read_Nm = read_channel(study.set.source(), run, corner, recording, models::quantities::kDrumTorque);
  CHECK(read_Nm[0] == 0.0);
  CHECK(read_Nm[1] == Approx(61.2 * radius_m));  // 60 N at the surface
  CHECK(read_Nm[2] > 600.0 * radius_m);
  CHECK(read_Nm[2] < (600.0 + 0.6 * 12.0) * radius_m);
}
