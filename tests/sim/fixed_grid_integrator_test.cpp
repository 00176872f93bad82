#include "sim/fixed_grid_integrator.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "sim/simulate.h"
#include "tests/support/lambda_system.h"

using namespace rollrig;
using tests::LambdaSystem;

namespace {
double run_to_end(LambdaSystem system, double duration_s, double step_s) {
  sim::FixedGridIntegrator<double> integrator(system);
  sim::Program program;
  program.phases = {tests::plain_phase(duration_s, step_s)};
  return sim::simulate<double>(system, integrator, program).final_state[0];
}
LambdaSystem pendulum() {
  return LambdaSystem({1.0, 0.0}, [](double, const double* y, double* r) {
    r[0] = y[1];
    r[1] = -std::sin(y[0]);
  });
}
}  // namespace

TEST_CASE("a polynomial of degree four is met exactly", "[fast]") {
  LambdaSystem system({0.0}, [](double t, const double*, double* r) { r[0] = 4.0 * t * t * t; });
  CHECK(run_to_end(system, 3.0, 1.0) == Approx(81.0).epsilon(1e-14));
}

TEST_CASE("halving the step divides the error by sixteen", "[fast]") {
  const double exact = run_to_end(pendulum(), 8.0, 0.001);
  const double coarse = std::abs(run_to_end(pendulum(), 8.0, 0.1) - exact);
  const double fine = std::abs(run_to_end(pendulum(), 8.0, 0.05) - exact);
  CHECK(coarse / fine == Approx(16.0).margin(1.5));
}

TEST_CASE("interpolation between grid points is of order four as well", "[fast]") {
  const auto middle_error = [](double step_s) {
    LambdaSystem system({1.0}, [](double, const double* y, double* r) { r[0] = -y[0]; });
    sim::FixedGridIntegrator<double> integrator(system);
    const sim::Segment segment{10.0, {}};
    system.begin_segment(segment, 0.0, nullptr, nullptr);
    integrator.begin_run(0.0);
    *integrator.state() = 1.0;
    integrator.begin_segment(step_s, nullptr);
    integrator.step(10.0);
    double y = 0.0;
    integrator.interpolate_state(0.5 * step_s, &y);
    return std::abs(y - std::exp(-0.5 * step_s));
  };
  CHECK(middle_error(0.04) / middle_error(0.02) == Approx(16.0).margin(2.0));
}

TEST_CASE("an event is found where the closed form has it", "[fast]") {
  LambdaSystem system({1.0}, [](double, const double* y, double* r) { r[0] = -y[0]; });
  sim::FixedGridIntegrator<double> integrator(system);
  sim::Program program;
  program.phases = {tests::plain_phase(100.0, 0.1)};
  program.phases[0].until = sim::StopCondition{"y0", 0.3, sim::StopCondition::Direction::kFalling};
  const auto recording = sim::simulate<double>(system, integrator, program);
  CHECK(recording.phases[0].end_s == Approx(-std::log(0.3)).margin(1e-6));
  CHECK(recording.final_state[0] == Approx(0.3).margin(1e-6));
}
