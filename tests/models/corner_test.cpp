#include "models/corner.h"

#include <catch2/catch.hpp>

#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::Corner;
using models::Instant;
using models::Node;

namespace {

/// A corner in steady rolling, evaluated once.
template <class S>
Instant<S> evaluate(const Corner<S>& corner, std::vector<S> x, double speed, double load, std::vector<S>& rates,
                    double surface_K = 300.0) {
  const auto q = [](double value, Dimension d) { return quantity<S>(value, d); };
  Instant<S> now;
  now.inflation = {q(280e3, dimension::kPressure), q(298.15, dimension::kTemperature), q(101325, dimension::kPressure)};
  now.recorded = {q(speed, dimension::kSpeed),
                  q(0.1, dimension::kAcceleration),
                  q(load, dimension::kForce),
                  q(298.15, dimension::kTemperature),
                  q(surface_K, dimension::kTemperature),
                  true,
                  q(0.0, dimension::kForce),
                  q(0.0, dimension::kForce),
                  S(0.0),
                  q(0.0, dimension::kSpeed),
                  S(1.0)};
  corner.apply_inputs(x.data(), now);
  now.motion = {now.acting.speed_m_s,       now.acting.acceleration_m_s2, now.acting.load_N,
                q(30.0, dimension::kForce), q(1.0, dimension::kPower),    now.acting.speed_m_s};
  corner.calc_losses(x.data(), now);
  rates.resize(corner.state_count());
  corner.calc_rates(x.data(), now, rates.data());
  return now;
}

std::vector<double> states_at(const Corner<double>& corner, double temperature_K) {
  std::vector<double> x(corner.state_count());
  corner.initialize(temperature_K, {}, x.data());
  return x;
}

}  // namespace

TEST_CASE("a tire at rest at ambient temperature stays as it is", "[fast]") {
  const Corner<double> corner = tests::DrumFixture().corner();
  std::vector<double> rates;
  auto x = states_at(corner, 298.15);
  Instant<double> now = evaluate(corner, x, 0.0, 5400.0, rates);
  CHECK(now.rolling_resistance_N == 0.0);
  CHECK(now.parasitic_N == 0.0);
  CHECK(rates[corner.state_of(Node::kGas)] == 0.0);
}

TEST_CASE("all of the loss heats the rubber", "[fast]") {
  const Corner<double> corner = tests::DrumFixture().corner();
  std::vector<double> rates;
  const Instant<double> now = evaluate(corner, states_at(corner, 298.15), 22.0, 5400.0, rates);
  CHECK(now.heat.heat_in_W == Approx(now.rolling_resistance_N * 22.0));
  CHECK(now.rolling_resistance_N > 0.0);
}

TEST_CASE("skim load leaves its share of the loss", "[fast]") {
  // F_rr goes with the load: at 200 N 200/5400 of the loss is left
  const Corner<double> corner = tests::DrumFixture().corner();
  std::vector<double> rates;
  const auto x = states_at(corner, 310.0);
  const double loaded_N = evaluate(corner, x, 22.0, 5400.0, rates).rolling_resistance_N;
  CHECK(evaluate(corner, x, 22.0, 200.0, rates).rolling_resistance_N == Approx(loaded_N * 200.0 / 5400.0));
}

TEST_CASE("the road's share of z acts on the surface's temperature", "[fast]") {
  tests::DrumFixture fixture;
  fixture.tire.rig_thermal.clear();
  fixture.tire.values.thermal.rest_conductance_W_per_K = 12.0;
  fixture.tire.values.thermal.road_share_of_rest_conductance = 0.25;
  const Corner<double> corner = fixture.corner();
  std::vector<double> rates;
  const Instant<double> now = evaluate(corner, states_at(corner, 310.0), 0.0, 5400.0, rates);
  CHECK(now.heat.to_road_W == Approx(0.25 * 12.0 * (310.0 - 300.0)));  // the recorded surface is at 300 K
  CHECK(now.heat.to_air_W == Approx(0.75 * 12.0 * (310.0 - 298.15)));
}

