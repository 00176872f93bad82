// Effects that act by a force, a factor or a load at once: limits, signs, and what of them heats the tire.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::ActiveEffect;
using tests::HandFedCorner;
using tests::make_context_on;
using tests::switch_on;

namespace {

/// Loss at a speed and a load, at 25 degC.
double find_loss_N(tests::Machine kind, const std::vector<ActiveEffect>& effects, double speed_m_s, double load_N) {
  HandFedCorner<double> at(make_context_on(kind), effects);
  at.inputs.speed_m_s = speed_m_s;
  at.inputs.load_N = load_N;
  return at.evaluate().rolling_resistance_N;
}

/// What the effect adds to the loss.
double find_added_N(const ActiveEffect& effect, double speed_m_s, double load_N, tests::Machine kind = tests::kDrum) {
  return find_loss_N(kind, {effect}, speed_m_s, load_N) - find_loss_N(kind, {}, speed_m_s, load_N);
}

}  // namespace

TEST_CASE("toe and camber drag by the given force at the reference load, more with load, none when lifted", "[fast]") {
  const ActiveEffect drag = switch_on("toe_camber_drag", {6.0});
  CHECK(find_added_N(drag, 20.0, 5400.0) == Approx(6.0));
  CHECK(find_added_N(drag, 35.0, 5400.0) == Approx(6.0));  // whatever the speed
  CHECK(find_added_N(drag, 20.0, 200.0) < 6.0);
  CHECK(find_added_N(drag, 20.0, 200.0) > 0.0);
  CHECK(find_added_N(drag, 20.0, 0.0) == 0.0);
  CHECK(find_added_N(switch_on("toe_camber_drag", {6.0, 0.5, 1.0}), 20.0, 2700.0) == Approx(3.0));
  CHECK(find_added_N(drag, 20.0, 5400.0, tests::kDyno) == Approx(6.0));
}

TEST_CASE("of toe and camber drag the rubber gets its share, and no more", "[fast]") {
  for (const double share : {0.0, 0.3, 1.0}) {
    HandFedCorner<double> with(make_context_on(tests::kDrum), {switch_on("toe_camber_drag", {6.0, share})});
    HandFedCorner<double> without(make_context_on(tests::kDrum), {});
    CHECK(with.evaluate().heat.heat_in_W - without.evaluate().heat.heat_in_W ==
          Approx(share * 6.0 * 80.0 / 3.6).margin(1e-9));
  }
}

TEST_CASE("the standing wave starts at its critical speed, grows with the square, and heats the rubber", "[fast]") {
  const ActiveEffect wave = switch_on("standing_wave", {2.0, 28.0});
  CHECK(find_added_N(wave, 20.0, 5400.0) == 0.0);
  CHECK(find_added_N(wave, 28.0, 5400.0) == 0.0);
  const double by_one_N = find_added_N(wave, 29.0, 5400.0);
  CHECK(find_added_N(wave, 30.0, 5400.0) == Approx(4.0 * by_one_N));
  CHECK(find_added_N(wave, 31.0, 5400.0) == Approx(9.0 * by_one_N));
  CHECK(find_added_N(wave, 120.0 / 3.6, 5400.0) ==
        Approx(2.0).epsilon(0.04));  // well below 120 km/h, F_w is that force
  CHECK(find_added_N(wave, 33.0, 200.0) < 0.2 * find_added_N(wave, 33.0, 5400.0));
  CHECK(find_added_N(wave, 33.0, 0.0) == 0.0);
  CHECK(find_added_N(switch_on("standing_wave", {2.0, 120.0 / 3.6}), 120.0 / 3.6, 5400.0) == 0.0);  // no 0/0
  HandFedCorner<double> with(make_context_on(tests::kDrum), {wave});
  with.inputs.speed_m_s = 33.0;
  const auto& now = with.evaluate();
  CHECK(now.heat.heat_in_W == Approx(now.rolling_resistance_N * 33.0));
}

