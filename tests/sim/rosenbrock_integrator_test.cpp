#include "sim/rosenbrock_integrator.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "sim/core/error.h"
#include "sim/rosenbrock_rule.h"
#include "sim/simulate.h"
#include "tests/support/lambda_system.h"

using namespace rollrig;
using tests::LambdaSystem;

namespace {

sim::Program lasting(double duration_s) {
  sim::Program program;
  program.phases = {tests::plain_phase(duration_s)};
  return program;
}

/// An input that rises by 1 in each second, and falls back in every second knot.
sim::Program saw_tooth(int segments) {
  sim::Program program;
  sim::Phase phase = tests::plain_phase(1.0);
  phase.segments.clear();
  for (int i = 0; i < segments; ++i) phase.segments.push_back({1.0, {{static_cast<double>(i % 2), 1.0}}});
  program.phases = {phase};
  return program;
}

/// Error of a pendulum with friction that is driven, after 10 s, and the steps that it took.
struct Attempt {
  double error;
  double steps;
};

Attempt try_pendulum(double tolerance_factor) {
  const auto run = [](double factor, long& steps) {
    LambdaSystem system(
        {1.0, 0.0},
        [](double t, const double* y, double* r) {
          r[0] = y[1];
          r[1] = -4.0 * std::sin(y[0]) - 0.1 * y[1] * std::abs(y[1]) + 0.3 * std::cos(2.3 * t);
        },
        1e-6);
    sim::RosenbrockOptions options;
    options.tolerance_factor = factor;
    sim::RosenbrockIntegrator integrator(system, options);
    const double angle = sim::simulate<double>(system, integrator, lasting(10.0)).final_state[0];
    steps = integrator.statistics().steps;
    return angle;
  };
  long steps = 0, many = 0;
  const double reference = run(1e-6, many);
  const double angle = run(tolerance_factor, steps);
  return {std::abs(angle - reference), static_cast<double>(steps)};
}

}  // namespace

TEST_CASE("the coefficients of ROS34PW2 meet the conditions of order 3 for any Jacobian, and of order 2 below",
          "[fast]") {
  const sim::RosenbrockRule rule;
  const Eigen::Vector4d a = rule.alpha.rowwise().sum(), g = rule.g.rowwise().sum();
  const auto check = [&](const Eigen::RowVector4d& b, bool is_third) {
    CHECK(b.sum() == Approx(1.0).epsilon(1e-14));
    CHECK(b.dot(a) == Approx(0.5).epsilon(1e-14));
    CHECK(b.dot(g) == Approx(0.0).margin(1e-14));
    if (!is_third) return;
    CHECK(b.dot(a.cwiseProduct(a)) == Approx(1.0 / 3.0).epsilon(1e-13));
    CHECK(b.dot(rule.alpha * a) == Approx(1.0 / 6.0).epsilon(1e-13));
    CHECK(b.dot(rule.alpha * g) == Approx(0.0).margin(1e-13));
    CHECK(b.dot(rule.g * a) == Approx(0.0).margin(1e-13));
    CHECK(b.dot(rule.g * g) == Approx(0.0).margin(1e-13));
  };
  check(rule.b, true);
  check(rule.b_lower, false);
}

TEST_CASE("Rosenbrock: an error falls with the third power of the number of steps", "[fast]") {
  const Attempt coarse = try_pendulum(10.0);
  const Attempt fine = try_pendulum(0.01);
  CHECK(fine.steps > 6.0 * coarse.steps);
  const double order = std::log(coarse.error / fine.error) / std::log(fine.steps / coarse.steps);
  INFO(coarse.error << " in " << coarse.steps << ", " << fine.error << " in " << fine.steps);
  CHECK(order > 2.7);
  CHECK(order < 3.6);
}

TEST_CASE("Rosenbrock: decay and its integral meet their closed forms", "[fast]") {
  LambdaSystem system(
      {1.0}, [](double, const double* y, double* r) { r[0] = -y[0]; }, 1e-10);
  sim::RosenbrockIntegrator integrator(system);
  const auto recording = sim::simulate<double>(system, integrator, lasting(5.0));
  CHECK(recording.final_state[0] == Approx(std::exp(-5.0)).epsilon(1e-5));
  CHECK(recording.final_integrals[0] == Approx(1.0 - std::exp(-5.0)).epsilon(1e-6));
}

