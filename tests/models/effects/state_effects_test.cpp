// Effects with a state of their own: where it starts, how fast it moves, where it settles.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::Node;
using models::RigKind;
using tests::HandFedCorner;
using tests::make_context_on;
using tests::switch_on;

namespace {

constexpr double k80_m_s = 80.0 / 3.6;

models::InitialPort<double> rested(double hours) {
  models::InitialPort<double> initial;
  initial.soaked = false;
  initial.rest_before_s = hours * 3600.0;
  return initial;
}

models::InitialPort<double> warm() {
  models::InitialPort<double> initial;
  initial.soaked = false;
  initial.started_warm = true;
  return initial;
}

}  // namespace

TEST_CASE("a flat spot rolls out over distance, whatever the speed", "[fast]") {
  for (const double speed_m_s : {5.0, 20.0, 36.0}) {
    HandFedCorner<double> at(make_context_on(RigKind::kDrum), {switch_on("flat_spot", {5.0, 8.0})});
    CHECK(at.state("flat_spot.flatness") == 1.0);
    at.inputs.speed_m_s = speed_m_s;
    CHECK(at.evaluate().loss.factor == Approx(1.05));
    at.advance(4000.0 / speed_m_s);  // half its distance
    CHECK(at.state("flat_spot.flatness") == Approx(std::exp(-0.5)).epsilon(1e-6));
    CHECK(at.now.loss.factor == Approx(1.0 + 0.05 * std::exp(-0.5)).epsilon(1e-6));
  }
}

TEST_CASE("a flat spot comes back at rest, and starts from the rest before the run", "[fast]") {
  const auto effect = switch_on("flat_spot", {5.0, 8.0, 2.0});
  const auto context = make_context_on(RigKind::kFlat);
  CHECK(HandFedCorner<double>(context, {effect}, warm()).state("flat_spot.flatness") == 0.0);
  CHECK(HandFedCorner<double>(context, {effect}, rested(0.0)).state("flat_spot.flatness") == 0.0);
  CHECK(HandFedCorner<double>(context, {effect}, rested(100.0)).state("flat_spot.flatness") == Approx(1.0));
  HandFedCorner<double> at(context, {effect}, warm());
  at.inputs.speed_m_s = 0.0;
  at.advance(3600.0);
  // one hour at rest is one hour before the run
  CHECK(at.state("flat_spot.flatness") ==
        Approx(HandFedCorner<double>(context, {effect}, rested(1.0)).state("flat_spot.flatness")).epsilon(1e-6));
}

TEST_CASE("brake drag is set by braking, never above its size, and decays with its time constant", "[fast]") {
  HandFedCorner<double> at(make_context_on(RigKind::kDyno), {switch_on("brake_drag", {8.0, 2.0, 3.0, 100.0})});
  HandFedCorner<double> plain(make_context_on(RigKind::kDyno), {});
  CHECK(at.evaluate().parasitic_N == plain.evaluate().parasitic_N);  // nothing before the first braking
  for (auto* one : {&at, &plain}) {
    one->inputs.brake_force_N = 3000.0;
    one->advance(30.0);
  }
  const double set = at.state("brake_drag.dragging");
  CHECK(set > 0.9);
  CHECK(set < 1.0);
  CHECK(at.now.parasitic_N - plain.now.parasitic_N == Approx(8.0 * set));
  CHECK(at.now.heating_force_N == plain.now.heating_force_N);  // the tire stays as it is
  at.inputs.brake_force_N = 0.0;
  at.advance(120.0);
  CHECK(at.state("brake_drag.dragging") == Approx(set * std::exp(-1.0)).epsilon(1e-6));
}

TEST_CASE("light and short braking sets less drag than strong and long", "[fast]") {
  const auto set_by = [](double brake_N, double duration_s) {
    HandFedCorner<double> at(make_context_on(RigKind::kDyno), {switch_on("brake_drag")});
    at.inputs.brake_force_N = brake_N;
    at.advance(duration_s);
    return at.state("brake_drag.dragging");
  };
  CHECK(set_by(50.0, 3.0) < set_by(2000.0, 3.0));
  CHECK(set_by(2000.0, 3.0) < set_by(2000.0, 10.0));
  CHECK(set_by(0.0, 10.0) == 0.0);
}

