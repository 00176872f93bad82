// Effects of which the record differs from what acts: speed, load, pressure, and the scale of torque.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <tuple>

#include "tests/support/trace_port.h"

using namespace rollrig;
using tests::apply_trace;
using tests::HandFedCorner;
using tests::make_context_on;
using tests::NamedChannel;
using tests::run_trace;
using tests::switch_on;

namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

/// The load that acts on a tire of 5400 N reference load.
double find_acting_N(const models::ActiveEffect& effect, double recorded_N, tests::Machine kind = tests::kDrum) {
  HandFedCorner<double> at(make_context_on(kind), {effect});
  at.inputs.load_N = recorded_N;
  return at.evaluate().acting.load_N;
}

}  // namespace

TEST_CASE("a wrong speed record turns the tire faster than it says, and the record stays", "[fast]") {
  for (const tests::Machine kind : rigs::machine_kinds()) {
    HandFedCorner<double> wrong(make_context_on(kind), {switch_on("speed_record", {5.0, 0.0, 0.0})});
    HandFedCorner<double> right(make_context_on(kind), {});
    wrong.inputs.speed_m_s = 20.0;
    wrong.inputs.acceleration_m_s2 = 0.4;
    right.inputs.speed_m_s = 21.0;
    wrong.advance(900.0);
    right.advance(900.0);
    CHECK(wrong.now.recorded.speed_m_s == 20.0);
    CHECK(wrong.now.acting.acceleration_m_s2 == Approx(0.42));
    CHECK(wrong.now.rolling_resistance_N == Approx(right.now.rolling_resistance_N));
    CHECK(wrong.now.parasitic_N == Approx(right.now.parasitic_N));
    CHECK(wrong.temperature_K(models::Node::kLiner) == Approx(right.temperature_K(models::Node::kLiner)));
    CHECK(wrong.now.heat.heat_in_W == Approx(wrong.now.rolling_resistance_N * 21.0));
  }
}

TEST_CASE("an error of the speed is its size at 80 km/h, grows or falls with speed, and the acceleration is its own",
          "[fast]") {
  const double v_m_s = 80.0 / 3.6;
  for (const auto& [growing, fixed, rises] : {std::tuple{0.4, 0.0, 1.0}, std::tuple{0.0, 0.4, -1.0}}) {
    const auto at_speed = [growing = growing, fixed = fixed](double speed_m_s) {
      HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("speed_record", {5.0, growing, fixed})});
      at.inputs.speed_m_s = speed_m_s;
      at.inputs.acceleration_m_s2 = 0.5;
      at.evaluate();
      return std::pair{at.now.acting.speed_m_s, at.now.acting.acceleration_m_s2};
    };
    const auto error = [&](double speed_m_s) { return at_speed(speed_m_s).first / speed_m_s - 1.0; };
    CHECK(error(v_m_s) == Approx(0.05));
    CHECK((error(1.4 * v_m_s) - error(0.5 * v_m_s)) * rises > 0.0);
    for (const double share : {0.02, 0.3, 1.0, 1.6}) {
      const double h_s = 1e-4;
      const double later_m_s = at_speed(share * v_m_s + 0.5 * h_s).first;
      const double sooner_m_s = at_speed(share * v_m_s - 0.5 * h_s).first;
      CHECK(at_speed(share * v_m_s).second == Approx((later_m_s - sooner_m_s) / (2.0 * h_s)).epsilon(1e-6));
    }
    CHECK(at_speed(0.0).first == 0.0);
  }
}

TEST_CASE("no error of the speed turns the surface the other way round", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kRoad), {switch_on("speed_record", {-50.0, 0.0, 1.0})});
  for (const double speed_m_s : {0.01, 0.3, 3.0, 30.0}) {
    at.inputs.speed_m_s = speed_m_s;
    CHECK(at.evaluate().acting.speed_m_s > 0.0);
  }
}

TEST_CASE("a fixed speed beside the scale is as many km/h at every speed but at rest", "[fast]") {
  const auto off_m_s = [](double speed_m_s) {
    HandFedCorner<double> at(make_context_on(tests::kDrum), {switch_on("speed_record", {5.0, 0.0, 1.0})});
    at.inputs.speed_m_s = speed_m_s;
    return at.evaluate().acting.speed_m_s - speed_m_s;
  };
  CHECK(off_m_s(30.0) == Approx(4.0 / 3.6).epsilon(6e-3));
  CHECK(off_m_s(10.0) == Approx(4.0 / 3.6).epsilon(0.045));
  CHECK(off_m_s(0.1) < 0.2);
}

