#include "sim/stabilized_integrator.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "sim/simulate.h"
#include "tests/support/lambda_system.h"

using namespace rollrig;
using tests::LambdaSystem;

namespace {

sim::Recording<double> run_stabilized(LambdaSystem system, double step_s, double duration_s) {
  sim::StabilizedIntegrator<double> integrator(system);
  sim::Program program;
  program.phases = {tests::plain_phase(duration_s, step_s)};
  return sim::simulate<double>(system, integrator, program);
}

/// y' = -y/tau + sin(t/tau)/tau from 2, tau 600 s.
constexpr double kTau_s = 600.0;
LambdaSystem slowly_driven() {
  return LambdaSystem({2.0},
                      [](double t, const double* y, double* r) { r[0] = (std::sin(t / kTau_s) - y[0]) / kTau_s; });
}
double calc_slowly_driven(double t_s) {
  const double x = t_s / kTau_s;
  return 0.5 * (std::sin(x) - std::cos(x)) + 2.5 * std::exp(-x);
}

}  // namespace

TEST_CASE("halving long steps divides the error by four, in the state and in its integral", "[fast]") {
  constexpr double kDuration_s = 1920.0;
  const auto error = [&](double step_s) {
    return std::abs(run_stabilized(slowly_driven(), step_s, kDuration_s).final_state[0] -
                    calc_slowly_driven(kDuration_s));
  };
  // Of y' from above the integral is 600 s (sin - y)' ... : int y = tau (2 - y(T)) + int sin(t/tau).
  const double integral =
      kTau_s * (2.0 - calc_slowly_driven(kDuration_s)) + kTau_s * (1.0 - std::cos(kDuration_s / kTau_s));
  const auto integral_error = [&](double step_s) {
    return std::abs(run_stabilized(slowly_driven(), step_s, kDuration_s).final_integrals[0] - integral);
  };
  // 60 and 30 s have 6 and 4 stages, and other constants of the error: steps of equally many stages are compared.
  const int stages = sim::StabilizedIntegrator<double>::count_stages(80.0);
  REQUIRE(sim::StabilizedIntegrator<double>::count_stages(64.0) == stages);
  const double ratio = 80.0 / 64.0;
  CHECK(error(80.0) / error(64.0) == Approx(ratio * ratio).epsilon(0.1));
  CHECK(integral_error(80.0) / integral_error(64.0) == Approx(ratio * ratio).epsilon(0.15));
  CHECK(error(80.0) < 2e-3);
  CHECK(error(20.0) < error(80.0) / 10.0);
}

TEST_CASE("halving short steps divides the error by sixteen, in the state and in its integral, knots or none",
          "[fast]") {
  // y' = -y + sin t from 2: y = (sin t - cos t)/2 + 5/2 exp(-t), its integral from 0 below.
  constexpr double kDuration_s = 6.0;
  const double y = 0.5 * (std::sin(kDuration_s) - std::cos(kDuration_s)) + 2.5 * std::exp(-kDuration_s);
  const double integral =
      -0.5 * (std::cos(kDuration_s) + std::sin(kDuration_s)) + 0.5 + 2.5 * (1.0 - std::exp(-kDuration_s));
  const auto run = [&](double step_s, std::size_t segments) {
    LambdaSystem system({2.0}, [](double t, const double* now, double* r) { r[0] = -now[0] + std::sin(t); });
    sim::StabilizedIntegrator<double> integrator(system);
    sim::Program program;
    program.phases = {tests::plain_phase(kDuration_s / static_cast<double>(segments), step_s)};
    program.phases[0].segments.resize(segments, program.phases[0].segments[0]);
    return sim::simulate<double>(system, integrator, program);
  };
  for (const std::size_t segments : {std::size_t{1}, std::size_t{12}}) {
    const auto coarse = run(0.05, segments), fine = run(0.025, segments);
    CHECK((coarse.final_state[0] - y) / (fine.final_state[0] - y) == Approx(16.0).margin(1.5));
    CHECK((coarse.final_integrals[0] - integral) / (fine.final_integrals[0] - integral) == Approx(16.0).margin(1.5));
  }
}

TEST_CASE("a short step takes four evaluations", "[fast]") {
  const auto count = [](double step_s, std::size_t segments) {
    int evaluations = 0;
    LambdaSystem system({1.0}, [&](double, const double* y, double* r) {
      ++evaluations;
      r[0] = -y[0] / 600.0;
    });
    sim::StabilizedIntegrator<double> integrator(system);
    sim::Program program;
    program.phases = {tests::plain_phase(1.0, step_s)};
    program.phases[0].segments.resize(segments, program.phases[0].segments[0]);
    sim::simulate<double>(system, integrator, program);
    return evaluations;
  };
  CHECK(count(1.0, 20) == 20 * 4);
  CHECK(count(0.1, 20) == 20 * 10 * 4);
}

