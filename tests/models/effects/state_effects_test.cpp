// Effects with a state of their own: where it starts, how fast it moves, where it settles.
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

TEST_CASE("a flat spot rolls out over distance, whatever the speed", "[fast]") {
  for (const double speed_m_s : {5.0, 20.0, 36.0}) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("flat_spot", {5.0, 8.0})});
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
  const auto context = make_context_on(tests::kRoad);
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
  HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("brake_drag", {8.0, 2.0, 1e4, 0.0})});
  HandFedCorner<double> plain(make_context_on(tests::kDyno), {});
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

TEST_CASE("drag that the disc pushes back is worn off by distance, and stays at standstill", "[fast]") {
  const auto left_after = [](double speed_m_s, double duration_s) {
    HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("brake_drag", {8.0, 2.0, 1e4, 1.0})});
    at.inputs.brake_force_N = 3000.0;
    at.advance(30.0);
    const double set = at.state("brake_drag.dragging");
    at.inputs.brake_force_N = 0.0;
    at.inputs.speed_m_s = speed_m_s;
    at.advance(duration_s);
    return at.state("brake_drag.dragging") / set;
  };
  CHECK(left_after(10.0, 100.0) == Approx(left_after(20.0, 50.0)).epsilon(2e-3));
  CHECK(left_after(40.0 / 3.6, 120.0) == Approx(std::exp(-1.0)).epsilon(2e-3));
  CHECK(left_after(0.0, 120.0) > 0.95);
}

TEST_CASE("light and short braking sets less drag than strong and long", "[fast]") {
  const auto set_by = [](double brake_N, double duration_s) {
    HandFedCorner<double> at(make_context_on(tests::kDyno), {switch_on("brake_drag")});
    at.inputs.brake_force_N = brake_N;
    at.advance(duration_s);
    return at.state("brake_drag.dragging");
  };
  CHECK(set_by(50.0, 3.0) < set_by(2000.0, 3.0));
  CHECK(set_by(2000.0, 3.0) < set_by(2000.0, 10.0));
  CHECK(set_by(0.0, 10.0) == 0.0);
}

TEST_CASE("rubber's memory fades in minutes of loaded rolling, whatever the speed", "[fast]") {
  for (const double speed_m_s : {5.0, 20.0, 36.0}) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("rubber_memory", {5.0, 8.0, 1e9})});
    CHECK(at.state("rubber_memory.memory") == 1.0);
    at.inputs.speed_m_s = speed_m_s;
    at.inputs.load_N = 1e6;  // far above where a load works the rubber
    CHECK(at.evaluate().loss.factor == Approx(1.05));
    at.advance(8.0 * 60.0);
    CHECK(at.state("rubber_memory.memory") == Approx(std::exp(-1.0)).epsilon(1e-4));
    CHECK(at.now.loss.factor == Approx(1.0 + 0.05 * std::exp(-1.0)).epsilon(1e-4));
  }
}

TEST_CASE("rubber's memory comes back at rest under any load, and unloaded at any speed", "[fast]") {
  const auto effect = switch_on("rubber_memory", {5.0, 8.0, 20.0});
  const auto after_20_min = [&](double speed_m_s, double load_N) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), {effect}, warm());
    CHECK(at.evaluate().loss.factor == 1.0);
    at.inputs.speed_m_s = speed_m_s;
    at.inputs.load_N = load_N;
    at.advance(1200.0);
    return at.state("rubber_memory.memory");
  };
  const double all_the_time = 1.0 - std::exp(-1.0);
  CHECK(after_20_min(0.0, 5400.0) == Approx(all_the_time).epsilon(1e-6));
  CHECK(after_20_min(0.0, 0.0) == Approx(all_the_time).epsilon(1e-6));
  CHECK(after_20_min(k80_m_s, 0.0) == Approx(all_the_time).epsilon(1e-6));
  const double in_skim = after_20_min(k80_m_s, 200.0);
  CHECK(in_skim < all_the_time);
  CHECK(in_skim > 0.8 * all_the_time);
  CHECK(after_20_min(k80_m_s, 5400.0) < 0.05 * all_the_time);
}