TEST_CASE("loss goes with a power of the correction factor from one surface to another", "[fast]") {
  const auto find_on = [](double curvature_per_m, const std::vector<ActiveEffect>& effects) {
    auto context = make_context_on(tests::kDrum);
    context.surface_curvature_per_m = curvature_per_m;
    return HandFedCorner<double>(context, effects).evaluate().rolling_resistance_N;
  };
  constexpr double kReference_per_m = 1.0;  // of the 2 m drum
  const double reference_N = find_on(kReference_per_m, {});
  for (const double exponent : {0.6, 1.4}) {
    const std::vector<ActiveEffect> with{switch_on("curvature_exponent", {exponent})};
    for (const double curvature_per_m : {0.0, 2.0 / 1.707, 1.0 / 0.6}) {
      const double without_N = find_on(curvature_per_m, {});
      CHECK(find_on(curvature_per_m, with) == Approx(reference_N * std::pow(without_N / reference_N, exponent)));
    }
    CHECK(find_on(kReference_per_m, with) == reference_N);
  }
  // to the power 0 there is no correction: every surface is like the reference drum
  CHECK(find_on(1.0 / 0.6, {switch_on("curvature_exponent", {0.0})}) == Approx(reference_N));
}

TEST_CASE("tie-downs press the wheel onto its roller, and only there", "[fast]") {
  for (const tests::Machine kind : rigs::machine_kinds()) {
    HandFedCorner<double> at(make_context_on(kind), {switch_on("tie_down_load", {300.0})});
    CHECK(at.evaluate().acting.load_N == (kind == tests::kDyno ? 5700.0 : 5400.0));
    CHECK(at.now.recorded.load_N == 5400.0);
  }
  // the loss goes with the load
  CHECK(find_loss_N(tests::kDyno, {switch_on("tie_down_load", {300.0})}, 20.0, 5400.0) ==
        Approx(find_loss_N(tests::kDyno, {}, 20.0, 5700.0)));
}

TEST_CASE("a restraint that lifts more than there is leaves no load", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("tie_down_load", {-900.0, 0.0})});
  at.inputs.load_N = 500.0;
  CHECK(at.evaluate().acting.load_N == 0.0);
}

TEST_CASE("straps creep from what they were tied down with, and have crept right after a run", "[fast]") {
  const auto effect = switch_on("tie_down_load", {300.0, 0.2});
  HandFedCorner<double> at(make_context_on(tests::kDyno), {effect});
  CHECK(at.evaluate().acting.load_N == 5700.0);
  at.advance(900.0);
  CHECK(at.now.acting.load_N < 5700.0);
  at.advance(10.0 * 3600.0, 4000);
  CHECK(at.now.acting.load_N == Approx(5400.0 + 0.8 * 300.0));
  models::InitialPort<double> warm;
  warm.started_warm = true;
  CHECK(HandFedCorner<double>(make_context_on(tests::kDyno), {effect}, warm).evaluate().acting.load_N ==
        Approx(5400.0 + 0.8 * 300.0));
}

TEST_CASE("an error of inertia is on the machine and on the vehicle alike", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("inertia_error", {-2.5})});
  CHECK(at.evaluate().contact.machine_inertia_factor == Approx(0.975));
  CHECK(at.now.contact.vehicle_mass_factor == Approx(0.975));
  HandFedCorner<double> off(make_context_on(tests::kDyno), {switch_on("inertia_error", {0.0})});
  CHECK(off.evaluate().contact.machine_inertia_factor == 1.0);
  CHECK(off.now.contact.vehicle_mass_factor == 1.0);
}

TEST_CASE("more drum inertia asks for torque by its share of J a/R, and none at constant speed", "[fast]") {
  tests::DrumFixture fixture;
  sim::Program program;
  sim::Phase up = tests::rolling("up", 60.0, 5.0, 5400.0);
  up.segments = {tests::drum_segment(60.0, 5.0, 20.0, 5400.0)};
  program.phases = {up, tests::rolling("steady", 60.0, 20.0, 5400.0)};
  const auto plain = fixture.run_quasi_static(program);
  fixture.effects = {switch_on("inertia_error", {4.0})};
  const auto with = fixture.run_quasi_static(program);
  const double radius_m = fixture.rig.drum.diameter_m / 2.0;
  const double added_Nm = 0.04 * fixture.rig.drum.inertia_kg_m2 / radius_m * (15.0 / 60.0);
  CHECK(with.channel("drum_torque_Nm")[30] - plain.channel("drum_torque_Nm")[30] == Approx(added_Nm));
  CHECK(with.channel("drum_torque_Nm")[100] == Approx(plain.channel("drum_torque_Nm")[100]).epsilon(1e-10));
}

