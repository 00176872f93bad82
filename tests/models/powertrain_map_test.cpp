// The map of a powertrain: between its points, at its edges, and in both directions of the energy.
#include "models/vehicle/powertrain_map.h"

#include <catch2/catch.hpp>

using namespace rollrig;
using models::calc_battery_W;
using models::calc_map_efficiency;

namespace {

/// A map whose efficiencies are a given function at its points.
template <class Function>
models::PowertrainMap make_map(Function&& efficiency) {
  models::PowertrainMap map{{0.0, 7.0, 30.0}, {-40e3, -3e3, 5e3, 90e3}, {}};
  for (const double v : map.speeds_m_s) {
    map.efficiency.emplace_back();
    for (const double P : map.powers_W) map.efficiency.back().push_back(efficiency(v, P));
  }
  return map;
}

/// Of speed and power, each linear, and their product: bilinear interpolation has no error.
double bilinear(double v, double P) { return 0.6 + 0.004 * v + 1e-6 * P + 2e-8 * v * P; }

}  // namespace

TEST_CASE("between its points a map is what is bilinear there", "[fast]") {
  const models::PowertrainMap map = make_map(bilinear);
  for (const double v : {0.0, 3.0, 7.0, 19.0, 30.0}) {
    for (const double P : {-40e3, -21e3, -1e3, 0.0, 5e3, 60e3, 90e3}) {
      INFO(v << " m/s, " << P << " W");
      CHECK(calc_map_efficiency(map, v, P) == Approx(bilinear(v, P)).epsilon(1e-12));
    }
  }
}

TEST_CASE("beyond a map its nearest edge counts", "[fast]") {
  const models::PowertrainMap map = make_map(bilinear);
  CHECK(calc_map_efficiency(map, 45.0, 20e3) == Approx(bilinear(30.0, 20e3)));
  CHECK(calc_map_efficiency(map, -1.0, 20e3) == Approx(bilinear(0.0, 20e3)));
  CHECK(calc_map_efficiency(map, 12.0, 300e3) == Approx(bilinear(12.0, 90e3)));
  CHECK(calc_map_efficiency(map, 12.0, -300e3) == Approx(bilinear(12.0, -40e3)));
}

TEST_CASE("a battery gives more than the hubs, and takes in less than they do", "[fast]") {
  const models::PowertrainMap map = make_map([](double v, double P) { return P < 0.0 ? 0.7 : 0.8 + 0.001 * v; });
  for (const double v : {1.0, 12.0, 29.0}) {
    for (const double P : {6e3, 30e3}) CHECK(calc_battery_W(map, v, P) > P);
    for (const double P : {-35e3, -4e3}) {
      CHECK(calc_battery_W(map, v, P) < 0.0);
      CHECK(calc_battery_W(map, v, P) > P);
    }
    CHECK(calc_battery_W(map, v, 0.0) == 0.0);
  }
  // Out and back: the losses of both ways.
  CHECK(calc_battery_W(map, 0.0, 6e3) * 0.8 == Approx(6e3));
  CHECK(calc_battery_W(map, 0.0, -4e3) == Approx(-0.7 * 4e3));
}

TEST_CASE("the derivative of the battery's power is the slope of its differences", "[fast]") {
  const models::PowertrainMap map = make_map(bilinear);
  for (const double P : {-20e3, 4e3, 50e3, 120e3}) {  // the last one beyond the map
    INFO(P << " W");
    const double v = 13.0;
    const double step_W = 1.0;
    Jet power(P, 0);
    const Jet battery = calc_battery_W(map, Jet(v), power);
    const double slope = (calc_battery_W(map, v, P + step_W) - calc_battery_W(map, v, P - step_W)) / (2.0 * step_W);
    CHECK(battery.v[0] == Approx(slope).epsilon(1e-6));
  }
}
