// CVODES and Simbody's own CPodes in one program: each must find its own SUNDIALS.
#include <Simbody.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/cvodes_integrator.h"
#include "sim/simulate.h"
#include "tests/support/lambda_system.h"

using namespace rollrig;

TEST_CASE("CVODES integrates y' = -y beside Simbody", "[fast]") {
  tests::LambdaSystem system(
      {1.0}, [](double, const double* y, double* r) { r[0] = -y[0]; }, 1e-12);
  sim::CvodesOptions options;
  options.relative_tolerance = 1e-8;
  sim::CvodesIntegrator integrator(system, options);
  sim::Program program;
  program.phases = {tests::plain_phase(1.0)};
  CHECK(sim::simulate<double>(system, integrator, program).final_state[0] == Approx(std::exp(-1.0)).epsilon(1e-6));
}

TEST_CASE("Simbody's CPodes integrates a pendulum beside CVODES", "[fast]") {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  SimTK::Force::UniformGravity gravity(forces, matter, SimTK::Vec3(0, -9.81, 0));
  const SimTK::Body::Rigid body(SimTK::MassProperties(1.0, SimTK::Vec3(0), SimTK::Inertia(1)));
  SimTK::MobilizedBody::Pin pendulum(matter.Ground(), SimTK::Vec3(0), body, SimTK::Vec3(0, 1, 0));
  SimTK::State state = system.realizeTopology();
  pendulum.setAngle(state, 0.01);
  SimTK::CPodesIntegrator integrator(system);
  integrator.setAccuracy(1e-8);
  SimTK::TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  stepper.stepTo(1.0);
  // small swing of a body with inertia m l^2 + I = 2 kg m2: omega = sqrt(m g l / 2)
  CHECK(pendulum.getAngle(stepper.getState()) == Approx(0.01 * std::cos(std::sqrt(9.81 / 2.0))).epsilon(1e-4));
}
