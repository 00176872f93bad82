#include "models/contact_law.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/drum_fixture.h"

using namespace rollrig;
using models::calc_normal_force_N;
using models::calc_slip_force;

namespace {

models::ContactParameters<double> soft_contact() {
  return models::make_contact_parameters(tests::read_combined_tire().values, 1.0 / 75000.0);
}
models::ContactParameters<double> stiff_contact() {
  return models::make_contact_parameters(tests::read_combined_tire().values, 0.0);
}

/// Slip force once the deflection has settled at constant speeds.
double settle(const models::ContactParameters<double>& p, double speed_m_s, double slip_m_s, double normal_N) {
  double u = 0.0;
  const double step_s = 0.02 / (std::abs(speed_m_s) / p.relaxation_length_m +
                                std::abs(slip_m_s) * p.slip_spring_N_per_m / (p.friction_coefficient * normal_N) + 1.0);
  for (int i = 0; i < 4000; ++i) u += step_s * calc_slip_force(p, speed_m_s, slip_m_s, normal_N, u).deflection_rate_m_s;
  return calc_slip_force(p, speed_m_s, slip_m_s, normal_N, u).force_N;
}

}  // namespace

TEST_CASE("the normal force perturbations and never pulls", "[fast]") {
  const auto p = stiff_contact();
  CHECK(calc_normal_force_N(p, 0.0, 0.0) == 0.0);
  CHECK(calc_normal_force_N(p, -0.01, 1.0) == 0.0);
  CHECK(calc_normal_force_N(p, 0.02, 0.0) == Approx(4400.0));  // 220 kN/m * 20 mm
  CHECK(calc_normal_force_N(p, 1e-4, -10.0) == 0.0);           // leaving fast
}

TEST_CASE("small slip gives force in proportion, C = dFx/dslip", "[fast]") {
  const double slip = 1e-4;
  CHECK(settle(soft_contact(), 20.0, slip * 20.0, 5400.0) == Approx(75000.0 * slip).epsilon(2e-2));
  CHECK(settle(soft_contact(), 20.0, -slip * 20.0, 5400.0) == Approx(-75000.0 * slip).epsilon(2e-2));
}

TEST_CASE("large slip saturates at the friction limit and never above", "[fast]") {
  const double full = settle(soft_contact(), 20.0, 20.0, 5400.0);
  CHECK(full < 5400.0);
  CHECK(full > 0.9 * 5400.0);
  CHECK(settle(soft_contact(), 0.0, 1.0, 200.0) == Approx(200.0).epsilon(1e-2));
}

TEST_CASE("slip dissipates and never creates energy", "[fast]") {
  for (const auto& p : {soft_contact(), stiff_contact()}) {
    const double most_m = 1000.0 / p.slip_spring_N_per_m;
    for (const double speed : {0.0, 0.1, 5.0, 40.0}) {
      for (const double slip : {-1.0, -1e-3, 0.0, 1e-3, 1.0}) {
        for (const double u : {-most_m, 0.0, 0.3 * most_m, most_m}) {
          INFO("V " << speed << " Vs " << slip << " u " << u);
          CHECK(calc_slip_force(p, speed, slip, 3000.0, u).dissipated_W >= 0.0);
        }
      }
    }
  }
}

TEST_CASE("a lifted wheel has no slip force and its deflection springs back", "[fast]") {
  const auto slip = calc_slip_force(stiff_contact(), 10.0, 0.5, 0.0, 1e-6);
  CHECK(slip.force_N == 0.0);
  CHECK(slip.deflection_rate_m_s < 0.0);
  CHECK(slip.dissipated_W > 0.0);
}

TEST_CASE("the stiff contact of the baseline dissipates under 0.1 N at 1 kN", "[fast]") {
  const auto p = stiff_contact();
  // In steady rolling Fx = C slip with C = k sigma; the loss per meter is Fx slip.
  const double stiffness_N = p.slip_spring_N_per_m * p.relaxation_length_m;
  CHECK(1000.0 * 1000.0 / stiffness_N < 0.1);
}

TEST_CASE("dimensions of the contact", "[fast]") {
  using Q = DimensionedScalar;
  const auto tire = models::convert_tire<Q>(tests::read_combined_tire().values);
  const auto p = models::make_contact_parameters(tire, Q(0.0, Dimension{} / dimension::kForce));
  const Q speed(20.0, dimension::kSpeed), deflection(1e-6, dimension::kLength), normal(5000.0, dimension::kForce);
  const auto slip = calc_slip_force(p, speed, speed, normal, deflection);
  CHECK(slip.force_N.dimension() == dimension::kForce);
  CHECK(slip.dissipated_W.dimension() == dimension::kPower);
  CHECK(slip.deflection_rate_m_s.dimension() == dimension::kSpeed);
  CHECK(calc_normal_force_N(p, deflection, speed).dimension() == dimension::kForce);
}
