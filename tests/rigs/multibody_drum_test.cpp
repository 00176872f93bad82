// The drum rig in Simbody: what a tire rig gets wrong is tried here end to end.
#include "rigs/multibody_drum.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "tests/support/drum_fixture.h"

using namespace rollrig;
using tests::DrumFixture;

namespace {

const double kDrumSpeed_m_s = 80.0 / 3.6;

/// Skim, then a load step, so that everything has been disturbed.
sim::Program load_step(double load_N, double hold_s = 120.0) {
  sim::Program program;
  program.phases = {tests::rolling("skim", 20.0, kDrumSpeed_m_s, 200.0),
                    tests::rolling("load", hold_s, kDrumSpeed_m_s, load_N)};
  return program;
}

DrumFixture without_loss() {
  DrumFixture fixture;
  fixture.tire.values.rolling_resistance.A0_N = 0.0;
  fixture.tire.values.rolling_resistance.A1_N_s_per_m = 0.0;
  fixture.rig.parasitic = {};
  return fixture;
}

DrumFixture with_constant_coefficient(double rrc) {
  DrumFixture fixture;
  fixture.baseline = models::Baseline::kConstantRrc;
  fixture.tire.has_constant = true;
  fixture.tire.values.constant.rrc = rrc;
  return fixture;
}

/// A rig that was run through a program and can be looked into at its end.
struct DrumRun {
  models::Corner<double> corner;
  std::unique_ptr<rigs::MultibodyDrum> drum;
  sim::Recording<double> recording;
  double end_s;

  DrumRun(const DrumFixture& fixture, const sim::Program& program)
      : corner(fixture.corner()), drum(rigs::make_multibody_drum(corner, fixture.rig, fixture.start(), false)) {
    sim::CvodesIntegrator integrator(*drum, fixture.cvodes);
    recording = sim::simulate<double>(*drum, integrator, program);
    end_s = program.start_time_s + program.duration_s();
  }
  rigs::DrumForces forces() { return drum->find_forces(end_s, recording.final_state.data()); }
};

}  // namespace

TEST_CASE("the load asked for is the load at the contact, wheel weight included", "[fast]") {
  for (const double load_N : {200.0, 4800.0, 7649.0}) {
    DrumRun ran(DrumFixture(), load_step(load_N));
    CHECK(ran.forces().contact_load_N == Approx(load_N).epsilon(1e-6));
  }
  DrumFixture heavy;  // a rig and a wheel twice as heavy press no harder
  heavy.rig.carriage.mass_kg *= 2.0;
  heavy.tire.values.geometry.wheel_mass_kg *= 2.0;
  DrumRun ran(heavy, load_step(5400.0));
  CHECK(ran.forces().contact_load_N == Approx(5400.0).epsilon(1e-6));
}

TEST_CASE("without loss a free-rolling wheel has no hub moment and the drum no torque, at any tolerance", "[fast]") {
  for (const double factor : {1e3, 1.0, 1e-2}) {
    DrumFixture fixture = without_loss();
    fixture.cvodes.tolerance_factor = factor;
    DrumRun ran(fixture, load_step(5400.0));
    INFO("tolerances times " << factor);
    const rigs::DrumForces at_end = ran.forces();
    const double nothing = 1e-6 * std::max(1.0, factor);  // N m, N
    CHECK(std::abs(at_end.hub_moment_Nm) < nothing);
    CHECK(std::abs(at_end.motor_torque_Nm) < nothing);
    CHECK(std::abs(at_end.spindle_force_N) < nothing);
  }
}

TEST_CASE("a prescribed coefficient comes back by the torque method and by the force method", "[fast]") {
  constexpr double kRrc = 0.008;
  const DrumFixture fixture = with_constant_coefficient(kRrc);
  for (const double load_N : {200.0, 5400.0}) {
    DrumRun ran(fixture, load_step(load_N));
    const rigs::DrumForces at = ran.forces();
    const double radius_m = fixture.rig.drum.diameter_m / 2.0;
    const double by_torque = (at.motor_torque_Nm / radius_m - at.parasitic_N) / load_N;
    const double by_force = at.spindle_force_N * (1.0 + at.loaded_radius_m / radius_m) / load_N;
    CHECK(by_torque == Approx(kRrc).epsilon(1e-6));
    CHECK(by_force == Approx(kRrc).epsilon(1e-6));
  }
}

