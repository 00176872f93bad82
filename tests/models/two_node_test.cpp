// Tread and carcass as two nodes: limits in which they are the one node of the model combined, and where heat goes.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/parameters.h"
#include "models/quantities.h"
#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::Node;
namespace quantities = models::quantities;
using tests::HandFedCorner;
using tests::make_context_on;

namespace {

/// A two-node tire on a roller of 1.2 m; its own numbers by key, the others as of the other tests.
models::Context<double> make_two_node(const std::vector<std::pair<std::string, double>>& own = {}) {
  models::Context<double> context = make_context_on(tests::kDyno);
  context.tire.own = tests::make_own("two_node");
  for (const auto& [key, value] : own) estimation::find_parameter(context, "tire.two_node." + key) = value;
  return context;
}

/// Rolling on a road of 301 K at 23 m/s under 4900 N, in air of 296 K.
template <class S>
HandFedCorner<S> roll(const models::Context<double>& context, double duration_s, int steps) {
  HandFedCorner<S> at(context, {}, {}, 293.15);
  at.inputs.speed_m_s = 23.0;
  at.inputs.load_N = 4900.0;
  at.inputs.ambient_K = 296.0;
  at.inputs.surface_recorded = true;
  at.inputs.surface_K = 301.0;
  at.advance(duration_s, steps);
  return at;
}

constexpr double kLong_s = 40000.0;  // some fifty time constants

}  // namespace

TEST_CASE("two nodes that nothing parts are one node of both capacities, at every time", "[fast]") {
  for (const double duration_s : {60.0, 400.0, 2000.0}) {
    auto one = roll<double>(make_context_on(tests::kDyno), duration_s, 400);
    const auto distance_K = [&](double conductance_W_per_K) {
      const auto steps =
          static_cast<int>(duration_s * conductance_W_per_K / 3000.0) + 400;  // an eighth of the fastest time
      auto two = roll<double>(make_two_node({{"conductance_W_per_K", conductance_W_per_K}}), duration_s, steps);
      CHECK(two.now.rolling_resistance_N == Approx(one.now.rolling_resistance_N).epsilon(30.0 / conductance_W_per_K));
      CHECK(two.now.pressure_Pa == Approx(one.now.pressure_Pa).epsilon(10.0 / conductance_W_per_K));
      return std::abs(two.temperature_K(Node::kLiner) - one.temperature_K(Node::kLiner));
    };
    // What is left goes with 1/G.
    CHECK(distance_K(1e5) == Approx(0.1 * distance_K(1e4)).epsilon(0.02));
  }
}

TEST_CASE("a tire that heats in the tread alone is steady as one node is, whatever parts tread and carcass", "[fast]") {
  auto one = roll<double>(make_context_on(tests::kDyno), kLong_s, 8000);
  for (const double conductance_W_per_K : {15.0, 150.0}) {
    for (const double loss_share : {0.0, 0.4, 1.0}) {
      auto two = roll<double>(make_two_node({{"tread_share_of_heat", 1.0},
                                             {"tread_share_of_loss", loss_share},
                                             {"conductance_W_per_K", conductance_W_per_K}}),
                              kLong_s, 8000);
      CHECK(two.now.rolling_resistance_N == Approx(one.now.rolling_resistance_N).epsilon(1e-7));
      CHECK(two.temperature_K(Node::kTread) == Approx(one.temperature_K(Node::kLiner)).epsilon(1e-8));
      CHECK(two.temperature_K(Node::kLiner) == Approx(one.temperature_K(Node::kLiner)).epsilon(1e-8));
      CHECK(two.now.pressure_Pa == Approx(one.now.pressure_Pa).epsilon(1e-8));
    }
  }
}

TEST_CASE("a tire whose loss follows the tread loses as one node does when steady, over a warmer carcass", "[fast]") {
  models::Context<double> one_node = make_context_on(tests::kDyno);
  one_node.tire.rolling_resistance.pressure_exponent = 0.0;  // the warmer carcass makes the pressure another
  auto one = roll<double>(one_node, kLong_s, 8000);
  const double heat_share = 0.3;
  const double conductance_W_per_K = 45.0;
  models::Context<double> two_node = make_two_node({{"tread_share_of_heat", heat_share},
                                                    {"tread_share_of_loss", 1.0},
                                                    {"conductance_W_per_K", conductance_W_per_K}});
  two_node.tire.rolling_resistance.pressure_exponent = 0.0;
  auto two = roll<double>(two_node, kLong_s, 8000);
  CHECK(two.now.rolling_resistance_N == Approx(one.now.rolling_resistance_N).epsilon(1e-7));
  const double from_carcass_W = (1.0 - heat_share) * one.now.rolling_resistance_N * 23.0;
  CHECK(two.temperature_K(Node::kLiner) - two.temperature_K(Node::kTread) ==
        Approx(from_carcass_W / conductance_W_per_K).epsilon(1e-6));
}

