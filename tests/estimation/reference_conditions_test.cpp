#include "estimation/road_load/reference_conditions.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace rollrig::estimation;

namespace {

const Eigen::Vector3d kMeasured(120.0, 1.8, 0.42);

ReferenceCorrection make_correction() {
  ReferenceCorrection correction;
  correction.ambient_K = 293.15;
  correction.ambient_pressure_Pa = 100e3;
  correction.mass_kg = 1800.0;
  correction.corrected_to_mass_kg = 1800.0;
  return correction;
}

}  // namespace

TEST_CASE("reference conditions: nothing changes at them", "[fast]") {
  CHECK((correct_to_reference(kMeasured, make_correction()) - kMeasured).norm() == Approx(0.0).margin(1e-12));
}

TEST_CASE("reference conditions: cold air makes tires and drag lose more, so the correction lowers both", "[fast]") {
  ReferenceCorrection correction = make_correction();
  correction.ambient_K = 283.15;
  correction.ambient_pressure_Pa = 95e3;
  const Eigen::Vector3d at = correct_to_reference(kMeasured, correction);
  CHECK(at(0) == Approx(120.0 * 0.914));  // 0.86 % a K
  CHECK(at(1) == Approx(1.8 * 0.914));
  // density as p/T
  CHECK(at(2) == Approx(0.42 * (100.0 / 293.15) / (95.0 / 283.15)));
}

TEST_CASE("reference conditions: the wind that both headings have, and the mass", "[fast]") {
  ReferenceCorrection correction = make_correction();
  correction.wind_m_s = 3.0;
  // the mean of (v + w)^2 and (v - w)^2 is v^2 + w^2
  CHECK(correct_to_reference(kMeasured, correction)(0) == Approx(120.0 - 0.42 * 9.0));
  correction = make_correction();
  correction.corrected_to_mass_kg = 1710.0;  // 5 % less
  CHECK(correct_to_reference(kMeasured, correction)(0) == Approx(114.0));
  CHECK(correct_to_reference(kMeasured, correction)(2) == Approx(0.42));
}

namespace {

TestedRoadLoad make_tested() {
  TestedRoadLoad tested;
  tested.measured = kMeasured;
  tested.correction = make_correction();
  tested.correction.wind_m_s = 2.0;
  return tested;
}

/// What one standard deviation of the accuracy of a sensor does.
Eigen::Vector3d change_by(const TestedRoadLoad& tested, const std::string& name) {
  for (const SensorContribution& one : list_sensor_contributions(tested)) {
    if (one.sensor.name == name) return one.change;
  }
  FAIL("no sensor " + name);
  return {};
}

}  // namespace

TEST_CASE("reference conditions: what sensors do to the coefficients", "[fast]") {
  TestedRoadLoad tested = make_tested();
  CHECK(list_sensor_contributions(tested).size() == 5);
  const double root3 = std::sqrt(3.0);
  CHECK(change_by(tested, "air temperature")(0) == Approx(0.0086 * (120.0 - 0.42 * 4.0) / root3));
  CHECK(change_by(tested, "air pressure")(0) == Approx(0.0));
  CHECK(change_by(tested, "air pressure")(2) == Approx(-0.42 * 0.003 / root3).epsilon(0.01));
  CHECK(change_by(tested, "wind speed")(0) == Approx(-0.42 * 2.0 * 2.0 * 0.3 / root3));
  CHECK(change_by(tested, "mass")(1) == Approx(1.8 * 10.0 / 1800.0 / root3));
  CHECK(change_by(tested, "mass")(0) == Approx((120.0 - 0.42 * 4.0) * 10.0 / 1800.0 / root3).epsilon(1e-3));
  // the force at the mass to which it is corrected does not depend on the scale
  tested.has_mass_correction = true;
  CHECK(change_by(tested, "mass")(0) == Approx(-0.42 * 4.0 * 10.0 / 1800.0 / root3).epsilon(0.02));
  tested.in_proportion_to_mass = false;
  CHECK(change_by(tested, "mass")(1) == Approx(0.0));
}

TEST_CASE("reference conditions: a speed that reads high moves the curve along, whatever the coefficients", "[fast]") {
  TestedRoadLoad tested;
  tested.measured = kMeasured;
  tested.correction = make_correction();
  const double e = 0.2 / 3.6;
  const Eigen::Vector3d moved = kMeasured + std::sqrt(3.0) * change_by(tested, "vehicle speed");
  for (const double v : {5.0, 20.0, 35.0}) {  // half the difference of the curves read e too low and e too high
    const auto force_N = [](double u) { return kMeasured(0) + u * (kMeasured(1) + u * kMeasured(2)); };
    const double change_N = 0.5 * (force_N(v - e) - force_N(v + e));
    CHECK((moved - kMeasured).dot(Eigen::Vector3d(1.0, v, v * v)) == Approx(change_N));
  }
}

TEST_CASE("reference conditions: a torque meter adds to the force by the radius, which speed and turns decide",
          "[fast]") {
  TestedRoadLoad tested = make_tested();
  tested.in_proportion_to_mass = false;
  tested.force_per_unit = 1.02 / 0.33;
  tested.most_torque_Nm = 400.0;
  const double root3 = std::sqrt(3.0);
  CHECK(change_by(tested, "wheel torque")(0) == Approx(6.0 * 1.02 / 0.33 / root3));
  CHECK(change_by(tested, "wheel torque")(2) == Approx(0.0));
  tested.most_torque_Nm = 2000.0;  // 0.5 % of it is more than 6 Nm
  CHECK(change_by(tested, "wheel torque")(0) == Approx(10.0 * 1.02 / 0.33 / root3));
  const double without = change_by(tested, "vehicle speed")(2);
  CHECK(without == Approx(0.0).margin(1e-12));
  tested.wheel_speed_Hz = 10.5;  // a wheel that is read to turn faster is smaller, so that the force is larger
  tested.radius_speed_m_s = 80.0 / 3.6;
  CHECK(change_by(tested, "wheel speed")(2) == Approx(0.42 * 1.02 / 0.33 * 0.05 / 10.5 / root3));
  CHECK(change_by(tested, "vehicle speed")(2) == Approx(-0.42 * 1.02 / 0.33 * 0.2 / 80.0 / root3).epsilon(1e-4));
  tested.radius_speed_m_s = 40.0 / 3.6;  // found at half the speed, the same error weighs twice
  CHECK(change_by(tested, "vehicle speed")(2) == Approx(-0.42 * 1.02 / 0.33 * 0.2 / 40.0 / root3).epsilon(1e-4));
}
