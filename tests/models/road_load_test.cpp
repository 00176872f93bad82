#include "models/vehicle/road_load.h"

#include <catch2/catch.hpp>

#include "models/tire/tire.h"

using namespace rollrig;
using models::RoadLoad;

TEST_CASE("road load at standstill and by hand at 100 km/h", "[fast]") {
  // 120 N, 0.5 N/(km/h), 0.03 N/(km/h)^2: at 100 km/h 120 + 50 + 300 = 470 N
  const RoadLoad<double> load{120.0, unit_of_key("B_N_per_km_h").to_si(0.5), unit_of_key("C_N_per_km_h2").to_si(0.03)};
  CHECK(models::calc_road_load_N(load, 0.0) == 120.0);
  CHECK(models::calc_road_load_N(load, 100.0 / 3.6) == Approx(470.0).epsilon(1e-12));
}

TEST_CASE("the keys of a road load carry the dimensions of its equation", "[fast]") {
  const RoadLoad<DimensionedScalar> load = models::convert<DimensionedScalar>(RoadLoad<double>{120.0, 1.8, 0.39});
  const DimensionedScalar force = models::calc_road_load_N(load, quantity<DimensionedScalar>(20.0, dimension::kSpeed));
  CHECK(force.dimension() == dimension::kForce);
}
