// The FMU in model exchange, whose solver is the importer's; derivatives; what drive force does.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/fmu/importer.h"

using rollrig::tests::Fmi2;
using rollrig::tests::LoadedFmu;

namespace {

using Vector = std::vector<double>;

void enter_continuous(Fmi2& tire) {
  tire.initialize();
  fmi2EventInfo info;
  REQUIRE(FMI2(tire.fmu, fmi2NewDiscreteStates)(tire.component, &info) == fmi2OK);
  CHECK(info.newDiscreteStatesNeeded == fmi2False);
  CHECK(info.nextEventTimeDefined == fmi2False);
  REQUIRE(FMI2(tire.fmu, fmi2EnterContinuousTimeMode)(tire.component) == fmi2OK);
}

Vector find_rates(Fmi2& tire, double time_s, const Vector& states) {
  Vector rates(states.size());
  REQUIRE(FMI2(tire.fmu, fmi2SetTime)(tire.component, time_s) == fmi2OK);
  REQUIRE(FMI2(tire.fmu, fmi2SetContinuousStates)(tire.component, states.data(), states.size()) == fmi2OK);
  REQUIRE(FMI2(tire.fmu, fmi2GetDerivatives)(tire.component, rates.data(), rates.size()) == fmi2OK);
  return rates;
}

/// A step of the classical Runge-Kutta rule, by the importer.
Vector step_on(Fmi2& tire, double time_s, double step_s, const Vector& states) {
  const auto add = [](const Vector& to, double factor, const Vector& rates) {
    Vector sum(to);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * rates[i];
    return sum;
  };
  const Vector k1 = find_rates(tire, time_s, states);
  const Vector k2 = find_rates(tire, time_s + 0.5 * step_s, add(states, 0.5 * step_s, k1));
  const Vector k3 = find_rates(tire, time_s + 0.5 * step_s, add(states, 0.5 * step_s, k2));
  const Vector k4 = find_rates(tire, time_s + step_s, add(states, step_s, k3));
  Vector next = add(states, step_s / 6.0, k1);
  next = add(next, step_s / 3.0, k2);
  next = add(next, step_s / 3.0, k3);
  return add(next, step_s / 6.0, k4);
}

}  // namespace

TEST_CASE("model exchange integrated by the importer is co-simulation", "[fast]") {
  const LoadedFmu fmu("a50", "drum_2m");
  Fmi2 slave(fmu, fmi2CoSimulation);
  slave.initialize();
  Fmi2 model(fmu, fmi2ModelExchange);
  enter_continuous(model);
  Vector states(fmu.description().count_states());
  REQUIRE(FMI2(fmu, fmi2GetContinuousStates)(model.component, states.data(), states.size()) == fmi2OK);
  for (int i = 0; i < 600; ++i) {
    const double speed_m_s = 20.0 + 10.0 * std::sin(0.05 * i);
    slave.set("speed_m_s", speed_m_s);
    model.set("speed_m_s", speed_m_s);
    slave.step(i, 1.0);
    states = step_on(model, i, 1.0, states);
  }
  find_rates(model, 600.0, states);
  for (const char* name : {"liner_temperature_K", "gas_temperature_K", "tire_loss_J", "cavity_pressure_Pa"}) {
    INFO(name);
    CHECK(model.get(name) == Approx(slave.get(name)).epsilon(1e-12));
  }
  CHECK(slave.get("liner_temperature_K") > 300.0);
  fmi2Boolean event = fmi2True;
  fmi2Boolean end = fmi2True;
  CHECK(FMI2(fmu, fmi2CompletedIntegratorStep)(model.component, fmi2True, &event, &end) == fmi2OK);
  CHECK(event == fmi2False);
  CHECK(end == fmi2False);
}