TEST_CASE("Rosenbrock: a time constant of a millisecond does not limit the steps", "[fast]") {
  LambdaSystem system(
      {0.0}, [](double t, const double* y, double* r) { r[0] = -1000.0 * (y[0] - std::cos(t)); }, 1e-6);
  sim::RosenbrockIntegrator integrator(system);
  const auto recording = sim::simulate<double>(system, integrator, lasting(10.0));
  // y = (k^2 cos t + k sin t)/(k^2 + 1), k = 1000, once the start is forgotten
  const double closed = (1e6 * std::cos(10.0) + 1e3 * std::sin(10.0)) / (1e6 + 1.0);
  CHECK(recording.final_state[0] == Approx(closed).margin(1e-5));
  CHECK(integrator.statistics().steps < 300);  // an explicit method needs over 3000
}

TEST_CASE("Rosenbrock: over knots where the input jumps a Jacobian is kept, and the closed form met", "[fast]") {
  // y' = -k y + u, u = a + t within a segment: y = u/k - 1/k^2 + c e^{-k t}
  constexpr double kRate = 3.0;
  constexpr int kSegments = 400;
  LambdaSystem system(
      {0.0}, [](double, const double* y, double* r) { r[0] = -kRate * y[0]; }, 1e-6);
  sim::RosenbrockIntegrator integrator(system);
  const auto recording = sim::simulate<double>(system, integrator, saw_tooth(kSegments));
  double y = 0.0;
  for (int i = 0; i < kSegments; ++i) {
    const double from = i % 2;
    const double c = y - from / kRate + 1.0 / (kRate * kRate);
    y = (from + 1.0) / kRate - 1.0 / (kRate * kRate) + c * std::exp(-kRate);
  }
  CHECK(recording.final_state[0] == Approx(y).margin(1e-5));
  const sim::IntegratorStatistics& counted = integrator.statistics();
  INFO(counted.steps << " steps, " << counted.jacobian_evaluations << " Jacobians");
  CHECK(8 * counted.jacobian_evaluations < counted.steps);
  CHECK(counted.jacobian_evaluations >= kSegments / 6);  // none is older than five seconds and a step
}

TEST_CASE("Rosenbrock: values and means between the ends of steps meet their closed forms", "[fast]") {
  LambdaSystem system(
      {0.0}, [](double t, const double*, double* r) { r[0] = std::cos(t); }, 4e-6);
  sim::RosenbrockIntegrator integrator(system);
  sim::Program program = lasting(6.0);
  program.sample_interval_s = 0.05;
  const auto recording = sim::simulate<double>(system, integrator, program);
  REQUIRE(recording.time_s.size() > 100);
  CHECK(integrator.statistics().steps < 60);
  for (std::size_t i = 1; i + 1 < recording.time_s.size(); ++i) {
    const double t = recording.time_s[i];
    CHECK(recording.values[0][i] == Approx(std::sin(t)).margin(1e-4));
    CHECK(recording.values[1][i] == Approx((std::cos(t - 0.025) - std::cos(t + 0.025)) / 0.05).margin(1e-3));
  }
}

TEST_CASE("Rosenbrock: an event time is exact to a millisecond", "[fast]") {
  // Free fall from 100 m reaches the ground at sqrt(2 h/g).
  LambdaSystem system(
      {100.0, 0.0},
      [](double, const double* y, double* r) {
        r[0] = y[1];
        r[1] = -9.80665;
      },
      1e-8);
  sim::RosenbrockIntegrator integrator(system);
  sim::Program program = lasting(100.0);
  program.phases[0].until = sim::StopCondition{"y0", 0.0, sim::StopCondition::Direction::kFalling};
  const auto recording = sim::simulate<double>(system, integrator, program);
  CHECK(recording.phases[0].end_s == Approx(std::sqrt(2.0 * 100.0 / 9.80665)).margin(1e-3));
  CHECK(recording.final_state[0] == Approx(0.0).margin(1e-6));
}

