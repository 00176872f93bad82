// Factors between conditions of a test: tire diameter (2.1), pressure (3.4), air (ISO 28580).
#include <catch2/catch.hpp>

#include "models/tire/conversion_laws.h"

using namespace rollrig;
using models::calc_ambient_correction;
using models::calc_pressure_factor;
using models::calc_tire_diameter_factor;

TEST_CASE("a tire eight times as large loses half (2.1), and a larger one always less", "[fast]") {
  CHECK(calc_tire_diameter_factor(0.1, 0.8, models::kDiameterExponent) == Approx(0.5));
  CHECK(calc_tire_diameter_factor(0.6, 0.7, models::kDiameterExponent) < 1.0);
  CHECK(calc_tire_diameter_factor(0.6, 0.7, 0.62) < calc_tire_diameter_factor(0.6, 0.7, 1.0 / 3.0));
  CHECK(calc_tire_diameter_factor(0.7, 0.7, 0.4) == 1.0);
  CHECK(calc_tire_diameter_factor(0.6, 0.7, 0.4) * calc_tire_diameter_factor(0.7, 0.6, 0.4) == Approx(1.0));
}

TEST_CASE("250 kPa over 280 kPa is 1.0463 with the source's exponent", "[fast]") {
  // the source beside (4.1)
  CHECK(calc_pressure_factor(250e3, 280e3, models::kPressureExponent) == Approx(1.0463).margin(6e-4));
  CHECK(calc_pressure_factor(300e3, 280e3, 0.4) < 1.0);
  CHECK(calc_pressure_factor(300e3, 280e3, 0.0) == 1.0);
}

TEST_CASE("the standard's correction: none at 25 degC, 0.8 % a degree, cold air lowers what 25 degC would give",
          "[fast]") {
  CHECK(calc_ambient_correction(298.15) == 1.0);
  CHECK(calc_ambient_correction(299.15) == Approx(1.008));
  CHECK(calc_ambient_correction(293.15) == Approx(0.96));
  CHECK(calc_ambient_correction(293.15, 0.006) == Approx(0.97));
  CHECK(models::is_ambient_correction_valid(293.15));
  CHECK(models::is_ambient_correction_valid(303.15));
  CHECK_FALSE(models::is_ambient_correction_valid(292.65));
  CHECK_FALSE(models::is_ambient_correction_valid(303.65));
}