TEST_CASE("a wrong load record is a scale, an offset, or some of both, and the error at the reference load is the size",
          "[fast]") {
  for (const double offset_share : {0.0, 0.3, 1.0}) {
    for (const double percent : {4.0, -4.0}) {
      const auto effect = switch_on("load_record", {percent, offset_share, 1.0});
      CHECK(find_acting_N(effect, 5400.0) == Approx(5400.0 * (1.0 + 0.01 * percent)));
      // a straight line in the recorded load
      const double slope = (find_acting_N(effect, 4000.0) - find_acting_N(effect, 2000.0)) / 2000.0;
      CHECK(slope == Approx(1.0 + 0.01 * percent * (1.0 - offset_share)));
    }
  }
  CHECK(find_acting_N(switch_on("load_record", {4.0, 1.0}), 200.0) == Approx(416.0));
  CHECK(find_acting_N(switch_on("load_record", {4.0, 0.0}), 200.0) == Approx(208.0));
}

TEST_CASE("a load cell that bends is off by its size at the reference load, and by another share elsewhere", "[fast]") {
  const auto share = [](double power, double recorded_N) {
    return find_acting_N(switch_on("load_record", {4.0, 0.0, power}), recorded_N) / recorded_N - 1.0;
  };
  for (const double power : {0.6, 1.8}) CHECK(share(power, 5400.0) == Approx(0.04));
  CHECK(share(1.8, 2700.0) < 0.04);
  CHECK(share(1.8, 6500.0) > 0.04);
  CHECK(share(0.6, 2700.0) > 0.04);
  CHECK(share(2.0, 2700.0) == Approx(0.02));
}

TEST_CASE("an error of the load record neither pulls at a tire nor puts down one that is lifted", "[fast]") {
  CHECK(find_acting_N(switch_on("load_record", {-5.0, 1.0}), 200.0) == 0.0);
  CHECK(find_acting_N(switch_on("load_record", {5.0, 1.0}), 0.0) == 0.0);
  CHECK(find_acting_N(switch_on("load_record", {5.0, 0.0}), 5000.0, tests::kRoad) == 5000.0);  // no record there
}

TEST_CASE("tie-downs add to the true load, not to the record", "[fast]") {
  HandFedCorner<double> at(make_context_on(tests::kDyno),
                           {switch_on("load_record", {2.0, 0.0}), switch_on("tie_down_load", {100.0})});
  at.inputs.load_N = 5000.0;
  CHECK(at.evaluate().acting.load_N == Approx(5200.0));
}

TEST_CASE("the pressure sensor's error is in its channel alone, the same at every row", "[fast]") {
  const auto effect = switch_on("pressure_record", {-8.0, 0.0, 0.0});
  const std::vector<double> values{250e3, kNan, 270e3};
  const auto shown = apply_trace(effect, {0.0, 1.0, 2.0}, {"cavity_pressure_kPa", values});
  CHECK(shown[0] == 242e3);
  CHECK(std::isnan(shown[1]));
  CHECK(shown[2] == 262e3);
  for (const char* other : {"drum_torque_Nm", "liner_temperature_degC"}) {
    CHECK(apply_trace(effect, {0.0, 1.0}, {other, {3.0, 4.0}}) == std::vector<double>{3.0, 4.0});
  }
}

TEST_CASE("the pressure sensor's zero shifts with the liner's temperature, from 25 degC", "[fast]") {
  const auto effect = switch_on("pressure_record", {-8.0, 0.05, 0.0});
  const auto context = make_context_on(tests::kDrum);
  models::TracePort<double> port;
  port.time_s = {0.0, 1.0};
  port.channels = {{models::quantities::kCavityPressure, {250e3, 250e3}},
                   {models::quantities::kLinerTemperature, {298.15, 318.15}}};
  run_trace(effect, context, port);
  CHECK((*port.find(models::quantities::kCavityPressure))[0] == Approx(242e3));
  CHECK((*port.find(models::quantities::kCavityPressure))[1] == Approx(243e3));
  CHECK((*port.find(models::quantities::kLinerTemperature))[1] == 318.15);
}

TEST_CASE("a pressure sensor of a wrong scale is off by a share, its size at the reference pressure", "[fast]") {
  const auto effect = switch_on("pressure_record", {14.0, 0.0, 1.0});
  const double reference_Pa = make_context_on(tests::kDrum).tire.rolling_resistance.reference_pressure_Pa;
  const auto shown =
      apply_trace(effect, {0.0, 1.0, 2.0}, {"cavity_pressure_kPa", {reference_Pa, 1.2 * reference_Pa, 0.0}});
  CHECK(shown[0] - reference_Pa == Approx(14e3));
  CHECK(shown[1] / (1.2 * reference_Pa) == Approx(shown[0] / reference_Pa));
  CHECK(shown[2] == 0.0);
}

TEST_CASE("a wrong pressure sensor does not change the pressure that the tire rolls on", "[fast]") {
  HandFedCorner<double> with(make_context_on(tests::kDrum), {switch_on("pressure_record", {15.0, 0.02, 0.5})});
  HandFedCorner<double> without(make_context_on(tests::kDrum), {});
  CHECK(with.evaluate().pressure_Pa == without.evaluate().pressure_Pa);
  CHECK(with.now.pressure_Pa == Approx(280e3));  // as the setting gauge said
  CHECK(with.now.rolling_resistance_N == without.now.rolling_resistance_N);
}