TEST_CASE("cold oil costs its whole force, warm oil exp(-k) of it, by a first-order warm-up", "[fast]") {
  HandFedCorner<double> at(make_context_on(RigKind::kDyno), {switch_on("driveline_warming", {12.0, 30.0, 1.5})});
  HandFedCorner<double> plain(make_context_on(RigKind::kDyno), {});
  const double baseline_N = plain.evaluate().parasitic_N;
  CHECK(at.evaluate().parasitic_N - baseline_N == Approx(12.0));
  CHECK(at.now.heating_force_N == plain.now.heating_force_N);
  at.advance(1800.0);
  CHECK(at.state("driveline_warming.oil_rise") == Approx(1.0 - std::exp(-1.0)).epsilon(1e-6));
  at.advance(30.0 * 3600.0, 4000);
  CHECK(at.now.parasitic_N - baseline_N == Approx(12.0 * std::exp(-1.5)).epsilon(1e-6));
  at.inputs.speed_m_s = 0.0;
  at.advance(1800.0);
  CHECK(at.state("driveline_warming.oil_rise") == Approx(std::exp(-1.0)).epsilon(1e-6));
}

TEST_CASE("oil is cold after a soak, warm right after a run, and between them after a rest", "[fast]") {
  const auto effect = switch_on("driveline_warming", {12.0, 60.0});
  const auto rise = [&](const models::InitialPort<double>& initial) {
    return HandFedCorner<double>(make_context_on(RigKind::kFlat), {effect}, initial)
        .state("driveline_warming.oil_rise");
  };
  CHECK(rise({}) == 0.0);
  CHECK(rise(warm()) == 1.0);
  CHECK(rise(rested(1.0)) == Approx(std::exp(-1.0)));
}

TEST_CASE("a surface warms to its rise with its time constant, and gives the tire that heat", "[fast]") {
  tests::DrumFixture fixture;
  HandFedCorner<double> at(make_context_on(RigKind::kDrum), {switch_on("surface_warming", {8.0, 20.0})});
  CHECK(at.evaluate().boundary.surface_K == 298.15);
  at.advance(1200.0);
  CHECK(at.state("surface_warming.surface_rise_dK") == Approx(8.0 * (1.0 - std::exp(-1.0))).epsilon(1e-6));
  at.advance(20.0 * 3600.0, 4000);
  CHECK(at.now.boundary.surface_K == Approx(298.15 + 8.0).epsilon(1e-9));
  const auto& thermal = at.corner.context().tire.thermal;
  const double cold_to_road_W =
      thermal.road_share_of_z * thermal.z_W_per_K * (at.temperature_K(Node::kRubber) - 298.15);
  CHECK(cold_to_road_W - at.now.heat.to_road_W == Approx(8.0 * thermal.road_share_of_z * thermal.z_W_per_K));
}

TEST_CASE("a surface warms more under more load and speed, and cools at rest", "[fast]") {
  const auto settled = [](double speed_m_s, double load_N) {
    HandFedCorner<double> at(make_context_on(RigKind::kDyno), {switch_on("surface_warming", {8.0})}, warm());
    at.inputs.speed_m_s = speed_m_s;
    at.inputs.load_N = load_N;
    at.advance(20.0 * 3600.0, 4000);
    return at.state("surface_warming.surface_rise_dK");
  };
  CHECK(settled(k80_m_s, 5400.0) == Approx(8.0));
  CHECK(settled(30.0, 5400.0) > 8.0);
  CHECK(settled(k80_m_s, 200.0) < 2.0);
  CHECK(settled(0.0, 5400.0) == Approx(0.0).margin(1e-9));
}

TEST_CASE("a recorded surface and the road do not warm", "[fast]") {
  HandFedCorner<double> recorded(make_context_on(RigKind::kDrum), {switch_on("surface_warming")}, warm());
  recorded.inputs.surface_recorded = true;
  recorded.inputs.surface_K = 301.0;
  CHECK(recorded.evaluate().boundary.surface_K == 301.0);
  HandFedCorner<double> road(make_context_on(RigKind::kFlat), {switch_on("surface_warming")}, warm());
  CHECK(road.evaluate().boundary.surface_K == 298.15);
}