TEST_CASE("the same on a drum of another size: the contact takes the surface's own speed and curvature", "[fast]") {
  constexpr double kRrc = 0.008;
  DrumFixture fixture = with_constant_coefficient(kRrc);
  fixture.rig.drum.diameter_m = 1.2;
  DrumRun ran(fixture, load_step(5400.0));
  const rigs::DrumForces at = ran.forces();
  CHECK(at.surface_speed_m_s == Approx(kDrumSpeed_m_s).epsilon(1e-8));
  CHECK(at.drum_speed_rad_s == Approx(kDrumSpeed_m_s / 0.6).epsilon(1e-8));
  CHECK((at.motor_torque_Nm / 0.6 - at.parasitic_N) / 5400.0 == Approx(kRrc).epsilon(1e-6));
  CHECK(at.spindle_force_N * (1.0 + at.loaded_radius_m / 0.6) / 5400.0 == Approx(kRrc).epsilon(1e-6));
}

TEST_CASE("force read off the contact is Simbody's reaction at the spindle, at the same instant", "[fast]") {
  DrumRun ran(DrumFixture(), load_step(5400.0));
  const rigs::DrumForces at = ran.forces();
  CHECK(at.spindle_reaction_N == Approx(at.spindle_force_N).epsilon(1e-9));
  CHECK(at.hub_moment_Nm == Approx(0.0).margin(1e-9));
}

TEST_CASE("the wheel rolls with its loaded radius", "[fast]") {
  DrumRun ran(DrumFixture(), load_step(5400.0));
  const rigs::DrumForces at = ran.forces();
  CHECK(at.loaded_radius_m == Approx(0.7176 / 2.0 - 5400.0 / 220000.0).epsilon(1e-6));
  CHECK(at.wheel_speed_rad_s * at.loaded_radius_m == Approx(kDrumSpeed_m_s).epsilon(1e-5));
}

TEST_CASE("both audits close on a test with every transient, and slip of the baseline is a numerical trace", "[fast]") {
  sim::Program program = load_step(6865.0, 600.0);
  sim::Phase up = tests::rolling("up", 60.0, 0.0, 200.0);
  up.segments = {tests::drum_segment(60.0, 0.0, kDrumSpeed_m_s, 200.0)};
  program.phases.insert(program.phases.begin(), up);
  const auto recording = DrumFixture().run_multibody(program);
  CHECK_NOTHROW(recording.audit.require_closed(sim::kAuditLimit));
  const double motor_J = recording.audit.find_term_J(sim::kMotorWork);
  CHECK(std::abs(recording.audit.find_term_J("slip_loss")) < 1e-5 * motor_J);
  CHECK(-recording.audit.find_term_J("tire_loss") ==
        Approx(recording.audit.find_term_J("heat_generated")).epsilon(1e-5));
}

TEST_CASE("without its cylinder damper the bounce decays slowly, at its own frequency", "[fast]") {
  DrumFixture fixture;
  fixture.rig.carriage.damping_N_s_per_m = 0.0;
  sim::Program program = load_step(5400.0, 4.0);
  program.sample_interval_s = 0.005;
  const auto recording = fixture.run_multibody(program);
  const auto& load_N = recording.channel("contact_load_N");
  int crossings = 0;
  for (std::size_t i = 1; i < load_N.size(); ++i) {
    const bool in_window = recording.time_s[i] > 20.5 && recording.time_s[i] < 22.5;
    if (in_window && (load_N[i - 1] - 5400.0) * (load_N[i] - 5400.0) < 0.0) ++crossings;
  }
  const double mass_kg = 155.0 + 11.0 + 14.0;
  const double frequency_Hz = std::sqrt(220000.0 / mass_kg) / (2.0 * M_PI);
  CHECK(crossings / 2.0 / 2.0 == Approx(frequency_Hz).margin(0.3));
}

