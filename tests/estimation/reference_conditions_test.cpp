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

TEST_CASE("reference conditions: what sensors do to the coefficients", "[fast]") {
  ReferenceCorrection correction = make_correction();
  correction.wind_m_s = 2.0;
  const auto list = list_sensor_contributions(kMeasured, correction, true);
  REQUIRE(list.size() == 4);
  const double root3 = std::sqrt(3.0);
  CHECK(list[0].change(0) == Approx(0.0086 * (120.0 - 0.42 * 4.0) / root3));
  CHECK(list[1].change(0) == Approx(0.0));
  CHECK(list[1].change(2) == Approx(-0.42 * 0.003 / root3).epsilon(0.01));
  CHECK(list[2].change(0) == Approx(-0.42 * (2.3 * 2.3 - 4.0) / root3));
  CHECK(list[3].change(1) == Approx(1.8 * 10.0 / 1800.0 / root3));
  // the force at the mass to which it is corrected does not depend on the scale
  CHECK(list[3].change(0) == Approx(-0.42 * 4.0 * 10.0 / 1800.0 / root3).epsilon(0.02));
  CHECK(list_sensor_contributions(kMeasured, correction, false)[3].change(1) == Approx(0.0));
}
