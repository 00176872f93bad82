// The rim: what it takes, what it gives to the air, and what the brakes put into it.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/models/effects/heat_balance.h"

using namespace rollrig;
using models::index_of;
using models::Node;
using tests::check_heat_balance;
using tests::HandFedCorner;
using tests::make_context_on;
using tests::switch_on;

namespace {

models::ActiveEffect rim_at(double conductance_W_per_K, double gas_share = 0.5) {
  return switch_on("rim_heat", {conductance_W_per_K, gas_share, 7.0, 0.4});
}

}  // namespace

TEST_CASE("tire, gas and rim that lose nothing come to one temperature, and no heat is lost", "[fast]") {
  auto context = make_context_on(tests::kDrum);
  context.tire.thermal.rest_conductance_W_per_K = 0.0;
  context.tire.thermal.speed_conductance_W_s_per_m_K = 0.0;
  HandFedCorner<double> at(context, {rim_at(2.0)});
  at.inputs.speed_m_s = 0.0;
  at.temperature_K(Node::kRim) = 330.0;
  const auto& thermal = context.tire.thermal;
  const double tire_J_per_K = thermal.heat_capacity_J_per_K + thermal.gas_heat_capacity_J_per_K;
  const double mixed_K = (tire_J_per_K * 298.15 + 7000.0 * 330.0) / (tire_J_per_K + 7000.0);
  at.advance(20.0 * 3600.0, 20000);
  for (const Node node : {Node::kLiner, Node::kGas, Node::kRim}) CHECK(at.temperature_K(node) == Approx(mixed_K));
}

TEST_CASE("a rim in steady rolling passes on what its conductances in series let through", "[fast]") {
  // all from the rubber: (T - T_rim) U = (T_rim - T_amb) a_rim
  HandFedCorner<double> at(make_context_on(tests::kDrum), {rim_at(3.0, 0.0)});
  at.advance(8.0 * 3600.0, 20000);
  const auto& thermal = at.corner.context().tire.thermal;
  const double at_rest_W_per_K = (1.0 - thermal.road_share_of_rest_conductance) * thermal.rest_conductance_W_per_K;
  const double by_speed_W_per_K = thermal.speed_conductance_W_s_per_m_K * at.inputs.speed_m_s;
  const double rubber_air_W_per_K =
      at_rest_W_per_K + (1.0 - thermal.road_share_of_speed_conductance) * by_speed_W_per_K;
  // the rim has no road under it: of its 0.4 none of what goes with speed is the road's
  const double series_W_per_K = 1.0 / (1.0 / 3.0 + 1.0 / (0.4 * (at_rest_W_per_K + by_speed_W_per_K)));
  const double over_ambient_K = at.temperature_K(Node::kLiner) - at.inputs.ambient_K;
  CHECK(at.now.heat.to_air_W - rubber_air_W_per_K * over_ambient_K ==
        Approx(series_W_per_K * over_ambient_K).epsilon(1e-6));
  CHECK(at.temperature_K(Node::kGas) == Approx(at.temperature_K(Node::kLiner)));
}

TEST_CASE("a rim cools tire and gas, the more the better it conducts, and the gas lies between rubber and rim",
          "[fast]") {
  const auto settle = [](double conductance_W_per_K) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), {rim_at(conductance_W_per_K)});
    at.advance(4.0 * 3600.0, 10000);
    CHECK(at.temperature_K(Node::kGas) <= at.temperature_K(Node::kLiner) + 1e-9);
    CHECK(at.temperature_K(Node::kGas) >= at.temperature_K(Node::kRim));
    return std::pair(at.temperature_K(Node::kLiner), at.temperature_K(Node::kGas));
  };
  const auto [rubber_0, gas_0] = settle(0.0);
  const auto [rubber_1, gas_1] = settle(1.0);
  const auto [rubber_4, gas_4] = settle(4.0);
  CHECK(rubber_0 > rubber_1 + 0.1);
  CHECK(rubber_1 > rubber_4 + 0.1);
  CHECK(gas_0 - gas_4 > rubber_0 - rubber_4);
}

TEST_CASE("a rim cools faster in motion than at rest", "[fast]") {
  const auto rim_after = [](double speed_m_s) {
    HandFedCorner<double> at(make_context_on(tests::kDyno), {rim_at(0.0)});
    at.inputs.speed_m_s = speed_m_s;
    at.temperature_K(Node::kRim) = 340.0;
    at.advance(600.0);
    return at.temperature_K(Node::kRim);
  };
  CHECK(rim_after(30.0) < rim_after(10.0));
  CHECK(rim_after(10.0) < rim_after(0.0));
  CHECK(rim_after(0.0) < 340.0);
}