TEST_CASE("a drum that coasts without tire load stops when the closed form says", "[fast]") {
  DrumFixture fixture = without_loss();
  fixture.rig.parasitic.c0_N = 20.0;
  fixture.rig.parasitic.c1_N_s_per_m = 1.5;
  sim::Program program;
  program.phases = {tests::rolling("coast", 2000.0, 30.0, 200.0)};
  program.phases[0].commands = {{rigs::kDrive, 0.0}};
  program.phases[0].until = sim::StopCondition{rigs::kWatchSpeed, 1.0, sim::StopCondition::Direction::kFalling};
  // (m_eff) dv/dt = -(c0 + c1 v) from 30 to 1 m/s: t = m/c1 ln((c0 + 30 c1)/(c0 + c1))
  const double radius_m = 0.7176 / 2.0 - 200.0 / 220000.0;
  const double drum_radius_m = fixture.rig.drum.diameter_m / 2.0;
  const double mass_kg = fixture.rig.drum.inertia_kg_m2 / (drum_radius_m * drum_radius_m) + 1.5 / (radius_m * radius_m);
  const double expected_s = mass_kg / 1.5 * std::log((20.0 + 45.0) / (20.0 + 1.5));
  CHECK(fixture.run_multibody(program).phases[0].end_s == Approx(expected_s).margin(1e-3));
  CHECK(fixture.run_quasi_static(program).phases[0].end_s == Approx(expected_s).margin(1e-3));
}

TEST_CASE("an explicit method with small steps follows the same motion", "[fast]") {
  // The rig's rates, integrated by an explicit method with a step far below every time constant.
  DrumFixture fixture;
  models::Corner<double> corner = fixture.corner();
  const auto drum = rigs::make_multibody_drum(corner, fixture.rig, fixture.start(), false);
  const sim::Segment first = tests::drum_segment(1.0, kDrumSpeed_m_s, kDrumSpeed_m_s, 200.0);
  const sim::Segment second = tests::drum_segment(0.2, kDrumSpeed_m_s, kDrumSpeed_m_s, 5400.0);
  std::vector<double> y(drum->state_count());
  drum->initialize(first, 0.0, y.data());
  drum->begin_segment(second, 0.0, y.data(), nullptr);
  std::vector<double> start = y;
  const std::size_t n = y.size();
  std::vector<double> k1(n), k2(n), k3(n), k4(n), stage(n);
  const double h = 2e-5;
  for (int step = 0; step < 10000; ++step) {
    const double t = step * h;
    const auto at = [&](double dt, const std::vector<double>& k, double share, std::vector<double>& out) {
      for (std::size_t i = 0; i < n; ++i) stage[i] = y[i] + share * k[i];
      drum->evaluate(t + dt, stage.data(), out.data(), nullptr);
    };
    drum->evaluate(t, y.data(), k1.data(), nullptr);
    at(h / 2, k1, h / 2, k2);
    at(h / 2, k2, h / 2, k3);
    at(h, k3, h, k4);
    for (std::size_t i = 0; i < n; ++i) y[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }
  sim::CvodesIntegrator integrator(*drum);
  integrator.begin_run(0.0);
  std::copy(start.begin(), start.end(), integrator.state());
  drum->begin_segment(second, 0.0, integrator.state(), nullptr);
  integrator.begin_segment(0.0, nullptr);
  while (integrator.time_s() < 0.2) integrator.step(0.2);
  const rigs::DrumForces explicit_forces = drum->find_forces(0.2, y.data());
  const rigs::DrumForces cvodes_forces = drum->find_forces(0.2, integrator.state());
  CHECK(cvodes_forces.contact_load_N == Approx(explicit_forces.contact_load_N).epsilon(1e-5));
  CHECK(cvodes_forces.motor_torque_Nm == Approx(explicit_forces.motor_torque_Nm).epsilon(1e-4));
  CHECK(cvodes_forces.wheel_speed_rad_s == Approx(explicit_forces.wheel_speed_rad_s).epsilon(1e-7));
}

TEST_CASE("two rigs at once do not disturb each other", "[fast]") {
  DrumFixture small;
  small.rig.drum.diameter_m = 1.2;
  const double alone_Nm = DrumFixture().run_multibody(load_step(5400.0)).channel("drum_torque_Nm").back();
  DrumRun first(DrumFixture(), load_step(5400.0));
  DrumRun second(small, load_step(4000.0));
  CHECK(first.recording.channel("drum_torque_Nm").back() == alone_Nm);
  CHECK(first.forces().contact_load_N == Approx(5400.0).epsilon(1e-6));
  CHECK(second.forces().contact_load_N == Approx(4000.0).epsilon(1e-6));
}
