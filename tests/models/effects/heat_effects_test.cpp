// Effects on the heat of the tire: where it comes from, where it goes, that none is lost.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/models/effects/heat_balance.h"

using namespace rollrig;
using models::Node;
using tests::check_heat_balance;
using tests::HandFedCorner;
using tests::make_context_on;
using tests::switch_on;

namespace {

/// The context with no heat leaving the rubber by other ways than an effect's.
models::Context<double> insulated(tests::Machine kind) {
  models::Context<double> context = make_context_on(kind);
  context.tire.thermal.rest_conductance_W_per_K = 0.0;
  context.tire.thermal.speed_conductance_W_s_per_m_K = 0.0;
  context.tire.thermal.H_gas_W_per_K = 0.0;
  return context;
}

}  // namespace

TEST_CASE("slip power goes into the rubber, all of it", "[fast]") {
  HandFedCorner<double> with(make_context_on(tests::kDyno), {switch_on("slip_loss", {1.0 / 100.0})});
  HandFedCorner<double> without(make_context_on(tests::kDyno), {});
  for (auto* at : {&with, &without}) {
    at->inputs.drive_force_N = -2000.0;
    at->inputs.slip_power_W = 2000.0 * 2000.0 / 100e3 * 20.0;  // 800 W: Fx^2 v/C
    at->evaluate();
  }
  CHECK(with.now.contact.slip_compliance_per_N == Approx(1e-5));
  CHECK(with.now.heat.heat_in_W - without.now.heat.heat_in_W == Approx(800.0));
  CHECK(with.rates[with.corner.state_of(Node::kLiner)] > without.rates[without.corner.state_of(Node::kLiner)]);
}

TEST_CASE("without compliance numerical slip heats nothing, and the derivative is that of Fx^2 v/C", "[fast]") {
  HandFedCorner<Jet> at(make_context_on(tests::kDyno), {switch_on("slip_loss", {0.0})});
  at.corner.effects()[0].parameters[0] = Jet(0.0, 0);
  HandFedCorner<Jet> without(make_context_on(tests::kDyno), {});
  for (auto* one : {&at, &without}) {
    one->inputs.speed_m_s = 20.0;
    one->inputs.drive_force_N = 1500.0;
    one->inputs.slip_power_W = 3.0;
    one->evaluate();
  }
  CHECK(at.now.heat.heat_in_W.a == without.now.heat.heat_in_W.a);
  CHECK(at.now.heat.heat_in_W.v[0] == Approx(1500.0 * 1500.0 * 20.0));
}

TEST_CASE("on the drum what slips heats the rubber, in both fidelities", "[fast]") {
  tests::DrumFixture fixture;
  fixture.effects = {switch_on("slip_loss", {1.0 / 60.0})};
  sim::Program program;
  sim::Phase up = tests::rolling("up", 30.0, 2.0, 5400.0);
  up.segments = {tests::drum_segment(30.0, 2.0, 35.0, 5400.0)};
  program.phases = {up, tests::rolling("fast", 300.0, 35.0, 5400.0)};
  for (const auto& run : {fixture.run_multibody(program), fixture.run_quasi_static(program)}) {
    const double slip_J = -run.audit.find_term_J("slip_loss");
    CHECK(slip_J > 0.0);
    CHECK(run.audit.find_term_J("heat_generated") ==
          Approx(-run.audit.find_term_J("tire_loss") + slip_J).epsilon(1e-6));
    CHECK_NOTHROW(run.audit.require_closed(sim::kAuditLimit));
  }
}

TEST_CASE("tread and liner even out with one time constant, whatever the tread's share", "[fast]") {
  for (const double share : {0.1, 0.5, 0.9}) {
    const auto context = insulated(tests::kDrum);
    HandFedCorner<double> at(context, {switch_on("tread_liner_lag", {share, 60.0})});
    at.inputs.speed_m_s = 0.0;
    at.temperature_K(Node::kTread) = 320.0;
    const double mean_K = share * 320.0 + (1.0 - share) * 298.15;
    const double time_s = context.tire.thermal.heat_capacity_J_per_K / (4.0 * 60.0);
    at.advance(time_s);
    const double tread_K = at.temperature_K(Node::kTread);
    const double liner_K = at.temperature_K(Node::kLiner);
    CHECK(tread_K - liner_K == Approx((320.0 - 298.15) * std::exp(-1.0)).epsilon(1e-6));
    CHECK(share * tread_K + (1.0 - share) * liner_K == Approx(mean_K).epsilon(1e-12));
  }
}