TEST_CASE("without conductance the rim is not felt, and derivatives by the conductance are right there", "[fast]") {
  const auto drive = [](double conductance_W_per_K) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), {rim_at(conductance_W_per_K)});
    at.advance(1200.0);
    return std::pair(at.temperature_K(Node::kLiner), at.now.pressure_Pa);
  };
  HandFedCorner<double> plain(make_context_on(tests::kDrum), {});
  plain.advance(1200.0);
  CHECK(drive(0.0).first == plain.temperature_K(Node::kLiner));
  CHECK(drive(0.0).second == plain.now.pressure_Pa);
  HandFedCorner<Jet> jet(make_context_on(tests::kDrum), {rim_at(0.0)});
  jet.corner.effects()[0].parameters[0] = Jet(0.0, 0);
  jet.advance(1200.0);
  const double h = 1e-3;  // one-sided, second order
  const auto at_0 = drive(0.0);
  const auto at_h = drive(h);
  const auto at_2h = drive(2.0 * h);
  CHECK(jet.temperature_K(Node::kLiner).v[0] ==
        Approx((4.0 * at_h.first - at_2h.first - 3.0 * at_0.first) / (2.0 * h)).epsilon(1e-4));
  CHECK(jet.now.pressure_Pa.v[0] ==
        Approx((4.0 * at_h.second - at_2h.second - 3.0 * at_0.second) / (2.0 * h)).epsilon(1e-4));
  CHECK(jet.temperature_K(Node::kLiner).v[0] < -0.1);
}

TEST_CASE("with a rim the heat balance closes, beside a tread and braking too", "[fast]") {
  for (const tests::Machine kind : rigs::machine_kinds()) {
    HandFedCorner<double> at(make_context_on(kind),
                             {rim_at(2.0), switch_on("tread_liner_lag"), switch_on("brake_heat")}, {}, 315.0);
    at.inputs.brake_force_N = is_of_vehicle(kind->traits) ? 800.0 : 0.0;
    at.temperature_K(Node::kRim) = 305.0;
    check_heat_balance(at);
    at.advance(300.0);
    check_heat_balance(at);
  }
}

TEST_CASE("splitting off a tread leaves the rim its conductance to the air", "[fast]") {
  const auto air_W_per_K = [](const std::vector<models::ActiveEffect>& effects) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), effects);
    return at.evaluate().thermal.air_W_per_K[index_of(Node::kRim)];
  };
  std::vector<models::ActiveEffect> in_order;  // of the registry
  for (const models::Effect* effect : models::all_effects()) {
    if (effect->info.id == "rim_heat") in_order.push_back(rim_at(2.0));
    if (effect->info.id == "tread_liner_lag") in_order.push_back(switch_on("tread_liner_lag"));
  }
  CHECK(air_W_per_K(in_order) == air_W_per_K({rim_at(2.0)}));
}

TEST_CASE("into a linked rim the brake puts what makes the same share arrive", "[fast]") {
  for (const double link_W_per_K : {0.0, 2.0}) {
    for (const double gas_share : {0.0, 0.5, 1.0}) {
      HandFedCorner<double> at(make_context_on(tests::kDyno),
                               {rim_at(link_W_per_K, gas_share), switch_on("brake_heat", {10.0, 10.0, 2.0, 0.3, 1.0})});
      at.inputs.brake_force_N = 450.0;
      at.inputs.speed_m_s = 20.0;                           // 900 W bound for the tire
      at.state("brake_heat.disc_heat_kJ") = 900.0 * 120.0;  // J, as in steady braking
      const auto& now = at.evaluate();
      const double rim_W = now.thermal.heat_W[index_of(Node::kRim)];
      const double air_W_per_K = now.thermal.air_W_per_K[index_of(Node::kRim)];
      if (link_W_per_K == 0.0) {
        CHECK(rim_W == 0.0);
        CHECK(now.thermal.under_way_W == Approx(900.0));
      } else {
        // in a steady rim U/(U + U_air) of it goes to the tire
        CHECK(rim_W * link_W_per_K / (link_W_per_K + air_W_per_K) == Approx(900.0));
        CHECK(now.thermal.under_way_W == Approx(0.0).margin(1e-9));
      }
      check_heat_balance(at);
    }
  }
}

TEST_CASE("heat of the brakes reaches the tire through the linked rim, late, and warms it as much in the end",
          "[fast]") {
  // steady braking: what arrives is that of the brake's own delay, so the rubber rises alike (all from the rubber)
  const auto rise_K = [](const std::vector<models::ActiveEffect>& with_brake,
                         const std::vector<models::ActiveEffect>& without, double time_s) {
    HandFedCorner<double> braked(make_context_on(tests::kDyno), with_brake);
    HandFedCorner<double> free(make_context_on(tests::kDyno), without);
    for (auto* at : {&braked, &free}) {
      at->inputs.speed_m_s = 20.0;
      at->inputs.brake_force_N = 100.0;
      at->advance(time_s, static_cast<int>(time_s));
    }
    return braked.temperature_K(Node::kLiner) - free.temperature_K(Node::kLiner);
  };
  const auto brake = switch_on("brake_heat", {5.0, 10.0});
  const auto rim = rim_at(1.0, 0.0);
  const double hours_s = 6.0 * 3600.0;
  const double through_rim_K = rise_K({rim, brake}, {rim}, hours_s);
  CHECK(through_rim_K > 1.0);
  CHECK(rise_K({rim, brake}, {rim}, 60.0) < 0.05 * through_rim_K);
  CHECK(through_rim_K == Approx(rise_K({brake}, {}, hours_s)).epsilon(0.1));  // but for what the rim's link cools
}