TEST_CASE("a scale of torque is on torque, loss force and traction force, in both directions of power", "[fast]") {
  const auto effect = switch_on("torque_gain", {2.5, 0.0});
  const std::vector<double> values{40.0, -20.0, 0.0};
  const std::vector<double> time_s{0.0, 1.0, 2.0};
  for (const auto& [name, kind] : std::vector<std::pair<std::string, tests::Machine>>{
           {"drum_torque_Nm", tests::kDrum}, {"loss_force_N", tests::kDyno}, {"traction_force_N", tests::kRoad}}) {
    const auto shown = apply_trace(effect, time_s, {name, values}, kind);
    CHECK(shown[0] == Approx(41.0));
    CHECK(shown[1] == Approx(-20.5));
    CHECK(shown[2] == 0.0);
  }
  CHECK(apply_trace(effect, time_s, {"liner_temperature_degC", values}) == values);
}

TEST_CASE("a torque meter that bends is off by its size at a force of 60 N, either way, and less at high force",
          "[fast]") {
  const auto effect = switch_on("torque_gain", {2.5, -0.3});
  const auto share = [&](const std::string& channel, double value, tests::Machine kind) {
    return apply_trace(effect, {0.0, 1.0}, {channel, {value, -value}}, kind)[1] / -value - 1.0;
  };
  const double radius_m = 1.0 / make_context_on(tests::kDrum).surface_curvature_per_m;
  CHECK(share("drum_torque_Nm", 60.0 * radius_m, tests::kDrum) == Approx(0.025));
  CHECK(share("loss_force_N", 60.0, tests::kDyno) == Approx(0.025));
  CHECK(share("traction_force_N", -600.0, tests::kRoad) == Approx(0.025));  // a motor's force, not a bridge's
  CHECK(share("loss_force_N", 600.0, tests::kDyno) < 0.015);
  CHECK(share("loss_force_N", 6.0, tests::kDyno) > 0.04);
}

TEST_CASE("load leaks into the torque by its angle, by the drum's radius, whatever the torque is", "[fast]") {
  const auto effect = switch_on("load_cross_talk", {0.4, 0.0});
  const std::vector<double> time_s{0.0, 1.0, 2.0};
  const NamedChannel load{"load_N", {5000.0, 5000.0, 5000.0}};
  constexpr double kTorque_Nm = 5000.0 * 0.4e-3 * 0.8535;  // load, angle, radius of the drum
  for (const double torque_Nm : {0.0, 60.0}) {
    const auto shown =
        apply_trace(effect, time_s, {"drum_torque_Nm", {torque_Nm, torque_Nm, torque_Nm}}, tests::kDrum, {load});
    CHECK(shown[1] - torque_Nm == Approx(kTorque_Nm));
  }
  const std::vector<double> zeros(3, 0.0);
  CHECK(apply_trace(effect, time_s, {"loss_force_N", zeros}, tests::kDyno, {load})[1] == Approx(2.0));
  CHECK(apply_trace(switch_on("load_cross_talk", {-0.4, 0.0}), time_s, {"drum_torque_Nm", zeros}, tests::kDrum,
                    {load})[1] == Approx(-kTorque_Nm));
  CHECK(apply_trace(effect, time_s, {"drum_torque_Nm", zeros}, tests::kDrum) == zeros);  // no load, no leak
}

TEST_CASE("an angle that grows as the frame bends is its size at the reference load, and less below it", "[fast]") {
  const auto share = [](double load_N) {
    const NamedChannel load{"load_N", {load_N, load_N}};
    return apply_trace(switch_on("load_cross_talk", {0.4, 0.5}), {0.0, 1.0}, {"loss_force_N", {0.0, 0.0}}, tests::kDyno,
                       {load})[1] /
           load_N;
  };
  CHECK(share(5400.0) == Approx(0.4e-3));
  CHECK(share(2700.0) == Approx(0.3e-3));
  CHECK(share(50.0) > 0.2e-3);
}

TEST_CASE("beside a step of the load a sample has the mean of what held before and after", "[fast]") {
  const auto effect = switch_on("load_cross_talk", {1.0, 0.0});
  const std::vector<double> time_s{0.0, 1.0, 4.0, 5.0};
  const NamedChannel load{"load_N", {1000.0, 1000.0, 3000.0, 3000.0}};  // steps at 4 s
  const auto shown = apply_trace(effect, time_s, {"drum_torque_Nm", std::vector<double>(4, 0.0)}, tests::kDrum, {load});
  const double sine = 0.8535 * std::sin(1e-3);  // by the radius of the drum, m
  CHECK(shown[0] == Approx(1000.0 * sine));
  CHECK(shown[1] == Approx(1000.0 * sine));
  CHECK(shown[2] == Approx((1.5 * 1000.0 + 0.5 * 3000.0) / 2.0 * sine));
  CHECK(shown[3] == Approx(3000.0 * sine));
}