TEST_CASE("how air and road share the cooling matters only where their temperatures differ", "[fast]") {
  tests::DrumFixture fixture;
  fixture.tire.rig_thermal.clear();
  models::TireThermalParameters<double>& thermal = fixture.tire.values.thermal;
  thermal.rest_conductance_W_per_K = 12.0;
  thermal.speed_conductance_W_s_per_m_K = 1.5;
  thermal.road_share_of_rest_conductance = 0.25;
  constexpr double kSpeed_m_s = 20.0;
  constexpr double kTire_K = 310.0;
  const auto cool = [&](double share, double surface_K) {
    thermal.road_share_of_speed_conductance = share;
    const Corner<double> corner = fixture.corner();
    std::vector<double> rates;
    return evaluate(corner, states_at(corner, kTire_K), kSpeed_m_s, 5400.0, rates, surface_K).heat;
  };
  const auto none = cool(0.0, 298.15);
  const auto most = cool(0.9, 298.15);
  CHECK(most.to_air_W + most.to_road_W == Approx(none.to_air_W + none.to_road_W));
  CHECK(most.to_road_W > none.to_road_W);
  const auto hot = cool(0.9, kTire_K);  // a surface as hot as the tire takes nothing
  CHECK(hot.to_road_W == Approx(0.0).margin(1e-9));
  CHECK(hot.to_air_W == Approx(most.to_air_W));
}

TEST_CASE("a constant coefficient takes neither speed nor temperature nor pressure", "[fast]") {
  tests::DrumFixture fixture;
  fixture.baseline = models::Baseline::kConstantRrc;
  fixture.tire.has_constant = true;
  fixture.tire.values.constant.rrc = 0.008;
  const Corner<double> corner = fixture.corner();
  std::vector<double> rates;
  CHECK(evaluate(corner, states_at(corner, 298.15), 10.0, 5000.0, rates).rolling_resistance_N == Approx(40.0));
  CHECK(evaluate(corner, states_at(corner, 330.0), 30.0, 5000.0, rates).rolling_resistance_N == Approx(40.0));
}

TEST_CASE("dimensions are right through every port, with every effect on, on every kind of rig and tire model",
          "[fast]") {
  using Q = DimensionedScalar;
  std::vector<models::ActiveEffect> all;
  for (const std::string& id : models::effect_ids()) all.push_back(tests::switch_on(id));
  models::InitialPort<Q> initial;
  initial.soaked = GENERATE(true, false);
  initial.rest_before_s = Q(3600.0, dimension::kTime);
  const auto kind = GENERATE(from_range(rigs::machine_kinds()));
  models::Context<double> context = tests::make_context_on(kind);
  context.tire.own = tests::make_own(GENERATE("combined", "constant_rrc", "two_node"));
  tests::HandFedCorner<Q> at(context, all, initial, 310.0);
  at.inputs.speed_m_s = 36.0;  // where everything acts that acts at some speeds only
  at.inputs.acceleration_m_s2 = 0.1;
  at.inputs.surface_recorded = GENERATE(true, false);
  at.inputs.drive_force_N = -900.0;
  at.inputs.brake_force_N = 700.0;
  at.inputs.slip_power_W = 30.0;
  const Instant<Q>& now = at.evaluate();
  CHECK(now.rolling_resistance_N.dimension() == dimension::kForce);
  CHECK(now.parasitic_N.dimension() == dimension::kForce);
  CHECK(now.heat.heat_in_W.dimension() == dimension::kPower);
  CHECK(now.pressure_Pa.dimension() == dimension::kPressure);
  CHECK(at.corner.calc_stored_heat_J(at.x.data()).dimension() == dimension::kPower * dimension::kTime);
  for (std::size_t i = 0; i < at.rates.size(); ++i) {
    INFO(at.corner.states()[i].quantity.header());
    CHECK(at.rates[i].dimension() == at.x[i].dimension() / dimension::kTime);
  }
}

TEST_CASE("a node colder, hotter or less than a number is no tire's, whichever it is", "[fast]") {
  const Corner<double> corner = tests::DrumFixture().corner();
  const auto fine = states_at(corner, 298.15);
  CHECK_NOTHROW(corner.require_possible(fine.data()));
  for (const auto& [node, name] : {std::pair{Node::kLiner, "rubber"}, std::pair{Node::kGas, "gas"}}) {
    for (const double temperature_K : {50.0, 2000.0, -1e9, std::nan("")}) {
      auto x = fine;
      x[corner.state_of(node)] = temperature_K;
      CHECK_THROWS_WITH(corner.require_possible(x.data()), Catch::Contains(name));
    }
  }
}
