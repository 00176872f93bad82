#include "sim/core/dimension.h"

#include <catch2/catch.hpp>

#include "sim/core/scalar.h"

using namespace rollrig;
using Q = DimensionedScalar;

TEST_CASE("quantities multiply and divide with their dimensions", "[fast]") {
  const Q force(10.0, dimension::kForce);
  const Q speed(2.0, dimension::kSpeed);
  CHECK((force * speed).dimension() == dimension::kPower);
  CHECK((force * speed).value() == 20.0);
  CHECK((force / force).dimension().is_dimensionless());
}

TEST_CASE("a sum of different dimensions is refused", "[fast]") {
  const Q force(1.0, dimension::kForce);
  const Q speed(1.0, dimension::kSpeed);
  CHECK_THROWS_AS(force + speed, DimensionError);
  CHECK_THROWS_AS(force - Q(1.0), DimensionError);
  CHECK_THROWS_AS(force < speed, DimensionError);
  CHECK_THROWS_WITH(force + speed, Catch::Contains("kg m s^-2") && Catch::Contains("m s^-1"));
}

TEST_CASE("a default zero fits any dimension", "[fast]") {
  Q sum;
  sum += Q(3.0, dimension::kForce);
  CHECK(sum.dimension() == dimension::kForce);
  CHECK_THROWS_AS(sum + Q(1.0, dimension::kSpeed), DimensionError);
}

TEST_CASE("exp, log, tanh and pow take pure numbers only", "[fast]") {
  const Q temperature(300.0, dimension::kTemperature);
  CHECK_THROWS_AS(exp(temperature), DimensionError);
  CHECK_THROWS_AS(log(temperature), DimensionError);
  CHECK_THROWS_AS(tanh(temperature), DimensionError);
  CHECK_THROWS_AS(pow(temperature, Q(0.5)), DimensionError);
  CHECK(exp(temperature / temperature).value() == Approx(2.718281828459045));
}

TEST_CASE("sqrt halves the exponents, or refuses odd ones", "[fast]") {
  CHECK(sqrt(Q(9.0, {0, 2, -2, 0})).dimension() == dimension::kSpeed);
  CHECK_THROWS_AS(sqrt(Q(9.0, dimension::kSpeed)), DimensionError);
}
