#include "sim/cvodes_integrator.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "sim/core/error.h"
#include "sim/simulate.h"
#include "tests/support/lambda_system.h"

using namespace rollrig;
using tests::LambdaSystem;

namespace {
LambdaSystem stiff_pair() {  // fast decay onto a slow one: y0 -> cos t
  return LambdaSystem(
      {0.0}, [](double t, const double* y, double* r) { r[0] = -1000.0 * (y[0] - std::cos(t)); }, 1e-8);
}
sim::Program one_phase(double duration_s) {
  sim::Program program;
  program.phases = {tests::plain_phase(duration_s)};
  return program;
}
}  // namespace

TEST_CASE("decay meets its closed form", "[fast]") {
  LambdaSystem system(
      {1.0}, [](double, const double* y, double* r) { r[0] = -y[0]; }, 1e-10);
  sim::CvodesIntegrator integrator(system);
  const auto recording = sim::simulate<double>(system, integrator, one_phase(5.0));
  CHECK(recording.final_state[0] == Approx(std::exp(-5.0)).epsilon(1e-5));
}

TEST_CASE("a stiff system takes few steps and keeps its tolerance against a run a hundred times tighter", "[fast]") {
  LambdaSystem system = stiff_pair();
  sim::CvodesOptions tight;
  tight.tolerance_factor = 0.01;
  sim::CvodesIntegrator reference_integrator(system, tight);
  const double reference = sim::simulate<double>(system, reference_integrator, one_phase(10.0)).final_state[0];
  sim::CvodesIntegrator integrator(system);
  const double value = sim::simulate<double>(system, integrator, one_phase(10.0)).final_state[0];
  const double weight = 1e-8 + 1e-6 * std::abs(reference);
  CHECK(std::abs(value - reference) / weight < 5.0);  // global error, a few local ones
  CHECK(integrator.statistics().steps < 600);         // an explicit method needs over 3000
}

TEST_CASE("an integral meets its closed form, and that of a stiff state stays within a few tolerances", "[fast]") {
  LambdaSystem decay(
      {1.0}, [](double, const double* y, double* r) { r[0] = -y[0]; }, 1e-8);
  sim::CvodesIntegrator integrator(decay);
  CHECK(sim::simulate<double>(decay, integrator, one_phase(5.0)).final_integrals[0] ==
        Approx(1.0 - std::exp(-5.0)).margin(1e-6));
  // y = (k^2 cos t + k sin t)/(k^2 + 1) but for what is lost in the first milliseconds: 1/k of it
  LambdaSystem stiff = stiff_pair();
  sim::CvodesIntegrator other(stiff);
  const double k = 1000.0;
  const double closed = (k * k * std::sin(10.0) + k * (1.0 - std::cos(10.0))) / (k * k + 1.0) - k / (k * k + 1.0);
  CHECK(sim::simulate<double>(stiff, other, one_phase(10.0)).final_integrals[0] == Approx(closed).margin(1e-6));
}

TEST_CASE("an event time is exact to a millisecond", "[fast]") {
  // Free fall from 100 m reaches the ground at sqrt(2 h/g).
  LambdaSystem system(
      {100.0, 0.0},
      [](double, const double* y, double* r) {
        r[0] = y[1];
        r[1] = -9.80665;
      },
      1e-8);
  sim::CvodesIntegrator integrator(system);
  sim::Program program = one_phase(100.0);
  program.phases[0].until = sim::StopCondition{"y0", 0.0, sim::StopCondition::Direction::kFalling};
  const auto recording = sim::simulate<double>(system, integrator, program);
  CHECK(recording.phases[0].end_s == Approx(std::sqrt(2.0 * 100.0 / 9.80665)).margin(1e-3));
}

TEST_CASE("a condition that is met already ends the phase at once", "[fast]") {
  LambdaSystem system({1.0}, [](double, const double*, double* r) { r[0] = 0.0; });
  sim::CvodesIntegrator integrator(system);
  sim::Program program = one_phase(10.0);
  program.phases[0].until = sim::StopCondition{"y0", 2.0, sim::StopCondition::Direction::kFalling};
  CHECK(sim::simulate<double>(system, integrator, program).phases[0].end_s == 0.0);
}

TEST_CASE("an integration that cannot go on says when and why", "[fast]") {
  LambdaSystem blow_up({1.0}, [](double, const double* y, double* r) { r[0] = y[0] * y[0]; });  // ends at t = 1
  sim::CvodesIntegrator integrator(blow_up);
  CHECK_THROWS_AS(sim::simulate<double>(blow_up, integrator, one_phase(2.0)), RunFailure);
  CHECK_THROWS_WITH(sim::simulate<double>(blow_up, integrator, one_phase(2.0)), Catch::Contains("t = "));
}

TEST_CASE("an exception inside the system comes through the C library", "[fast]") {
  LambdaSystem throwing({1.0}, [](double t, const double*, double*) {
    if (t > 0.5) throw InputError({"told so", "", 0, "", "", "", ""});
  });
  sim::CvodesIntegrator integrator(throwing);
  CHECK_THROWS_WITH(sim::simulate<double>(throwing, integrator, one_phase(2.0)), Catch::Contains("told so"));
}
