// One wheel in equilibrium: closed forms, and what forces on wheel and surface must obey.
#include "models/wheel/rolling_wheel.h"

#include <catch2/catch.hpp>

#include "tests/support/drum_fixture.h"

using namespace rollrig;
using models::RollingWheel;

namespace {

/// Radii of surfaces, none of them 1 m: a roller, a drum of 1.707 m, the flat (0).
const std::vector<double> kRadii_m{0.61, 0.8535, 0.0};

struct Surface {
  models::Context<double> context;
  double radius_m;

  explicit Surface(double of_radius_m) : radius_m(of_radius_m) {
    context.tire = tests::read_combined_tire().values;
    if (radius_m == 0.0) return;
    context.surface_curvature_per_m = 1.0 / radius_m;
    context.machine_radius_m = radius_m;
    context.machine_mass_kg = 40.0 / (radius_m * radius_m);
  }

  /// A wheel that loses 43 N by rolling and 11 N by bearings, on a machine whose inertia is 4 % more than nominal, with
  /// a tire that slips by 1 % a kN.
  models::Instant<double> roll(double speed_m_s, double acceleration_m_s2, double load_N = 4800.0) const {
    models::Instant<double> now;
    now.context = &context;
    now.motion.speed_m_s = speed_m_s;
    now.motion.acceleration_m_s2 = acceleration_m_s2;
    now.motion.load_N = load_N;
    now.rolling_resistance_N = 43.0;
    now.parasitic_N = 11.0;
    now.contact = {1e-5, 1.04, 1.0};
    return now;
  }
};

}  // namespace

TEST_CASE("rolling resistance is an equal and opposite couple on wheel and surface", "[fast]") {
  for (const double radius_m : kRadii_m) {
    const Surface surface(radius_m);
    const models::Instant<double> now = surface.roll(30.0, 0.0);
    const RollingWheel<double> wheel = models::find_rolling_wheel(now);
    const double couple_Nm = models::calc_resistance_couple_Nm(now.rolling_resistance_N, wheel.loaded_radius_m,
                                                               surface.context.surface_curvature_per_m);
    const double on_surface_N = now.rolling_resistance_N - wheel.loss_at_wheel_N;
    INFO("radius " << radius_m);
    CHECK(wheel.loss_at_wheel_N * wheel.loaded_radius_m == Approx(couple_Nm).epsilon(1e-13));
    CHECK(on_surface_N * radius_m == Approx(radius_m > 0.0 ? couple_Nm : 0.0).epsilon(1e-13));
    if (radius_m == 0.0) CHECK(on_surface_N == 0.0);  // the road does not turn, so that it takes no power
  }
}

TEST_CASE("what hub and machine put in is lost or stored, with slip, in drive and in braking", "[fast]") {
  for (const double radius_m : kRadii_m) {
    const Surface surface(radius_m);
    for (const double on_wheel_N : {-900.0, -150.0, 0.0, 400.0}) {
      for (const double acceleration_m_s2 : {-2.5, 0.0, 1.2}) {
        models::Instant<double> now = surface.roll(24.0, acceleration_m_s2);
        const RollingWheel<double> wheel = models::find_rolling_wheel(now);
        now.motion.longitudinal_force_N = on_wheel_N;
        const double slip = models::calc_slip(now);
        models::put_slip(wheel, slip, now.motion);
        const double v = now.motion.speed_m_s;
        const double wheel_rad_s = v * (1.0 - slip) / wheel.loaded_radius_m;
        const double hub_Nm = (wheel.calc_balance_N(0.0, acceleration_m_s2, slip) - on_wheel_N) * wheel.loaded_radius_m;
        const double machine_kg = now.contact.machine_inertia_factor * surface.context.machine_mass_kg;
        const double machine_N = now.rolling_resistance_N - wheel.loss_at_wheel_N + now.parasitic_N +
                                 machine_kg * acceleration_m_s2 + on_wheel_N;
        const double couple_Nm = wheel.loss_at_wheel_N * wheel.loaded_radius_m;
        const double tire_W = couple_Nm * (wheel_rad_s + surface.context.surface_curvature_per_m * v);
        const double slip_W = on_wheel_N * (v - wheel_rad_s * wheel.loaded_radius_m);
        const double stored_W = (machine_kg + wheel.spin_mass_kg) * acceleration_m_s2 * v;
        INFO("radius " << radius_m << ", force " << on_wheel_N << ", acceleration " << acceleration_m_s2);
        CHECK(hub_Nm * wheel_rad_s + machine_N * v ==
              Approx(tire_W + slip_W + now.parasitic_N * v + stored_W).epsilon(1e-12).margin(1e-9));
        CHECK(now.rolling_resistance_N * now.motion.rolling_speed_m_s == Approx(tire_W).epsilon(1e-12));
        CHECK(now.motion.slip_power_W == Approx(slip_W).epsilon(1e-9).margin(1e-9));
        CHECK(now.motion.slip_power_W >= 0.0);
      }
    }
  }
}