TEST_CASE("two halves heated alike and cooled on the tread alone differ by half the heat over the conductance",
          "[fast]") {
  // Liner: no cooling, half the heat Q; in steady state all of Q/2 passes the conductance G.
  const double everything = 60.0;  // power at which the tread has all of the cooling
  auto context = make_context_on(tests::kDrum);
  HandFedCorner<double> at(context, {switch_on("tread_liner_lag", {0.5, 80.0, 1.0, everything})});
  at.advance(6.0 * 3600.0, 10000);
  const double heat_W = at.now.rolling_resistance_N * at.inputs.speed_m_s;
  CHECK(at.temperature_K(Node::kLiner) - at.temperature_K(Node::kTread) == Approx(0.5 * heat_W / 80.0).epsilon(1e-6));
  CHECK(at.now.loss.temperature_K ==
        Approx(0.5 * (at.temperature_K(Node::kLiner) + at.temperature_K(Node::kTread))).epsilon(1e-12));
}

TEST_CASE("splitting the rubber neither makes nor loses capacity, heat or cooling", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("tread_liner_lag")}, {}, 315.0);
  HandFedCorner<double> plain(make_context_on(tests::kDyno), {}, {}, 315.0);
  at.evaluate();
  plain.evaluate();
  CHECK(at.corner.calc_stored_heat_J(at.x.data()) == Approx(plain.corner.calc_stored_heat_J(plain.x.data())));
  CHECK(at.now.heat.heat_in_W == Approx(plain.now.heat.heat_in_W));
  CHECK(at.now.heat.to_air_W == Approx(plain.now.heat.to_air_W));
  CHECK(at.now.heat.to_road_W == Approx(plain.now.heat.to_road_W));
  at.temperature_K(Node::kTread) = 330.0;
  check_heat_balance(at);
}

TEST_CASE("a tread of no share is carried along unfelt, and derivatives by the share are right there", "[fast]") {
  const auto effect_at = [](double share) { return switch_on("tread_liner_lag", {share, 60.0, 0.8, 2.0}); };
  const auto liner_at = [&](double share) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), {effect_at(share)});
    at.advance(300.0);
    return at.temperature_K(Node::kLiner);
  };
  HandFedCorner<double> plain(make_context_on(tests::kDrum), {});
  plain.advance(300.0);
  CHECK(liner_at(0.0) == plain.temperature_K(Node::kLiner));
  HandFedCorner<Jet> jet(make_context_on(tests::kDrum), {effect_at(0.0)});
  jet.corner.effects()[0].parameters[0] = Jet(0.0, 0);
  jet.advance(300.0);
  const double h = 1e-4;  // one-sided, second order
  const double difference = (4.0 * liner_at(h) - liner_at(2.0 * h) - 3.0 * liner_at(0.0)) / (2.0 * h);
  CHECK(jet.temperature_K(Node::kLiner).v[0] == Approx(difference).epsilon(1e-4));
  CHECK(std::abs(difference) > 0.1);
}

TEST_CASE("a well conducting tire has one temperature", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("tread_liner_lag", {0.5, 2e5})});
  HandFedCorner<double> plain(make_context_on(tests::kDrum), {});
  at.advance(300.0, 20000);
  plain.advance(300.0);
  CHECK(at.temperature_K(Node::kLiner) == Approx(plain.temperature_K(Node::kLiner)).epsilon(1e-5));
}