TEST_CASE("after each skim the tire loses more for a while", "[fast]") {
  tests::DrumFixture fixture;
  fixture.effects = {switch_on("rubber_memory", {6.0, 5.0, 10.0})};
  sim::Program program;
  for (int cycle = 0; cycle < 4; ++cycle) {
    program.phases.push_back(tests::rolling("load", 1800.0, k80_m_s, 5400.0));
    program.phases.push_back(tests::rolling("skim", 600.0, k80_m_s, 200.0));
  }
  const auto recording = fixture.run_quasi_static(program);
  const auto& memory = recording.channel("rubber_memory.memory");
  for (const std::size_t start_s : {2400u, 4800u, 7200u}) {
    CHECK(memory[start_s + 1] > 0.5);
    CHECK(memory[start_s + 300] < 0.5 * memory[start_s + 1]);
    CHECK(memory[start_s + 1790] < 0.05);
  }
}

TEST_CASE("rubber's memory starts from the rest before the run", "[fast]") {
  const auto effect = switch_on("rubber_memory", {5.0, 8.0, 30.0});
  const auto starts_at = [&](const models::InitialPort<double>& initial) {
    return HandFedCorner<double>(make_context_on(tests::kRoad), {effect}, initial).state("rubber_memory.memory");
  };
  CHECK(starts_at({}) == 1.0);
  CHECK(starts_at(warm()) == 0.0);
  CHECK(starts_at(rested(0.0)) == 0.0);
  CHECK(starts_at(rested(0.5)) == Approx(1.0 - std::exp(-1.0)));
  CHECK(starts_at(rested(1000.0)) == Approx(1.0));
}

TEST_CASE("a slow leak takes its rate off the pressure at the temperature at which it was set", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("slow_leak", {3.0, 0.0})});
  at.inputs.speed_m_s = 0.0;  // at ambient temperature
  CHECK(at.evaluate().pressure_Pa == Approx(280e3).epsilon(1e-14));
  at.advance(2.0 * 3600.0);
  CHECK(280e3 - at.now.pressure_Pa == Approx(6e3).epsilon(1e-9));
  at.advance(2.0 * 3600.0);
  CHECK(280e3 - at.now.pressure_Pa == Approx(12e3).epsilon(1e-9));
  // what is left, heated, is at the same share less of the absolute pressure
  const double warm_K = 320.0;
  HandFedCorner<double> tight(make_context_on(tests::kDrum), {});
  at.temperature_K(Node::kGas) = tight.temperature_K(Node::kGas) = warm_K;
  const double p_amb_Pa = 101325.0;
  CHECK((at.evaluate().pressure_Pa + p_amb_Pa) / (tight.evaluate().pressure_Pa + p_amb_Pa) ==
        Approx((268e3 + p_amb_Pa) / (280e3 + p_amb_Pa)).epsilon(1e-9));
}

TEST_CASE("gas that goes through the rubber goes faster while it is warm, at its rate at 40 degC", "[fast]") {
  const auto lost_at = [](double liner_K, double growth_per_K) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("slow_leak", {3.0, growth_per_K})});
    at.temperature_K(Node::kLiner) = liner_K;
    at.evaluate();
    at.advance(1.0, 1);
    return at.state("slow_leak.gas_lost");
  };
  CHECK(lost_at(313.15, 0.03) == Approx(lost_at(313.15, 0.0)).epsilon(1e-3));
  CHECK(lost_at(333.15, 0.03) / lost_at(313.15, 0.03) == Approx(std::exp(0.6)).epsilon(1e-3));
  CHECK(lost_at(293.15, 0.03) < lost_at(313.15, 0.03));
}