TEST_CASE("means within short steps are of order three", "[fast]") {
  // The rows of a drive cycle: means over half a step to either side of a knot. y and its integral as above.
  const auto find_error = [](double step_s) {
    LambdaSystem system({2.0}, [](double t, const double* now, double* r) { r[0] = -now[0] + std::sin(t); });
    sim::StabilizedIntegrator<double> integrator(system);
    sim::Program program;
    program.sample_interval_s = step_s;
    program.phases = {tests::plain_phase(step_s, step_s)};
    program.phases[0].segments.resize(static_cast<std::size_t>(std::lround(4.0 / step_s)),
                                      program.phases[0].segments[0]);
    const sim::Recording<double> made = sim::simulate<double>(system, integrator, program);
    const auto integral = [](double t) { return -0.5 * (std::cos(t) + std::sin(t)) - 2.5 * std::exp(-t); };
    double largest = 0.0;
    for (std::size_t row = 1; row + 1 < made.time_s.size(); ++row) {
      const double t = made.time_s[row];
      const double mean = (integral(t + 0.5 * step_s) - integral(t - 0.5 * step_s)) / step_s;
      largest = std::max(largest, std::abs(made.channel("mean_y0")[row] - mean));
    }
    return largest;
  };
  CHECK(find_error(0.1) / find_error(0.05) > 7.0);
  CHECK(find_error(0.05) < 1e-6);
}

TEST_CASE("at the ends of steps of up to 10 s, the state is that of the classical rule to the bit", "[fast]") {
  for (const double step_s : {0.3, 1.0, 2.0, 10.0}) {
    LambdaSystem system = slowly_driven();
    sim::FixedGridIntegrator<double> integrator(system);
    sim::Program program;
    program.phases = {tests::plain_phase(600.0, step_s)};
    CHECK(run_stabilized(slowly_driven(), step_s, 600.0).final_state[0] ==
          sim::simulate<double>(system, integrator, program).final_state[0]);
  }
}

TEST_CASE("a state that is forty times faster than the step stays where it belongs", "[fast]") {
  // y1 follows y0, whose time constant is 2000 s, with one of 3.6 s: the fastest that is allowed for.
  constexpr double kFast_s = 3.6;
  constexpr double kSlow_s = 2000.0;
  const auto make = [] {
    return LambdaSystem({1.0, 1.5}, [](double, const double* y, double* r) {
      r[0] = -y[0] / kSlow_s;
      r[1] = (y[0] - y[1]) / kFast_s;
    });
  };
  for (const double step_s : {20.0, 37.0, 80.0, 160.0}) {
    INFO(step_s << " s");
    const sim::Recording<double> made = run_stabilized(make(), step_s, 9600.0);
    const double slow = std::exp(-9600.0 / kSlow_s);
    CHECK(made.final_state[0] == Approx(slow).epsilon(0.01));
    CHECK(made.final_state[1] == Approx(slow / (1.0 - kFast_s / kSlow_s)).epsilon(0.02));
  }
}

TEST_CASE("what is stable in the longest classical step is stable in longer ones", "[fast]") {
  constexpr double kLongest_s = 5.0;
  for (const double rate_per_s : {0.1, 0.3, 0.55}) {
    for (const double step_s : {10.0, 20.0, 80.0, 320.0}) {
      INFO(rate_per_s << "/s, " << step_s << " s");
      LambdaSystem system({1.0}, [rate_per_s](double, const double* y, double* r) { r[0] = -rate_per_s * y[0]; });
      sim::StabilizedIntegrator<double> integrator(system, kLongest_s);
      sim::Program program;
      program.phases = {tests::plain_phase(64000.0, step_s)};
      CHECK(std::abs(sim::simulate<double>(system, integrator, program).final_state[0]) < 1e-6);
    }
  }
}

TEST_CASE("a Chebyshev rule is consistent, and stable on its whole interval", "[fast]") {
  for (int stages = 2; stages <= 12; ++stages) {
    INFO(stages << " stages");
    const sim::ChebyshevRule rule(stages);
    REQUIRE(rule.stages.size() == static_cast<std::size_t>(stages));
    CHECK(rule.stages.back().time == Approx(1.0));
    const auto amplify = [&](double z) {
      double before_last = 1.0, before = 1.0;
      for (const sim::ChebyshevRule::Stage& stage : rule.stages) {
        const double made = (1.0 - stage.before - stage.before_last) + stage.before * before +
                            stage.before_last * before_last + z * (stage.rate * before + stage.first_rate);
        before_last = before;
        before = made;
      }
      return before;
    };
    const double end = -0.653 * (stages * stages - 1.0);
    for (int i = 1; i <= 200; ++i) CHECK(std::abs(amplify(end * i / 200.0)) < 1.0);
    // Order 2: exp(z) - R(z) falls with z^3.
    const auto lack = [&](double z) { return std::abs(std::exp(z) - amplify(z)); };
    CHECK(lack(-0.02) / lack(-0.01) == Approx(8.0).epsilon(0.05));
  }
}

TEST_CASE("the longer the step, the fewer evaluations a second", "[fast]") {
  const auto count = [](double step_s) {
    int evaluations = 0;
    LambdaSystem system({1.0}, [&](double, const double* y, double* r) {
      ++evaluations;
      r[0] = -y[0] / 600.0;
    });
    run_stabilized(system, step_s, 4800.0);
    return evaluations;
  };
  CHECK(count(10.0) == 4 * 480 + 1);
  CHECK(count(80.0) <= count(10.0) / 4);
}