TEST_CASE("friction of loaded bearings goes with the load, not with temperature or speed, and heats no tire",
          "[fast]") {
  const ActiveEffect friction = switch_on("bearing_load_friction", {2.0});
  for (const tests::Machine kind : {tests::kDrum, tests::kDyno}) {
    for (const double temperature_K : {280.0, 330.0}) {
      HandFedCorner<double> with(make_context_on(kind), {friction}, {}, temperature_K);
      HandFedCorner<double> without(make_context_on(kind), {}, {}, temperature_K);
      const auto added_N = [&](double load_N, double speed_m_s) {
        for (auto* at : {&with, &without}) {
          at->inputs.load_N = load_N;
          at->inputs.speed_m_s = speed_m_s;
          at->evaluate();
        }
        CHECK(with.now.heat.heat_in_W == without.now.heat.heat_in_W);
        return with.now.parasitic_N - without.now.parasitic_N;
      };
      CHECK(added_N(5400.0, 20.0) == Approx(2.0));
      CHECK(added_N(5400.0, 35.0) == Approx(2.0));
      CHECK(added_N(2700.0, 20.0) == Approx(1.0));
      CHECK(added_N(0.0, 20.0) == 0.0);
      CHECK(added_N(5400.0, 0.0) == 0.0);  // friction at rest holds, and turns nothing
    }
  }
}

TEST_CASE("friction of loaded bearings is reported as the tire's, but for its share at skim load", "[fast]") {
  // F_r = T/R - F_pl with F_pl from the skim phase: what goes with the load does not cancel
  tests::DrumFixture fixture;
  sim::Program program;
  program.phases = {tests::rolling("load", 120.0, 20.0, 5400.0), tests::rolling("skim", 120.0, 20.0, 200.0)};
  const auto plain = fixture.run_quasi_static(program);
  fixture.effects = {switch_on("bearing_load_friction", {1.5})};
  const auto with = fixture.run_quasi_static(program);
  const auto added_N = [&](std::size_t row) {
    const double torque_Nm = with.channel("drum_torque_Nm")[row] - plain.channel("drum_torque_Nm")[row];
    return torque_Nm / (fixture.rig.drum.diameter_m / 2.0);
  };
  CHECK(added_N(100) - added_N(220) == Approx(1.5 * (1.0 - 200.0 / 5400.0)));
}

TEST_CASE("loss goes with the pressure by the tire's exponent and the shift together", "[fast]") {
  const auto loss_N = [](const std::vector<ActiveEffect>& effects, double pressure_Pa) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), effects);
    at.now.inflation.cold_pressure_Pa = pressure_Pa;
    return at.evaluate().rolling_resistance_N;
  };
  const auto context = make_context_on(tests::kDrum);
  const double own = context.tire.rolling_resistance.pressure_exponent;
  const double reference_Pa = context.tire.rolling_resistance.reference_pressure_Pa;
  for (const double shift : {-0.15, 0.1}) {
    const std::vector<ActiveEffect> with{switch_on("pressure_exponent", {shift})};
    CHECK(loss_N(with, 150e3) / loss_N(with, 300e3) == Approx(std::pow(2.0, own + shift)));
    CHECK(loss_N(with, reference_Pa) == Approx(loss_N({}, reference_Pa)).epsilon(1e-14));
  }
  // without any exponent left, the pressure does not matter
  const std::vector<ActiveEffect> none{switch_on("pressure_exponent", {-own})};
  CHECK(loss_N(none, 150e3) == Approx(loss_N(none, 300e3)).epsilon(1e-14));
}
