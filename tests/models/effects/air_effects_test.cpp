// Effects of the air around the tire and of the gas in it: windage, warm air, convection, volume, heat to the gas.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::ActiveEffect;
using models::Node;
using tests::HandFedCorner;
using tests::make_context_on;
using tests::switch_on;

namespace {

HandFedCorner<double> corner_with(const ActiveEffect& effect, double speed_m_s, double load_N = 5400.0,
                                  tests::Machine kind = tests::kDrum) {
  HandFedCorner<double> at(make_context_on(kind), {effect});
  at.inputs.speed_m_s = speed_m_s;
  at.inputs.load_N = load_N;
  at.evaluate();
  return at;
}

/// What windage adds to the loss.
double find_windage_N(double speed_m_s, double load_N, double power = 2.0) {
  HandFedCorner<double> without(make_context_on(tests::kDrum), {});
  without.inputs.speed_m_s = speed_m_s;
  without.inputs.load_N = load_N;
  const auto with = corner_with(switch_on("windage", {1.5, power}), speed_m_s, load_N);
  return with.now.rolling_resistance_N - without.evaluate().rolling_resistance_N;
}

double find_air_speed_m_s(double deficit, double speed_m_s, double other_m_s = 1e-1, double fan_share = 0.0) {
  return corner_with(switch_on("convection_law", {deficit, 20.0, other_m_s, fan_share}), speed_m_s)
      .now.boundary.air_speed_m_s;
}

HandFedCorner<double> start_under(const ActiveEffect& effect, double load_N) {
  models::InitialPort<double> initial;
  initial.load_N = load_N;
  HandFedCorner<double> at(make_context_on(tests::kDrum), {effect}, initial);
  at.inputs.load_N = load_N;
  at.inputs.speed_m_s = 0.0;
  at.evaluate();
  return at;
}

/// Once the gas has come to terms with it.
double find_volume_ratio(const ActiveEffect& effect, double speed_m_s, double load_N) {
  auto at = corner_with(effect, speed_m_s, load_N);
  at.advance(1800.0);
  return at.now.gas.volume_ratio;
}

}  // namespace

TEST_CASE("windage goes with the power of the speed and not with the load, and a lifted tire has none", "[fast]") {
  const double v80 = 80.0 / 3.6;
  CHECK(find_windage_N(v80, 5400.0) == Approx(1.5));
  CHECK(find_windage_N(v80, 200.0) == Approx(1.5));  // in skim too
  CHECK(find_windage_N(v80, 0.0) == 0.0);
  CHECK(find_windage_N(1.5 * v80, 5400.0) == Approx(2.25 * 1.5));
  CHECK(find_windage_N(0.5 * v80, 5400.0, 1.8) / find_windage_N(0.5 * v80, 5400.0, 2.2) == Approx(std::pow(2.0, 0.4)));
  CHECK(find_windage_N(0.0, 5400.0) == 0.0);
}

TEST_CASE("of windage nothing heats the rubber", "[fast]") {
  auto with = corner_with(switch_on("windage", {3.0}), 30.0);
  HandFedCorner<double> without(make_context_on(tests::kDrum), {});
  without.inputs.speed_m_s = 30.0;
  CHECK(with.now.heat.heat_in_W == without.evaluate().heat.heat_in_W);
  with.advance(1800.0);
  without.advance(1800.0);
  CHECK(with.temperature_K(Node::kLiner) == without.temperature_K(Node::kLiner));
}

TEST_CASE("the air in the cell warms by its rise with its time constant, and the tire with it", "[fast]") {
  auto at = corner_with(switch_on("cell_air_warming", {4.0, 30.0, 0.5, 0.0}), 80.0 / 3.6);
  CHECK(at.now.acting.ambient_K == 298.15);
  at.advance(1800.0);
  CHECK(at.now.acting.ambient_K - 298.15 == Approx(4.0 * (1.0 - std::exp(-1.0))).epsilon(1e-6));
  at.advance(12.0 * 3600.0, 20000);
  CHECK(at.now.acting.ambient_K - 298.15 == Approx(4.0));
  // in the end it is a tire in a warmer cell
  HandFedCorner<double> warm(make_context_on(tests::kDrum), {});
  warm.inputs.ambient_K = 302.15;
  warm.inputs.speed_m_s = 80.0 / 3.6;
  warm.advance(12.0 * 3600.0, 20000);
  CHECK(at.temperature_K(Node::kLiner) == Approx(warm.temperature_K(Node::kLiner)).margin(1e-4));
  CHECK(at.now.rolling_resistance_N == Approx(warm.now.rolling_resistance_N).epsilon(1e-5));
}