TEST_CASE("directional derivatives are the slopes of differences", "[fast]") {
  const LoadedFmu fmu("a50", "dyno_1m2", 2, {"slip_loss"});
  Fmi2 tire(fmu, fmi2CoSimulation);
  tire.initialize();
  tire.set("speed_m_s", 30.0);
  tire.set("drive_force_N", 500.0);
  tire.step(0.0, 300.0);
  const std::vector<unsigned> outputs = fmu.description().list("output");
  const auto read = [&] {
    Vector values(outputs.size());
    REQUIRE(FMI2(fmu, fmi2GetReal)(tire.component, outputs.data(), outputs.size(), values.data()) == fmi2OK);
    return values;
  };
  for (const char* input : {"speed_m_s", "load_N", "ambient_temperature_K", "surface_temperature_K", "drive_force_N",
                            "acceleration_m_s2"}) {
    const unsigned known = fmu.description().find(input);
    const double one = 1.0;
    Vector derivatives(outputs.size());
    REQUIRE(FMI2(fmu, fmi2GetDirectionalDerivative)(tire.component, outputs.data(), outputs.size(), &known, 1, &one,
                                                    derivatives.data()) == fmi2OK);
    const double at = tire.get(input);
    const double step = 1e-4 * std::max(1.0, std::abs(at));
    tire.set(input, at + step);
    const Vector above = read();
    tire.set(input, at - step);
    const Vector below = read();
    tire.set(input, at);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      INFO(input << ", output " << outputs[i]);
      const double slope = (above[i] - below[i]) / (2.0 * step);
      const double rounding = 1e-15 * std::abs(above[i]) / step * 10.0;
      CHECK(derivatives[i] == Approx(slope).epsilon(1e-5).margin(1e-9 + 100.0 * rounding));
    }
  }
}

TEST_CASE("derivatives by states are the slopes of the rates", "[fast]") {
  const LoadedFmu fmu("a50", "road");
  Fmi2 tire(fmu, fmi2ModelExchange);
  enter_continuous(tire);
  tire.set("speed_m_s", 25.0);
  Vector states(fmu.description().count_states());
  REQUIRE(FMI2(fmu, fmi2GetContinuousStates)(tire.component, states.data(), states.size()) == fmi2OK);
  states[0] += 20.0;
  find_rates(tire, 0.0, states);
  const unsigned known = fmu.description().find("liner_temperature_K");
  const unsigned unknown = fmu.description().find("der(liner_temperature_K)");
  const double two = 2.0;
  double derivative = 0.0;
  REQUIRE(FMI2(fmu, fmi2GetDirectionalDerivative)(tire.component, &unknown, 1, &known, 1, &two, &derivative) == fmi2OK);
  const double step_K = 1e-3;
  Vector moved = states;
  moved[0] += step_K;
  const double above = find_rates(tire, 0.0, moved)[0];
  moved[0] -= 2.0 * step_K;
  CHECK(derivative == Approx(two * (above - find_rates(tire, 0.0, moved)[0]) / (2.0 * step_K)).epsilon(1e-6));
  CHECK(derivative < 0.0);  // a warmer tire cools faster
}

TEST_CASE("all of the loss of a tire becomes heat, and a driven wheel pulls at the surface", "[fast]") {
  const LoadedFmu fmu("a50", "road");
  Fmi2 tire(fmu, fmi2CoSimulation);
  tire.initialize();
  tire.set("speed_m_s", 25.0);
  tire.set("drive_force_N", 300.0);
  tire.step(0.0, 60.0);
  CHECK(tire.get("heat_generated_W") == Approx(25.0 * tire.get("rolling_resistance_N")).epsilon(1e-12));
  // On the flat road, resistance brakes the wheel alone.
  CHECK(tire.get("contact_force_N") == Approx(300.0 - tire.get("rolling_resistance_N")).epsilon(1e-12));
  tire.set("acceleration_m_s2", 1.0);
  const double radius_m =
      0.5 * tire.get("geometry.outer_diameter_m") - tire.get("load_N") / tire.get("stiffness.vertical_N_per_m");
  const double spin_N = tire.get("geometry.spin_inertia_kg_m2") / (radius_m * radius_m);
  CHECK(tire.get("contact_force_N") == Approx(300.0 - tire.get("rolling_resistance_N") - spin_N).epsilon(1e-12));
}