TEST_CASE("Rosenbrock: after an event the next phase goes on from its state, and means are cut there", "[fast]") {
  // y = e^{-t} down to 0.5 at t = ln 2; a command adds 1; then y = 1.5 e^{-t}
  LambdaSystem system(
      {1.0}, [](double, const double* y, double* r) { r[0] = -y[0]; }, 1e-8);
  sim::RosenbrockIntegrator integrator(system);
  sim::Program program = lasting(10.0);
  program.sample_interval_s = 0.2;
  program.phases[0].until = sim::StopCondition{"y0", 0.5, sim::StopCondition::Direction::kFalling};
  program.phases.push_back(tests::plain_phase(1.0));
  program.phases[1].commands = {{"add", 1.0}};
  const auto recording = sim::simulate<double>(system, integrator, program);
  const double event_s = std::log(2.0);
  CHECK(recording.phases[0].end_s == Approx(event_s).margin(1e-6));
  CHECK(recording.final_state[0] == Approx(1.5 * std::exp(-1.0)).margin(1e-6));
  CHECK(recording.final_integrals[0] == Approx(0.5 + 1.5 * (1.0 - std::exp(-1.0))).margin(1e-6));
  for (std::size_t i = 1; i + 1 < recording.time_s.size(); ++i) {
    const double t = recording.time_s[i];
    const double before = std::exp(-t), after = 1.5 * std::exp(event_s - t);
    CHECK(recording.values[0][i] == Approx(t < event_s ? before : after).margin(1e-5));
    if (std::abs(t - event_s) < 0.1) continue;
    const double width = 2.0 * std::sinh(0.1) / 0.2;
    CHECK(recording.values[1][i] == Approx(width * (t < event_s ? before : after)).margin(1e-4));
  }
}

TEST_CASE("Rosenbrock: a condition that is met already ends the phase at once", "[fast]") {
  LambdaSystem system({1.0}, [](double, const double*, double* r) { r[0] = 0.0; });
  sim::RosenbrockIntegrator integrator(system);
  sim::Program program = lasting(10.0);
  program.phases[0].until = sim::StopCondition{"y0", 2.0, sim::StopCondition::Direction::kFalling};
  CHECK(sim::simulate<double>(system, integrator, program).phases[0].end_s == 0.0);
  program.phases[0].until = sim::StopCondition{"y0", 0.5, sim::StopCondition::Direction::kRising};
  CHECK(sim::simulate<double>(system, integrator, program).phases[0].end_s == 0.0);
}

TEST_CASE("Rosenbrock: an integration that cannot go on says when and why", "[fast]") {
  LambdaSystem blow_up({1.0}, [](double, const double* y, double* r) { r[0] = y[0] * y[0]; });  // ends at t = 1
  sim::RosenbrockIntegrator integrator(blow_up);
  CHECK_THROWS_AS(sim::simulate<double>(blow_up, integrator, lasting(2.0)), RunFailure);
  CHECK(integrator.time_s() == Approx(1.0).margin(1e-3));
  CHECK_THROWS_WITH(sim::simulate<double>(blow_up, integrator, lasting(2.0)),
                    Catch::Contains("t = 0.99") || Catch::Contains("t = 1"));
  LambdaSystem undefined({1.0}, [](double, const double*, double* r) { r[0] = std::nan(""); });
  sim::RosenbrockIntegrator other(undefined);
  CHECK_THROWS_WITH(sim::simulate<double>(undefined, other, lasting(2.0)), Catch::Contains("not finite"));
  LambdaSystem edge({1.0}, [](double, const double* y, double* r) { r[0] = y[0] > 1.0 ? std::nan("") : 0.0; });
  sim::RosenbrockIntegrator beside(edge);
  CHECK_THROWS_WITH(sim::simulate<double>(edge, beside, lasting(2.0)), Catch::Contains("near the state"));
}

TEST_CASE("Rosenbrock: two runs of one integrator are the same", "[fast]") {
  LambdaSystem system(
      {0.5}, [](double t, const double* y, double* r) { r[0] = std::sin(3.0 * t) - y[0] * y[0] * y[0]; }, 1e-6);
  sim::RosenbrockIntegrator integrator(system);
  const auto first = sim::simulate<double>(system, integrator, lasting(20.0));
  sim::simulate<double>(system, integrator, lasting(3.3));
  CHECK(sim::simulate<double>(system, integrator, lasting(20.0)).final_state == first.final_state);
}
