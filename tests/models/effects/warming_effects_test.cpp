// Effects whose state is the warmth of bearings, oil or a surface: where it starts, how fast it moves, where it
// settles.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/models/effects/initial_ports.h"
#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::Node;
using tests::HandFedCorner;
using tests::k80_m_s;
using tests::make_context_on;
using tests::rested;
using tests::switch_on;
using tests::warm;

TEST_CASE("cold oil costs its whole force, warm oil exp(-k) of it, and the thicker it is the faster it warms",
          "[fast]") {
  const auto rise_after_30_min = [](double fall) {
    HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("driveline_warming", {12.0, 30.0, fall})});
    at.advance(1800.0);
    return at.state("driveline_warming.oil_rise");
  };
  CHECK(rise_after_30_min(0.0) == Approx(1.0 - std::exp(-1.0)).epsilon(1e-6));  // first order
  CHECK(rise_after_30_min(1.5) > rise_after_30_min(0.7));
  CHECK(rise_after_30_min(0.7) > rise_after_30_min(0.0));
  HandFedCorner<double> at(make_context_on(tests::kDyno),
                           {switch_on("driveline_warming", {12.0, 30.0, 1.5, 0.1, 0.0})});
  HandFedCorner<double> plain(make_context_on(tests::kDyno), {});
  const double baseline_N = plain.evaluate().parasitic_N;
  CHECK(at.evaluate().parasitic_N - baseline_N == Approx(12.0));
  CHECK(at.now.heating_force_N == plain.now.heating_force_N);
  at.advance(30.0 * 3600.0, 4000);
  CHECK(at.now.parasitic_N - baseline_N == Approx(12.0 * std::exp(-1.5)).epsilon(1e-6));
  at.inputs.speed_m_s = 0.0;
  at.advance(1800.0);
  CHECK(at.state("driveline_warming.oil_rise") == Approx(std::exp(-1.0)).epsilon(1e-6));
}

TEST_CASE("of cold oil's force seals and gears keep their share", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDyno),
                           {switch_on("driveline_warming", {12.0, 30.0, 8.0, 0.1, 0.25})});
  HandFedCorner<double> plain(make_context_on(tests::kDyno), {});
  CHECK(at.evaluate().parasitic_N - plain.evaluate().parasitic_N == Approx(12.0));
  at.advance(30.0 * 3600.0, 4000);
  CHECK(at.now.parasitic_N - plain.now.parasitic_N == Approx(3.0).epsilon(0.01));
}

TEST_CASE("bearings in steady running at 80 km/h come to their rise, the sooner the harder they turn, and cool at rest",
          "[fast]") {
  const auto run_for = [](double fall_per_K, double duration_s) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("bearing_warmup", {fall_per_K, 30.0, 15.0})});
    at.advance(duration_s, 4000);
    return at;
  };
  CHECK(run_for(0.0, 1800.0).state("bearing_warmup.bearing_rise_dK") ==
        Approx(15.0 * (1.0 - std::exp(-1.0))).epsilon(1e-6));  // friction that does not fall: first order
  CHECK(run_for(0.03, 1800.0).state("bearing_warmup.bearing_rise_dK") >
        run_for(0.01, 1800.0).state("bearing_warmup.bearing_rise_dK"));
  HandFedCorner<double> at = run_for(0.03, 12.0 * 3600.0);
  CHECK(at.state("bearing_warmup.bearing_rise_dK") == Approx(15.0).epsilon(1e-6));
  at.inputs.speed_m_s = 0.0;
  at.advance(1800.0);
  const double left = at.state("bearing_warmup.bearing_rise_dK") / 15.0;
  CHECK(left > std::exp(-1.0));  // air that nothing moves
  CHECK(left < 1.0);
}

TEST_CASE("grease that is thin leaves the drum its air drag, or a share of it", "[fast]") {
  for (const double quadratic_share : {0.0, 0.5, 1.0}) {
    HandFedCorner<double> at(make_context_on(tests::kDrum),
                             {switch_on("bearing_warmup", {0.2, 30.0, 0.1, 1.0, quadratic_share})});
    at.inputs.ambient_K = 298.15 + 200.0;
    const double air_drag_N = tests::make_uneven_drum().parasitic.c2_N_s2_per_m2 * k80_m_s * k80_m_s;
    CHECK(at.evaluate().parasitic_N == Approx((1.0 - quadratic_share) * air_drag_N).margin(1e-9));
  }
}

TEST_CASE("bearings are cold after a soak, warm right after a run, and between them after a rest", "[fast]") {
  const auto effect = switch_on("bearing_warmup", {0.02, 30.0, 15.0});
  const auto rise_dK = [&](const models::InitialPort<double>& initial) {
    return HandFedCorner<double>(make_context_on(tests::kDrum), {effect}, initial)
        .state("bearing_warmup.bearing_rise_dK");
  };
  CHECK(rise_dK({}) == 0.0);
  CHECK(rise_dK(warm()) == Approx(15.0));
  CHECK(rise_dK(rested(0.5)) == Approx(15.0 * std::exp(-1.0)));
}

