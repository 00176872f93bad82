#include "models/vehicle/vehicle.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace rollrig;
using models::blend_brakes;
using models::calc_air_density_kg_per_m3;
using models::calc_drag_N;
using models::calc_grade_N;

TEST_CASE("density of air at the conditions of the standards", "[fast]") {
  CHECK(calc_air_density_kg_per_m3(101325.0, 288.15) == Approx(1.225).margin(5e-5));  // ISO 2533
  CHECK(calc_air_density_kg_per_m3(98210.0, 293.15) == Approx(1.167).margin(5e-4));   // 40 CFR 1066.305
}

TEST_CASE("drag of a square meter is the dynamic pressure", "[fast]") {
  // 1.225 kg/m3 at 40 m/s: 980 Pa
  CHECK(calc_drag_N(1.225, 1.0, 40.0, 0.0) == Approx(980.0));
  CHECK(calc_drag_N(1.225, 1.0, 30.0, 10.0) == Approx(980.0));  // only the air's own speed counts
  CHECK(calc_drag_N(1.225, 1.0, 0.0, 40.0) == Approx(980.0));
}

TEST_CASE("drag turns with the air that comes, and vanishes in air that goes along", "[fast]") {
  CHECK(calc_drag_N(1.2, 0.7, 20.0, -20.0) == 0.0);
  CHECK(calc_drag_N(1.2, 0.7, -20.0, 0.0) == -calc_drag_N(1.2, 0.7, 20.0, 0.0));
  CHECK(calc_drag_N(1.2, 0.7, 10.0, -15.0) < 0.0);  // a tailwind that overtakes perturbations
  // headwind and tailwind alike cost more than still air: 2 w^2 in the mean
  const double mean_N = 0.5 * (calc_drag_N(1.2, 0.7, 30.0, 5.0) + calc_drag_N(1.2, 0.7, 30.0, -5.0));
  CHECK(mean_N / calc_drag_N(1.2, 0.7, 30.0, 0.0) == Approx(1.0 + 25.0 / 900.0));
}

TEST_CASE("gravity along a road: the slope where it is small, the whole weight on a wall", "[fast]") {
  const double weight_N = 2000.0 * kStandardGravity_m_s2;
  CHECK(calc_grade_N(2000.0, 0.0) == 0.0);
  CHECK(calc_grade_N(2000.0, 1e-4) == Approx(weight_N * 1e-4).epsilon(1e-7));
  CHECK(calc_grade_N(2000.0, 1.0) == Approx(weight_N * std::sin(M_PI / 4.0)));
  CHECK(calc_grade_N(2000.0, 1e6) == Approx(weight_N));
  CHECK(calc_grade_N(2000.0, -0.05) == -calc_grade_N(2000.0, 0.05));
}

TEST_CASE("motor and friction together do what is asked, each within its bounds", "[fast]") {
  constexpr double kLimit_N = 3000.0;
  constexpr double kFade_m_s = 10.0 / 3.6;
  for (double demand_N = -12000.0; demand_N <= 12000.0; demand_N += 500.0) {
    for (const double speed_m_s : {-1.0, 0.0, 0.3, 1.0, kFade_m_s, 5.0, 40.0}) {
      const auto shared = blend_brakes(demand_N, kLimit_N, speed_m_s, kFade_m_s);
      INFO(demand_N << " N at " << speed_m_s << " m/s");
      CHECK(shared.motor_N - shared.friction_N == Approx(demand_N).margin(1e-9));
      CHECK(shared.friction_N >= 0.0);
      CHECK(shared.motor_N >= -kLimit_N);
      if (demand_N >= 0.0) CHECK(shared.friction_N == 0.0);  // no brake against the motor
      if (demand_N < 0.0) CHECK(shared.motor_N <= 0.0);      // no motor against the brake
    }
  }
}

