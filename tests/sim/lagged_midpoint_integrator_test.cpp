#include "sim/lagged_midpoint_integrator.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "sim/simulate.h"
#include "tests/support/lambda_system.h"

using namespace rollrig;
using tests::LambdaSystem;

namespace {

constexpr double kDuration_s = 6.0;  // where the errors that come first do not cancel

/// y' = -y + sin t from 2: y = (sin t - cos t)/2 + 5/2 exp(-t).
LambdaSystem driven() {
  return LambdaSystem({2.0}, [](double t, const double* y, double* r) { r[0] = -y[0] + std::sin(t); });
}
double calc_driven(double t) { return 0.5 * (std::sin(t) - std::cos(t)) + 2.5 * std::exp(-t); }
/// Its integral from 0.
double calc_driven_integral(double t) { return -0.5 * (std::cos(t) + std::sin(t)) + 0.5 + 2.5 * (1.0 - std::exp(-t)); }

/// In `segments` segments of equal length, at each of which the integrator starts anew.
sim::Recording<double> run(LambdaSystem system, double step_s, int segments) {
  sim::LaggedMidpointIntegrator<double> integrator(system);
  sim::Program program;
  program.phases = {tests::plain_phase(kDuration_s / segments, step_s)};
  program.phases[0].segments.resize(static_cast<std::size_t>(segments), program.phases[0].segments[0]);
  return sim::simulate<double>(system, integrator, program);
}

}  // namespace

TEST_CASE("halving the step of the lagged midpoint rule divides the error by four, knots or none", "[fast]") {
  const auto error = [](double step_s, int segments) {
    return std::abs(run(driven(), step_s, segments).final_state[0] - calc_driven(kDuration_s));
  };
  for (const int segments : {1, 12}) {
    CHECK(error(0.05, segments) / error(0.025, segments) == Approx(4.0).margin(0.3));
  }
  CHECK(error(10.0, 120) / error(10.0, 240) == Approx(4.0).margin(0.3));  // each segment a step
  CHECK(error(10.0, 120) == Approx(error(0.05, 1)).epsilon(1e-6));        // rates are remembered across knots
}

TEST_CASE("integrals of the lagged midpoint rule are of order two as well", "[fast]") {
  const auto error = [&](double step_s) {
    return std::abs(run(driven(), step_s, 6).final_integrals[0] - calc_driven_integral(kDuration_s));
  };
  CHECK(error(0.1) / error(0.05) == Approx(4.0).margin(0.4));
}

TEST_CASE("the lagged midpoint rule evaluates once a step, and once more at the start", "[fast]") {
  int evaluations = 0;
  LambdaSystem system({1.0}, [&](double, const double* y, double* r) {
    ++evaluations;
    r[0] = -y[0];
  });
  run(system, 0.5, 4);
  CHECK(evaluations == 12 + 1);
}

TEST_CASE("a rate that does not change is met exactly, inside steps too, and so is an event", "[fast]") {
  LambdaSystem system({5.0}, [](double, const double*, double* r) { r[0] = -2.0; });
  sim::LaggedMidpointIntegrator<double> integrator(system);
  sim::Program program;
  program.phases = {tests::plain_phase(10.0, 0.7)};
  program.phases[0].until = sim::StopCondition{"y0", 1.0, sim::StopCondition::Direction::kFalling};
  const auto recording = sim::simulate<double>(system, integrator, program);
  CHECK(recording.phases[0].end_s == Approx(2.0).epsilon(1e-12));
  CHECK(recording.final_state[0] == Approx(1.0).epsilon(1e-12));
}
