// A loss carried between conditions: published number, round trips, independence of the way.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/loss_conversion.h"
#include "sim/core/error.h"

using namespace rollrig;
using estimation::convert_loss;

namespace {

double factor(const LossConditions& from, const LossConditions& to) { return convert_loss(from, to).force_factor; }

/// Drums and tires in m, kPa, degC, N.
LossConditions make(double drum_m, double tire_m, double pressure_kPa, double ambient_degC, double load_N) {
  return {drum_m == 0.0 ? 0.0 : 2.0 / drum_m, tire_m, 1e3 * pressure_kPa, ambient_degC + 273.15, load_N};
}

}  // namespace

TEST_CASE("a50 from the 2 m drum to 1.2 m gains 8.45 %, as the source applies it", "[fast]") {
  LossConditions from, to;
  from.drum_curvature_per_m = 1.0;
  from.tire_diameter_m = 0.7176;
  to.drum_curvature_per_m = 1.0 / 0.6;
  const auto conversion = convert_loss(from, to);
  CHECK(conversion.force_factor == Approx(1.0845).margin(5e-5));
  REQUIRE(conversion.factors.size() == 1);
  CHECK(conversion.factors[0].equation == "(3.1)");
}

TEST_CASE("there and back is one, whatever changes, and a way over a third place is the straight way", "[fast]") {
  const LossConditions a = make(2.0, 0.7176, 250, 25, 5400);
  const LossConditions b = make(1.2, 0.63, 280, 21, 4800);
  const LossConditions flat = make(0.0, 0.68, 230, 29, 6000);
  CHECK(factor(a, b) * factor(b, a) == Approx(1.0).epsilon(1e-12));
  CHECK(factor(a, flat) * factor(flat, b) == Approx(factor(a, b)).epsilon(1e-12));
  CHECK(factor(a, a) == 1.0);
  CHECK(convert_loss(a, a).factors.empty());
}

TEST_CASE("the product is that of the lines, each of the sign that physics asks for", "[fast]") {
  const auto conversion = convert_loss(make(2.0, 0.7, 250, 25, 5000), make(1.2, 0.6, 280, 22, 5500));
  double product = 1.0;
  for (const auto& line : conversion.factors) {
    product *= line.factor;
    if (line.name.rfind("pressure", 0) == 0) CHECK(line.factor < 1.0);
    if (line.name.rfind("tire diameter", 0) == 0) CHECK(line.factor > 1.0);
    if (line.name.rfind("air", 0) == 0) CHECK(line.factor > 1.0);  // colder air, more loss
    if (line.name.rfind("load", 0) == 0) CHECK(line.factor == Approx(1.1));
  }
  CHECK(conversion.factors.size() == 6);  // to the road, the tire, to the drum, pressure, air, load
  CHECK(product == Approx(conversion.force_factor));
}

TEST_CASE("what is given on one side alone is not converted", "[fast]") {
  LossConditions from = make(2.0, 0.7, 250, 25, 5000), to;
  CHECK(convert_loss(from, to).factors.empty());
}

TEST_CASE("outside the standard's temperatures, and outside the usual exponents, a warning is given", "[fast]") {
  LossConditions from, to;
  from.ambient_K = 288.15;
  to.ambient_K = 298.15;
  const ConversionFactors cold = convert_loss(from, to);
  CHECK(cold.warnings.size() == 1);
  REQUIRE(cold.factors.size() == 1);
  CHECK(cold.factors[0].from == "15 degC");
  CHECK(cold.factors[0].to == "25 degC");
  from.ambient_K = 293.15;
  CHECK(convert_loss(from, to).warnings.empty());
  LossConditions soft, hard;
  soft.pressure_Pa = 200e3;
  hard.pressure_Pa = 250e3;
  CHECK(convert_loss(soft, hard, {0.6}).warnings.size() == 1);
}

TEST_CASE("for 8.3 % of diameter a tire loses 2.6 % less by (2.1), 4.8 % by another study, which a warning tells",
          "[fast]") {
  LossConditions small, large;
  small.tire_diameter_m = 0.6;
  large.tire_diameter_m = 1.083 * 0.6;
  const ConversionFactors usual = convert_loss(small, large);
  CHECK(usual.force_factor == Approx(1.0 - 0.026).margin(5e-4));
  REQUIRE(usual.warnings.size() == 1);
  CHECK_THAT(usual.warnings[0], Catch::Contains("0.951"));
  estimation::ConversionLaws laws;
  laws.diameter_exponent = 0.62;
  CHECK(convert_loss(small, large, laws).force_factor == Approx(1.0 - 0.048).margin(5e-4));
  CHECK(convert_loss(small, large, laws).warnings.empty());  // the user has chosen
}

TEST_CASE("a loss in air of 30 degC is 4, 5 or 3 % more at 25 degC, by the coefficients of the classes", "[fast]") {
  LossConditions warm, reference;
  warm.ambient_K = 303.15;
  reference.ambient_K = 298.15;
  estimation::ConversionLaws laws;
  CHECK(convert_loss(warm, reference).force_factor == Approx(1.04));
  laws.ambient_coefficient_per_K = 0.010;
  CHECK(convert_loss(warm, reference, laws).force_factor == Approx(1.05));
  laws.ambient_coefficient_per_K = 0.006;
  CHECK(convert_loss(warm, reference, laws).force_factor == Approx(1.03));
}

TEST_CASE("a drum without the tire's diameter cannot be converted", "[fast]") {
  LossConditions from, to;
  from.drum_curvature_per_m = 1.0;
  to.drum_curvature_per_m = 0.0;
  CHECK_THROWS_AS(convert_loss(from, to), InputError);
}