TEST_CASE("bearings in the cold turn as hard as by as many degrees less of their own warmth, oil by its share of them",
          "[fast]") {
  const auto find_N = [](const models::ActiveEffect& effect, double ambient_K) {
    HandFedCorner<double> at(make_context_on(tests::kDyno), {effect});
    HandFedCorner<double> plain(make_context_on(tests::kDyno), {});
    at.inputs.ambient_K = plain.inputs.ambient_K = ambient_K;
    return std::pair{at.evaluate().parasitic_N, plain.evaluate().parasitic_N};
  };
  const auto bearing = switch_on("bearing_warmup", {0.02, 30.0, 15.0, 1.0, 1.0});
  CHECK(find_N(bearing, 298.15 + 15.0).first == Approx(find_N(bearing, 298.15).second));
  CHECK(find_N(bearing, 298.15 - 20.0).first / find_N(bearing, 298.15).first == Approx(std::exp(0.4)));
  const auto oil = switch_on("driveline_warming", {12.0, 30.0, 1.5, 0.5, 0.0});
  const auto of_oil_N = [&](double ambient_K) {
    const auto [with_N, without_N] = find_N(oil, ambient_K);
    return with_N - without_N;
  };
  CHECK(of_oil_N(298.15) == Approx(12.0));
  CHECK(of_oil_N(298.15 - 20.0) / 12.0 == Approx(std::exp(1.5 * 0.5 * 20.0 / 30.0)));
  CHECK(find_N(switch_on("driveline_warming", {12.0, 30.0, 1.5, 0.0, 0.0}), 270.0).first ==
        Approx(find_N(oil, 298.15).first));
}

TEST_CASE("oil is cold after a soak, warm right after a run, and between them after a rest", "[fast]") {
  const auto effect = switch_on("driveline_warming", {12.0, 60.0});
  const auto rise = [&](const models::InitialPort<double>& initial) {
    return HandFedCorner<double>(make_context_on(tests::kRoad), {effect}, initial).state("driveline_warming.oil_rise");
  };
  CHECK(rise({}) == 0.0);
  CHECK(rise(warm()) == 1.0);
  CHECK(rise(rested(1.0)) == Approx(std::exp(-1.0)));
}

TEST_CASE("a surface warms to its rise with its time constant, and gives the tire that heat", "[fast]") {
  tests::DrumFixture fixture;
  HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("surface_warming", {8.0, 20.0})});
  CHECK(at.evaluate().boundary.surface_K == 298.15);
  at.advance(1200.0);
  CHECK(at.state("surface_warming.surface_rise_dK") == Approx(8.0 * (1.0 - std::exp(-1.0))).epsilon(1e-6));
  at.advance(20.0 * 3600.0, 4000);
  CHECK(at.now.boundary.surface_K == Approx(298.15 + 8.0).epsilon(1e-9));
  const auto& thermal = at.corner.context().tire.thermal;
  const double road_W_per_K =
      thermal.road_share_of_rest_conductance * thermal.rest_conductance_W_per_K +
      thermal.road_share_of_speed_conductance * thermal.speed_conductance_W_s_per_m_K * at.inputs.speed_m_s;
  const double cold_to_road_W = road_W_per_K * (at.temperature_K(Node::kLiner) - 298.15);
  CHECK(cold_to_road_W - at.now.heat.to_road_W == Approx(8.0 * road_W_per_K));
}

TEST_CASE("a surface warms more under more load and speed, and cools at rest", "[fast]") {
  const auto settled = [](double speed_m_s, double load_N) {
    HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("surface_warming", {8.0})}, warm());
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

TEST_CASE("bearings never drive the rig, however thin their grease is said to be", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("bearing_warmup", {0.2, 30.0, 0.1, 1.0, 2.0})});
  at.inputs.ambient_K = 298.15 + 100.0;
  at.inputs.speed_m_s = 40.0;
  CHECK(at.evaluate().parasitic_N >= 0.0);
}

TEST_CASE("the skin of a surface warms before its body, to the same rise", "[fast]") {
  const auto warmed_dK = [](double skin_share, double duration_s) {
    HandFedCorner<double> at(make_context_on(tests::kDrum),
                             {switch_on("surface_warming", {8.0, 20.0, 0.7, skin_share})});
    at.advance(duration_s, 4000);
    return at.now.boundary.surface_K - 298.15;
  };
  CHECK(warmed_dK(0.3, 240.0) > 1.5 * warmed_dK(0.0, 240.0));
  CHECK(warmed_dK(0.3, 20.0 * 3600.0) == Approx(8.0));
  CHECK(warmed_dK(1.0, 240.0) == Approx(8.0 * (1.0 - std::exp(-1.0))).epsilon(1e-6));
}

TEST_CASE("a recorded surface and the road do not warm", "[fast]") {
  HandFedCorner<double> recorded(make_context_on(tests::kDrum), {switch_on("surface_warming")}, warm());
  recorded.inputs.surface_recorded = true;
  recorded.inputs.surface_K = 301.0;
  CHECK(recorded.evaluate().boundary.surface_K == 301.0);
  HandFedCorner<double> road(make_context_on(tests::kRoad), {switch_on("surface_warming")}, warm());
  CHECK(road.evaluate().boundary.surface_K == 298.15);
}
