#include "sim/held_steps.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/simulate.h"
#include "sim/stabilized_integrator.h"
#include "tests/support/lambda_system.h"

using namespace rollrig;
using sim::Segment;
using tests::LambdaSystem;

namespace {

constexpr double kFirst_s = 5.0;
constexpr double kMost_s = 320.0;

Segment held(double duration_s, double value) { return {duration_s, {{value, 0.0}}}; }

sim::Phase make_phase(const std::vector<Segment>& segments) {
  sim::Phase phase;
  phase.max_step_s = kFirst_s;
  phase.segments = segments;
  return phase;
}

/// The steps of a phase: where each begins, counted from the phase's start, and how long it is. From the times at which
/// a system is evaluated, of each step the start, the middle and the end.
struct Step {
  double start_s;
  double length_s;
};
std::vector<Step> list_steps(const std::vector<Segment>& segments) {
  sim::Program program;
  program.phases = {make_phase(segments)};
  program.sample_interval_s = program.duration_s();
  std::vector<double> times_s;
  LambdaSystem system({0.0}, [&times_s](double t_s, const double*, double* r) {
    times_s.push_back(t_s);
    r[0] = 0.0;
  });
  sim::FixedGridIntegrator<double> integrator(system);
  sim::simulate<double>(system, integrator, sim::lengthen_held_steps(program, kMost_s));
  std::sort(times_s.begin(), times_s.end());
  const auto is_same = [](double a, double b) { return b - a < 1e-6; };
  times_s.erase(std::unique(times_s.begin(), times_s.end(), is_same), times_s.end());
  std::vector<Step> steps;
  for (std::size_t i = 0; i + 2 < times_s.size(); i += 2) {
    CHECK(times_s[i + 1] == Approx(0.5 * (times_s[i] + times_s[i + 2])));
    steps.push_back({times_s[i], times_s[i + 2] - times_s[i]});
  }
  return steps;
}

}  // namespace

TEST_CASE("a step is at most a fortieth of the time since the last change, once that allows more than the first",
          "[fast]") {
  const double duration_s = GENERATE(37.0, 400.0, 401.0, 5000.0, 40000.0);
  double end_s = 0.0;
  for (const Step& step : list_steps({held(duration_s, 1.0)})) {
    CHECK(step.start_s == Approx(end_s).margin(1e-9));
    CHECK(step.length_s <= std::max(kFirst_s, step.start_s / 40.0) * (1.0 + 1e-9));
    CHECK(step.length_s <= kMost_s * (1.0 + 1e-9));
    end_s = step.start_s + step.length_s;
  }
  CHECK(end_s == Approx(duration_s));
  CHECK(list_steps({held(40000.0, 1.0)}).back().length_s > 0.9 * kMost_s);
}

TEST_CASE("steps are short again after a jump or a slope, and in each phase", "[fast]") {
  const auto is_short_after = [](const std::vector<Segment>& segments, double change_s) {
    for (const Step& step : list_steps(segments)) {
      const bool follows = step.start_s >= change_s - 1e-9 && step.start_s < change_s + 79.0 * kFirst_s;
      if (follows && step.length_s > kFirst_s * (1.0 + 1e-9)) return false;
    }
    return true;
  };
  CHECK(is_short_after({held(5000.0, 1.0), held(5000.0, 2.0)}, 5000.0));
  CHECK(is_short_after({held(5000.0, 1.0), {50.0, {{1.0, 0.1}}}, held(5000.0, 6.0)}, 5000.0));
  CHECK_FALSE(is_short_after({held(5000.0, 1.0), held(5000.0, 1.0)}, 5000.0));  // a knot is no change

  sim::Program program;
  program.phases = {make_phase({held(5000.0, 1.0)}), make_phase({held(5000.0, 1.0)})};
  CHECK(sim::lengthen_held_steps(program, kMost_s).phases[1].segments[0].max_step_s == kFirst_s);
}

TEST_CASE("what may end early or asks for steps of its own keeps them", "[fast]") {
  sim::Program program;
  program.phases = {make_phase({held(5000.0, 1.0)}), make_phase({held(5000.0, 1.0)})};
  program.phases[0].until = sim::StopCondition{"y0", 1.0, sim::StopCondition::Direction::kFalling};
  program.phases[1].segments[0].max_step_s = 0.25;
  program.phases.push_back(make_phase({held(5000.0, 1.0)}));
  program.phases[2].segments[0].max_step_s = 60.0;  // more than its phase allows
  const sim::Program longer = sim::lengthen_held_steps(program, kMost_s);
  CHECK(longer.phases[2].segments[0].max_step_s == kFirst_s);
  CHECK(longer.phases[0].max_step_s == kFirst_s);
  CHECK(longer.phases[0].segments.size() == 1);
  CHECK(longer.phases[1].segments.size() == 1);
  CHECK(longer.phases[1].segments[0].max_step_s == 0.25);
}

TEST_CASE("inputs and durations are those of the program", "[fast]") {
  sim::Program program;
  program.phases = {make_phase({held(3000.0, 7.0), {10.0, {{7.0, 0.3}}}, held(777.0, 10.0)})};
  const sim::Program longer = sim::lengthen_held_steps(program, kMost_s);
  CHECK(longer.duration_s() == Approx(program.duration_s()).epsilon(1e-14));
  const auto at = [](const sim::Program& which, double time_s) {
    for (const Segment& part : which.phases[0].segments) {
      if (time_s < part.duration_s) return part.inputs[0].at(time_s);
      time_s -= part.duration_s;
    }
    return which.phases[0].segments.back().inputs[0].at(time_s);
  };
  for (double time_s = 0.5; time_s < 3787.0; time_s += 1.0) CHECK(at(longer, time_s) == Approx(at(program, time_s)));
}

TEST_CASE("a body that cools and a fast one beside it are followed to 1 mK with a fifth of the evaluations", "[fast]") {
  // y0 cools with 1200 s, y1 follows it with 24 s, as tire and gas do. Exact: y1 = a e^(-t/1200) + (y1(0) - a)
  // e^(-t/24).
  constexpr double kSlow_s = 1200.0;
  constexpr double kFast_s = 24.0;
  int evaluations = 0;
  const auto run = [&](double most_s) {
    evaluations = 0;
    LambdaSystem system({40.0, 10.0}, [&](double, const double* y, double* r) {
      ++evaluations;
      r[0] = -y[0] / kSlow_s;
      r[1] = (y[0] - y[1]) / kFast_s;
    });
    sim::StabilizedIntegrator<double> integrator(system, kFirst_s);
    sim::Program program;
    program.phases = {make_phase({{14400.0, {{0.0, 0.0}}}})};
    program.sample_interval_s = 60.0;
    constexpr double kStepsBeforeDoubling = 100.0;  // those of a run
    return sim::simulate<double>(system, integrator, sim::lengthen_held_steps(program, most_s, kStepsBeforeDoubling));
  };
  run(kFirst_s);
  const int before = evaluations;
  const sim::Recording<double> made = run(kMost_s);
  CHECK(evaluations < before / 5);
  const double a = 40.0 / (1.0 - kFast_s / kSlow_s);
  for (std::size_t row = 0; row < made.time_s.size(); ++row) {
    const double slow = std::exp(-made.time_s[row] / kSlow_s);
    CHECK(made.channel("y0")[row] == Approx(40.0 * slow).margin(1e-3));
    CHECK(made.channel("y1")[row] ==
          Approx(a * slow + (10.0 - a) * std::exp(-made.time_s[row] / kFast_s)).margin(1e-3));
  }
}