TEST_CASE("air that the tire warms warms with its load, air that the machine warms does not", "[fast]") {
  const auto rise_dK = [](double tire_share, double load_ratio) {
    auto at = corner_with(switch_on("cell_air_warming", {4.0, 30.0, 0.5, tire_share}), 80.0 / 3.6);
    at.inputs.load_N = load_ratio * at.now.context->tire.rolling_resistance.reference_load_N;
    at.advance(24.0 * 3600.0, 20000);
    return at.now.acting.ambient_K - 298.15;
  };
  for (const double share : {0.0, 0.4, 1.0}) CHECK(rise_dK(share, 1.0) == Approx(4.0));
  CHECK(rise_dK(1.0, 0.0) == Approx(0.0).margin(1e-9));
  CHECK(rise_dK(0.0, 0.0) == Approx(4.0));
  CHECK(rise_dK(0.4, 0.5) == Approx(4.0 * 0.8));
}

TEST_CASE("warm air cools down at rest, and warms the surface only where that is not recorded", "[fast]") {
  const auto effect = switch_on("cell_air_warming", {4.0, 30.0, 0.5, 0.0});
  auto at = corner_with(effect, 0.0);
  at.state("cell_air_warming.air_rise_dK") = 3.0;
  at.evaluate();
  CHECK(at.now.boundary.surface_K == Approx(301.15));
  at.inputs.surface_recorded = true;
  at.inputs.surface_K = 299.0;
  at.evaluate();
  CHECK(at.now.boundary.surface_K == 299.0);
  at.advance(1800.0);
  CHECK(at.now.acting.ambient_K - 298.15 == Approx(3.0 * std::exp(-1.0)).epsilon(1e-6));
}

TEST_CASE("after a rest the cell's air is as warm as it left off, less what the rest took, and on a road it is outside",
          "[fast]") {
  const auto effect = switch_on("cell_air_warming", {4.0, 30.0, 0.5, 0.0});
  models::InitialPort<double> initial;
  initial.soaked = false;
  initial.rest_before_s = 3600.0;
  HandFedCorner<double> at(make_context_on(tests::kDyno), {effect}, initial);
  CHECK(at.evaluate().acting.ambient_K - 298.15 == Approx(4.0 * std::exp(-2.0)));
  HandFedCorner<double> road(make_context_on(tests::kRoad), {effect}, initial);
  CHECK(road.evaluate().acting.ambient_K == 298.15);
}

TEST_CASE("the air's speed is a power of the surface's, equal to it at the reference speed", "[fast]") {
  for (const double deficit : {0.1, 0.4}) {
    CHECK(find_air_speed_m_s(deficit, 20.0) == Approx(20.0).epsilon(1e-4));
    const double ratio = find_air_speed_m_s(deficit, 30.0) / find_air_speed_m_s(deficit, 15.0);
    CHECK(std::log(ratio) / std::log(2.0) == Approx(1.0 - deficit).epsilon(1e-4));
    CHECK(find_air_speed_m_s(deficit, 10.0) > 10.0);
    CHECK(find_air_speed_m_s(deficit, 35.0) < 35.0);
  }
  CHECK(find_air_speed_m_s(0.0, 35.0) == 35.0);
  CHECK(find_air_speed_m_s(0.0, 0.0) == 0.0);
}

TEST_CASE("without any power it is a fan, which blows at standstill too", "[fast]") {
  for (const double speed_m_s : {5.0, 20.0, 35.0}) {
    CHECK(find_air_speed_m_s(1.0, speed_m_s) == Approx(20.0).epsilon(1e-3));
  }
  CHECK(find_air_speed_m_s(1.0, 0.0) == Approx(20.0).epsilon(1e-2));
  auto fan = corner_with(switch_on("convection_law", {1.0, 20.0, 0.1, 0.0}), 0.0);
  HandFedCorner<double> still(make_context_on(tests::kDrum), {});
  still.inputs.speed_m_s = 0.0;
  for (auto* at : {&fan, &still}) {
    at->temperature_K(Node::kLiner) = 330.0;
    at->advance(600.0);
  }
  CHECK(fan.temperature_K(Node::kLiner) < still.temperature_K(Node::kLiner) - 1.0);
}