TEST_CASE("the wheel's spin is felt as its inertia over the square of the loaded radius, if it touches", "[fast]") {
  const Surface surface(0.61);
  const double radius_m = 0.7176 / 2.0 - 4800.0 / 220000.0;
  CHECK(models::find_rolling_wheel(surface.roll(20.0, 0.0)).spin_mass_kg == Approx(1.5 / (radius_m * radius_m)));
  CHECK(models::find_rolling_wheel(surface.roll(20.0, 0.0, 0.0)).spin_mass_kg == 0.0);
  CHECK(models::calc_tire_spring_J(surface.context.tire, 4800.0) == Approx(0.5 * 4800.0 * (4800.0 / 220000.0)));
}

TEST_CASE("a dynamometer's loss force shows the inertia that it does not know of, by the sign of acceleration",
          "[fast]") {
  const Surface surface(0.61);
  const auto loss_N = [&](double acceleration_m_s2) {
    return models::calc_loss_force_N(surface.roll(20.0, acceleration_m_s2), 6.5, acceleration_m_s2);
  };
  const double unknown_kg = 0.04 * 40.0 / (0.61 * 0.61);
  CHECK(loss_N(0.0) == Approx(43.0 + 11.0 + 6.5));
  CHECK(loss_N(1.5) - loss_N(0.0) == Approx(1.5 * unknown_kg));
  CHECK(loss_N(-2.0) - loss_N(0.0) == Approx(-2.0 * unknown_kg));
}

TEST_CASE("without slip the rolling speed is the surface's, and a dragged wheel turns slower, a driven one faster",
          "[fast]") {
  for (const double radius_m : kRadii_m) {
    const Surface surface(radius_m);
    models::Instant<double> now = surface.roll(20.0, 0.0);
    const RollingWheel<double> wheel = models::find_rolling_wheel(now);
    const auto rolling_m_s = [&](double on_wheel_N) {
      now.motion.longitudinal_force_N = on_wheel_N;
      models::put_slip(wheel, models::calc_slip(now), now.motion);
      return now.motion.rolling_speed_m_s;
    };
    CHECK(rolling_m_s(0.0) == 20.0);
    CHECK(rolling_m_s(500.0) < 20.0);
    CHECK(rolling_m_s(-500.0) > 20.0);
  }
}

TEST_CASE("dimensions of a wheel in equilibrium", "[fast]") {
  using Q = DimensionedScalar;
  const models::Context<Q> context = models::convert_context<Q>(tests::DrumFixture().context());
  const Dimension per_force = Dimension{} / dimension::kForce;
  models::Instant<Q> now;
  now.context = &context;
  now.motion.speed_m_s = Q(20.0, dimension::kSpeed);
  now.motion.acceleration_m_s2 = Q(0.5, dimension::kAcceleration);
  now.motion.load_N = Q(4800.0, dimension::kForce);
  now.motion.longitudinal_force_N = Q(300.0, dimension::kForce);
  now.rolling_resistance_N = now.parasitic_N = Q(40.0, dimension::kForce);
  now.contact = {Q(1e-5, per_force), Q(1.04), Q(1.0)};
  const RollingWheel<Q> wheel = models::find_rolling_wheel(now);
  const Q slip = models::calc_slip(now);
  models::put_slip(wheel, slip, now.motion);
  CHECK(wheel.spin_mass_kg.dimension() == dimension::kMass);
  CHECK(wheel.calc_balance_N(now.parasitic_N, now.motion.acceleration_m_s2, slip).dimension() == dimension::kForce);
  CHECK(now.motion.slip_power_W.dimension() == dimension::kPower);
  CHECK(now.motion.rolling_speed_m_s.dimension() == dimension::kSpeed);
  CHECK(models::calc_loss_force_N(now, now.parasitic_N, now.motion.acceleration_m_s2).dimension() == dimension::kForce);
  CHECK(models::calc_tire_spring_J(context.tire, now.motion.load_N).dimension() ==
        dimension::kForce * dimension::kLength);
}