TEST_CASE("the motor brakes alone up to its limit, and not at all at standstill", "[fast]") {
  CHECK(blend_brakes(-2999.0, 3000.0, 20.0, 3.0).friction_N == 0.0);
  CHECK(blend_brakes(-5000.0, 3000.0, 20.0, 3.0).friction_N == 2000.0);
  CHECK(blend_brakes(-5000.0, 3000.0, 0.0, 3.0).motor_N == 0.0);
  CHECK(blend_brakes(-5000.0, 0.0, 20.0, 3.0).motor_N == 0.0);  // a car without recuperation
}

TEST_CASE("braking changes hands without a jump", "[fast]") {
  constexpr double kStep = 1e-9;
  const auto motor_N = [](double demand_N, double speed_m_s) {
    return blend_brakes(demand_N, 3000.0, speed_m_s, 3.0).motor_N;
  };
  CHECK(motor_N(-kStep, 20.0) == Approx(motor_N(kStep, 20.0)).margin(1e-6));
  CHECK(motor_N(-3000.0 - kStep, 20.0) == Approx(motor_N(-3000.0 + kStep, 20.0)).margin(1e-6));
  CHECK(motor_N(-5000.0, 3.0 - kStep) == Approx(motor_N(-5000.0, 3.0 + kStep)).margin(1e-5));
  CHECK(motor_N(-5000.0, kStep) == Approx(0.0).margin(1e-5));
}

TEST_CASE("recuperation over a stop is the integral of its faded limit", "[fast]") {
  // From v0 to rest at a deceleration a, limit L, fading below v_f: L/a ((v0^2 - v_f^2)/2 + v_f^2/3)
  constexpr double kStart_m_s = 20.0, kFade_m_s = 3.0, kLimit_N = 3000.0, kDeceleration_m_s2 = 4.0;
  constexpr double kDemand_N = -2000.0 * kDeceleration_m_s2;
  const int steps = 200000;
  const double step_s = kStart_m_s / kDeceleration_m_s2 / steps;
  double motor_J = 0.0;
  double friction_J = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double speed_m_s = kStart_m_s - kDeceleration_m_s2 * (i + 0.5) * step_s;
    const auto shared = blend_brakes(kDemand_N, kLimit_N, speed_m_s, kFade_m_s);
    motor_J -= shared.motor_N * speed_m_s * step_s;
    friction_J += shared.friction_N * speed_m_s * step_s;
  }
  const double faded_m2_s2 = (kStart_m_s * kStart_m_s - kFade_m_s * kFade_m_s) / 2.0 + kFade_m_s * kFade_m_s / 3.0;
  CHECK(motor_J == Approx(kLimit_N / kDeceleration_m_s2 * faded_m2_s2).epsilon(1e-6));
  CHECK(motor_J + friction_J == Approx(0.5 * 2000.0 * kStart_m_s * kStart_m_s).epsilon(1e-6));
}

TEST_CASE("the vehicle's forces are forces", "[fast]") {
  using Q = DimensionedScalar;
  const Q speed_m_s = quantity<Q>(20.0, dimension::kSpeed);
  const Q density_kg_per_m3 =
      calc_air_density_kg_per_m3(quantity<Q>(1e5, dimension::kPressure), quantity<Q>(293.0, dimension::kTemperature));
  const Q drag_N = calc_drag_N(density_kg_per_m3, quantity<Q>(0.7, dimension::kLength * dimension::kLength), speed_m_s,
                               quantity<Q>(1.0, dimension::kSpeed));
  const Q grade_N = calc_grade_N(quantity<Q>(2000.0, dimension::kMass), Q(0.02));
  const auto shared = blend_brakes(Q(-1.0) * (drag_N + grade_N), quantity<Q>(300.0, dimension::kForce), speed_m_s,
                                   quantity<Q>(3.0, dimension::kSpeed));
  CHECK(shared.motor_N.value() == Approx(-300.0));
  CHECK(shared.friction_N.dimension() == dimension::kForce);
}