TEST_CASE("a leaking tire loses more, is full again when filled, and never falls below the ambient", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("slow_leak", {20.0, 0.0})});
  HandFedCorner<double> tight(make_context_on(tests::kDrum), {});
  for (auto* one : {&at, &tight}) one->advance(4.0 * 3600.0, 2000);
  CHECK(at.now.rolling_resistance_N > 1.02 * tight.now.rolling_resistance_N);
  at.corner.inflate(280e3, at.x.data(), at.now.inflation);
  CHECK(at.state("slow_leak.gas_lost") == 0.0);
  CHECK(at.evaluate().pressure_Pa == Approx(280e3));
  at.inputs.speed_m_s = 0.0;
  at.advance(100.0 * 3600.0, 20000);
  CHECK(at.now.pressure_Pa > 0.0);
  CHECK(at.now.pressure_Pa < 1e3);
}

TEST_CASE("a tire that follows its temperature: the coefficient holds warm at 80 km/h and 25 degC", "[fast]") {
  models::Context<double> context = make_context_on(tests::kRoad);
  context.tire.own = tests::make_own(models::kConstantModel);
  context.tire.constant.rrc = 0.008;
  const double load_N = context.tire.rolling_resistance.reference_load_N;
  const double fall_per_K = 0.015;
  const double warm_up_min = 12.0;
  const double rise_K = 25.0;
  const auto effect = switch_on("tire_temperature", {fall_per_K, warm_up_min, rise_K});
  const auto begin = [&](double temperature_K, const models::InitialPort<double>& initial) {
    HandFedCorner<double> at(context, {effect}, initial, temperature_K);
    at.inputs.load_N = load_N;
    at.inputs.ambient_K = temperature_K;
    return at;
  };
  SECTION("warm at 80 km/h it is the coefficient, and stays there") {
    HandFedCorner<double> at = begin(298.15, warm());
    CHECK(at.evaluate().rolling_resistance_N == Approx(0.008 * load_N));
    at.advance(3600.0);
    CHECK(at.now.rolling_resistance_N == Approx(0.008 * load_N));
  }
  SECTION("cold it is more by exp(B D), and warms to there") {
    HandFedCorner<double> at = begin(298.15, {});
    CHECK(at.evaluate().loss.factor == Approx(std::exp(fall_per_K * rise_K)));
    at.advance(10.0 * warm_up_min * 60.0);
    CHECK(at.now.loss.factor == Approx(1.0).epsilon(1e-3));
  }
  SECTION("in colder air more, though the tire makes up for a part by its own heat") {
    HandFedCorner<double> at = begin(278.15, warm());
    at.advance(7200.0);
    CHECK(at.now.loss.factor > 1.05);
    CHECK(at.now.loss.factor < std::exp(fall_per_K * 20.0));
  }
  SECTION("slower it stays colder, faster it gets warmer") {
    std::vector<double> temperatures_K;
    for (const double km_h : {0.0, 30.0, 80.0, 130.0}) {
      HandFedCorner<double> at = begin(298.15, warm());
      at.inputs.speed_m_s = km_h / 3.6;
      at.advance(km_h == 0.0 ? 36000.0 : 7200.0);  // standing air takes its time
      temperatures_K.push_back(at.state("tire_temperature.tire_temperature_degC"));
    }
    CHECK(temperatures_K[0] == Approx(298.15).margin(0.2));
    for (std::size_t i = 1; i < temperatures_K.size(); ++i) CHECK(temperatures_K[i] > temperatures_K[i - 1] + 1.0);
  }
  SECTION("a coefficient that holds on a warmer tire is less than the loss of this one") {
    const auto shifted = switch_on("tire_temperature", {fall_per_K, warm_up_min, rise_K, 6.0});
    HandFedCorner<double> at(context, {shifted}, {}, 298.15 + rise_K + 6.0);
    CHECK(at.evaluate().loss.factor == Approx(1.0));
    HandFedCorner<double> colder(context, {shifted}, {}, 298.15 + rise_K);
    CHECK(colder.evaluate().loss.factor == Approx(std::exp(fall_per_K * 6.0)));
  }
  SECTION("begins at the temperature that the run gives") {
    CHECK(begin(320.0, {}).state("tire_temperature.tire_temperature_degC") == 320.0);
  }
}