TEST_CASE("friction of the contact heats the tread, hysteresis both, and the liner's sensor is in the carcass",
          "[fast]") {
  const models::Context<double> context =
      make_two_node({{"tread_share_of_heat", 0.7}, {"tread_share_of_heat_capacity", 0.4}});
  HandFedCorner<double> at(context, {tests::switch_on("slip_loss")});
  at.inputs.speed_m_s = 0.0;
  at.inputs.slip_power_W = 250.0;
  at.evaluate();
  const double tread_J_per_K = 0.4 * context.tire.thermal.heat_capacity_J_per_K;
  const double carcass_J_per_K = 0.6 * context.tire.thermal.heat_capacity_J_per_K;
  const auto tread = at.corner.state_of(Node::kTread);
  const auto carcass = at.corner.state_of(Node::kLiner);
  CHECK(at.rates[tread] * tread_J_per_K == Approx(250.0));
  CHECK(at.rates[carcass] == 0.0);
  at.inputs.slip_power_W = 0.0;
  at.inputs.speed_m_s = 20.0;
  at.evaluate();
  const double heat_W = 20.0 * at.now.rolling_resistance_N;
  CHECK(at.rates[tread] * tread_J_per_K == Approx(0.7 * heat_W));  // all of it is at 25 degC yet
  CHECK(at.rates[carcass] * carcass_J_per_K == Approx(0.3 * heat_W));
  CHECK(at.corner.states()[0].quantity.header() ==
        "carcass_temperature_degC");  // the first state is what the sensor reads
}

TEST_CASE("on a drum the liner's sensor reads the carcass, warmer by what flows from it to the tread", "[fast]") {
  tests::DrumFixture one;
  one.rig.drum.diameter_m = 1.707;
  one.tire.values.rolling_resistance.pressure_exponent = 0.0;  // the warmer carcass makes the pressure another
  tests::DrumFixture two = one;
  const double heat_share = 0.3;
  const double conductance_W_per_K = 45.0;
  two.tire.values.own = tests::make_own("two_node");
  two.tire.values.own.values = {0.4, heat_share, 1.0, conductance_W_per_K};
  sim::Program program;
  program.phases = {tests::rolling("steady", kLong_s, 23.0, 4900.0)};
  const auto recording = two.run_quasi_static(program);
  const double liner_degC = recording.channel(quantities::kLinerTemperature).back();
  const double of_one_node_degC = one.run_quasi_static(program).channel(quantities::kLinerTemperature).back();
  const double heat_W = recording.channel(quantities::kRollingResistance).back() * 23.0;
  const double rise_K = (1.0 - heat_share) * heat_W / conductance_W_per_K;
  CHECK(liner_degC - recording.channel("tread_temperature_degC").back() == Approx(rise_K).epsilon(1e-4));
  CHECK(liner_degC - of_one_node_degC == Approx(rise_K).epsilon(1e-4));
}

TEST_CASE("a two-node tire keeps all of its heat, whatever is on it", "[fast]") {
  std::vector<models::ActiveEffect> effects;
  for (const char* id : {"slip_loss", "rim_heat", "brake_heat", "gas_heat_transfer", "tread_liner_lag"}) {
    effects.push_back(tests::switch_on(id));
  }
  HandFedCorner<double> at(make_two_node(), effects, {}, 293.15);
  at.inputs.brake_force_N = 600.0;
  at.inputs.drive_force_N = -700.0;
  at.inputs.slip_power_W = 150.0;
  at.advance(700.0);
  const auto& heat = at.now.heat;
  CHECK(std::abs(at.temperature_K(Node::kTread) - at.temperature_K(Node::kLiner)) > 0.5);
  CHECK(at.stored_heat_rate_W(1.0) == Approx(heat.heat_in_W - heat.to_air_W - heat.to_road_W).epsilon(1e-7));
}

TEST_CASE("the rim gives off in proportion to what all of a two-node tire does", "[fast]") {
  const auto rim = tests::switch_on("rim_heat", {0.0, 0.5, 7.0, 0.5});
  const auto rate_of_rim = [&](const models::Context<double>& context) {
    HandFedCorner<double> at(context, {rim});
    at.temperature_K(Node::kRim) += 10.0;
    at.evaluate();
    return at.rates[at.corner.state_of(Node::kRim)];
  };
  CHECK(rate_of_rim(make_two_node()) == Approx(rate_of_rim(make_context_on(tests::kDyno))));
  CHECK(rate_of_rim(make_two_node()) < -1e-3);
}

TEST_CASE("derivatives by a two-node tire's own numbers agree with differences", "[fast]") {
  const models::Context<double> context = make_two_node();
  for (const models::TireModelParameter& own : context.tire.model().info.parameters) {
    INFO(own.field.key);
    const std::string key = std::string("tire.two_node.") + own.field.key;
    models::Context<double> moved = context;
    double& value = estimation::find_parameter(moved, key);
    const double center = value;
    const double step = 1e-4 * center;
    const auto read = [](auto& at) {
      return std::array{at.temperature_K(Node::kLiner), at.temperature_K(Node::kTread), at.now.rolling_resistance_N};
    };
    value = center + step;
    auto up = roll<double>(moved, 300.0, 100);
    value = center - step;
    auto down = roll<double>(moved, 300.0, 100);
    models::Context<Jet> by_key = models::convert_context<Jet>(context);
    estimation::find_parameter(by_key, key) = Jet(center, 0);
    HandFedCorner<Jet> jet(context, {}, {}, 293.15);
    jet.corner = models::Corner<Jet>(by_key, {});
    jet.inputs = up.inputs;
    jet.advance(300.0, 100);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(read(jet)[i].v[0] == Approx((read(up)[i] - read(down)[i]) / (2.0 * step)).epsilon(1e-5));
    }
  }
}