TEST_CASE("a fan across the tire adds by squares: at the reference speed as before, all of it left at standstill",
          "[fast]") {
  for (const double deficit : {0.1, 0.4}) {
    CHECK(find_air_speed_m_s(deficit, 20.0, 0.05, 1.0) == Approx(20.0).epsilon(1e-4));
    CHECK(find_air_speed_m_s(deficit, 0.0, 0.05, 1.0) == Approx(20.0 * std::sqrt(deficit)).epsilon(0.02));
    const double h = 1e-3;
    const double rise =
        find_air_speed_m_s(deficit, 20.0 + h, 0.05, 1.0) - find_air_speed_m_s(deficit, 20.0 - h, 0.05, 1.0);
    CHECK(rise / (2.0 * h) == Approx(1.0 - deficit).epsilon(1e-3));  // the exponent there
    // half of the deficit by a fan, half by the power: the exponents multiply
    const double both =
        find_air_speed_m_s(deficit, 20.0 + h, 0.05, 0.5) - find_air_speed_m_s(deficit, 20.0 - h, 0.05, 0.5);
    CHECK(both / (2.0 * h) == Approx((1.0 - 0.5 * deficit) * (1.0 - 0.5 * deficit)).epsilon(1e-3));
  }
  CHECK(find_air_speed_m_s(0.0, 35.0, 0.5, 1.0) == 35.0);
}

TEST_CASE("the air never takes heat the wrong way, and its law has a finite derivative at standstill", "[fast]") {
  for (const double deficit : {-0.5, 0.2, 1.0}) {
    for (const double speed_m_s : {0.0, 0.1, 3.0, 60.0}) {
      for (const double fan_share : {0.0, 0.5, 1.0}) {
        CHECK(find_air_speed_m_s(deficit, speed_m_s, 5.0, fan_share) >= 0.0);
      }
    }
  }
  HandFedCorner<Jet> at(make_context_on(tests::kDrum), {switch_on("convection_law", {0.0, 20.0, 1.0, 0.0})});
  at.corner.effects()[0].parameters[0] = Jet(0.0, 0);
  at.inputs.speed_m_s = 0.0;
  const Jet air_m_s = at.evaluate().boundary.air_speed_m_s;
  const double h = 1e-5;
  CHECK(air_m_s.a == 0.0);
  CHECK(air_m_s.v[0] == Approx(find_air_speed_m_s(h, 0.0, 1.0) / h).epsilon(1e-3));
}

TEST_CASE("the cavity shrinks under load by its size, grows with the square of the speed, and is as set at setting",
          "[fast]") {
  const auto on_lifted = switch_on("cavity_volume", {1.0, 1.0, 0.0, 0.0});
  CHECK(find_volume_ratio(on_lifted, 20.0, 0.0) == 1.0);
  CHECK(start_under(on_lifted, 5400.0).now.gas.volume_ratio == Approx(0.99));
  CHECK(find_volume_ratio(on_lifted, 20.0, 5400.0) == Approx(0.99));
  CHECK(find_volume_ratio(on_lifted, 20.0, 2700.0) == Approx(0.995));
  CHECK(find_volume_ratio(switch_on("cavity_volume", {1.0, 1.0, 0.0, 1.0}), 20.0, 5400.0) == Approx(1.0));
  const auto growing = switch_on("cavity_volume", {1.0, 1.0, 0.4, 0.0});
  const double grown = find_volume_ratio(growing, 20.0, 0.0) - 1.0;
  CHECK(find_volume_ratio(growing, 40.0, 0.0) - 1.0 == Approx(4.0 * grown));
  CHECK(find_volume_ratio(growing, 120.0 / 3.6, 0.0) == Approx(1.004));
  const auto bent = switch_on("cavity_volume", {1.0, 1.5, 0.0, 0.0});
  CHECK(find_volume_ratio(bent, 20.0, 5400.0) == Approx(0.99));
  CHECK(find_volume_ratio(bent, 20.0, 2700.0) > find_volume_ratio(on_lifted, 20.0, 2700.0));
}