TEST_CASE("of the brake's power the tire gets its share in steady braking, late", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("brake_heat", {10.0, 10.0, 2.0, 0.25, 1.0})});
  HandFedCorner<double> plain(make_context_on(tests::kDyno), {});
  for (auto* one : {&at, &plain}) {
    one->inputs.speed_m_s = 20.0;
    one->inputs.brake_force_N = 500.0;  // 10 kW, of which 1 kW is bound for the tire
  }
  const auto rubber = at.corner.state_of(Node::kLiner);
  const auto gas = at.corner.state_of(Node::kGas);
  const auto arriving_W = [&] {
    const auto& heat_W = at.evaluate().thermal.heat_W;
    const double loss_W = at.now.heating_force_N * at.inputs.speed_m_s;
    CHECK(heat_W[gas] == Approx((heat_W[rubber] - loss_W) / 3.0).margin(1e-9));  // a quarter of all
    return heat_W[rubber] + heat_W[gas] - loss_W;
  };
  CHECK(arriving_W() == Approx(0.0).margin(1e-9));  // none at once
  CHECK(at.now.heat.heat_in_W - plain.evaluate().heat.heat_in_W == Approx(1000.0));
  check_heat_balance(at);
  at.advance(600.0);
  // two lags, one after the other: 10 min and 2 min
  CHECK(arriving_W() == Approx(1000.0 * (1.0 - (10.0 * std::exp(-1.0) - 2.0 * std::exp(-5.0)) / 8.0)).epsilon(1e-6));
  check_heat_balance(at);
  at.advance(4.0 * 3600.0, 4000);
  CHECK(arriving_W() == Approx(1000.0).epsilon(1e-6));
}

TEST_CASE("brake heat that passes the disc by comes by the rim's lag alone", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("brake_heat", {10.0, 10.0, 2.0, 0.25, 0.0})});
  at.inputs.speed_m_s = 20.0;
  at.inputs.brake_force_N = 500.0;  // 10 kW, of which 1 kW is bound for the tire
  at.advance(600.0);
  CHECK(at.state("brake_heat.disc_heat_kJ") == 0.0);
  CHECK(at.state("brake_heat.rim_heat_kJ") == Approx(1000.0 * 600.0 * (1.0 - std::exp(-1.0))).epsilon(1e-6));
  check_heat_balance(at);
}

TEST_CASE("all heat that was bound for the tire arrives after the braking", "[fast]") {
  HandFedCorner<double> at(insulated(tests::kRoad), {switch_on("brake_heat", {5.0, 8.0, 3.0, 0.0})});
  at.inputs.speed_m_s = 25.0;
  at.inputs.brake_force_N = 2000.0;
  const double before_J = at.corner.calc_stored_heat_J(at.x.data());
  at.advance(10.0);
  const double after_J = at.corner.calc_stored_heat_J(at.x.data());
  at.inputs.speed_m_s = 0.0;         // no loss of its own
  at.inputs.brake_force_N = 2000.0;  // holds, without work
  const double rubber_K = at.temperature_K(Node::kLiner);
  const double on_its_way_J = at.state("brake_heat.disc_heat_kJ") + at.state("brake_heat.rim_heat_kJ");
  at.advance(4.0 * 3600.0, 4000);
  CHECK(at.corner.calc_stored_heat_J(at.x.data()) == Approx(after_J).epsilon(1e-9));
  CHECK((at.temperature_K(Node::kLiner) - rubber_K) * at.corner.context().tire.thermal.heat_capacity_J_per_K ==
        Approx(on_its_way_J).epsilon(1e-6));
  CHECK(after_J - before_J > 0.05 * 2000.0 * 250.0);  // and the rolling loss beside it
}

TEST_CASE("effects of a vehicle leave a drum rig alone to the bit", "[fast]") {
  for (const char* id : {"brake_heat", "brake_drag", "driveline_warming", "tie_down_load"}) {
    INFO(id);
    HandFedCorner<double> with(make_context_on(tests::kDrum), {switch_on(id)}, {}, 310.0);
    HandFedCorner<double> without(make_context_on(tests::kDrum), {}, {}, 310.0);
    for (auto* one : {&with, &without}) {
      one->inputs.brake_force_N = 1000.0;
      one->evaluate();
    }
    CHECK(with.now.rolling_resistance_N == without.now.rolling_resistance_N);
    CHECK(with.now.parasitic_N == without.now.parasitic_N);
    CHECK(with.now.heat.heat_in_W == without.now.heat.heat_in_W);
    CHECK(with.rates[0] == without.rates[0]);
    for (std::size_t i = 2; i < with.rates.size(); ++i) CHECK(with.rates[i] == 0.0);
  }
}