TEST_CASE("absolute pressure times volume stays, and the loss follows the pressure", "[fast]") {
  const auto effect = switch_on("cavity_volume", {1.0, 1.0, 0.0, 0.0});
  auto at = start_under(effect, 5400.0);
  at.inputs.speed_m_s = 20.0;
  at.evaluate();
  constexpr double kAmbient_Pa = 101325.0;
  CHECK((at.now.pressure_Pa + kAmbient_Pa) * at.now.gas.volume_ratio == Approx(280e3 + kAmbient_Pa));
  HandFedCorner<double> without(make_context_on(tests::kDrum), {});
  without.inputs.speed_m_s = 20.0;
  CHECK(at.now.rolling_resistance_N / without.evaluate().rolling_resistance_N ==
        Approx(std::pow(at.now.pressure_Pa / 280e3, -0.4)));
}

TEST_CASE("a sudden load presses the gas without heat, which it gives up with its own time constant, C_gas/H",
          "[fast]") {
  auto at = start_under(switch_on("cavity_volume", {1.0, 1.0, 0.0, 0.0}), 0.0);
  constexpr double kAmbient_Pa = 101325.0;
  const auto absolute_Pa = [&] { return at.now.pressure_Pa + kAmbient_Pa; };
  const double unloaded_Pa = absolute_Pa();
  at.inputs.load_N = 5400.0;
  at.evaluate();
  CHECK(absolute_Pa() / unloaded_Pa == Approx(std::pow(0.99, -1.4)).epsilon(1e-4));
  const double sudden_Pa = absolute_Pa() - unloaded_Pa / 0.99;
  const auto& thermal = at.corner.context().tire.thermal;
  at.advance(thermal.gas_heat_capacity_J_per_K / thermal.H_gas_W_per_K);  // at rest, all of one temperature
  CHECK((absolute_Pa() - unloaded_Pa / 0.99) / sudden_Pa == Approx(std::exp(-1.0)).epsilon(2e-2));
  at.advance(1800.0);
  CHECK(absolute_Pa() == Approx(unloaded_Pa / 0.99).epsilon(1e-6));
}

TEST_CASE("the gas follows the tire with its own time constant, C_gas/(h H), stirred by speed where a part is",
          "[fast]") {
  for (const double ratio : {0.25, 1.0, 2.0}) {
    models::Context<double> context = make_context_on(tests::kDrum);
    context.tire.thermal.heat_capacity_J_per_K = 1e9;  // a tire that keeps its temperature
    HandFedCorner<double> at(context, {switch_on("gas_heat_transfer", {ratio, 0.0})});
    at.inputs.speed_m_s = 0.0;
    at.temperature_K(Node::kLiner) = 318.15;
    const auto& thermal = context.tire.thermal;
    at.advance(thermal.gas_heat_capacity_J_per_K / (ratio * thermal.H_gas_W_per_K));
    CHECK(318.15 - at.temperature_K(Node::kGas) == Approx(20.0 * std::exp(-1.0)).epsilon(1e-5));
    // Wholly stirred, nothing differs at standstill, and all of it at 80 km/h.
    for (const auto& [km_h, factor] : std::vector<std::pair<double, double>>{{0.0, 1.0}, {80.0, ratio}}) {
      HandFedCorner<double> stirred(context, {switch_on("gas_heat_transfer", {ratio, 1.0})});
      stirred.inputs.speed_m_s = km_h / 3.6;
      stirred.inputs.load_N = 0.0;
      stirred.temperature_K(Node::kLiner) = 318.15;
      stirred.advance(thermal.gas_heat_capacity_J_per_K / (factor * thermal.H_gas_W_per_K));
      CHECK(318.15 - stirred.temperature_K(Node::kGas) == Approx(20.0 * std::exp(-1.0)).epsilon(1e-4));
    }
    HandFedCorner<double> usual(make_context_on(tests::kDrum), {switch_on("gas_heat_transfer", {ratio, 0.4})});
    usual.temperature_K(Node::kLiner) = 318.15;
    const double stored_W = usual.stored_heat_rate_W();
    const auto& heat = usual.now.heat;
    CHECK(stored_W == Approx(heat.heat_in_W - heat.to_air_W - heat.to_road_W).margin(1e-3));
  }
}
