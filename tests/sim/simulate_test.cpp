#include "sim/simulate.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "sim/cvodes_integrator.h"
#include "sim/fixed_grid_integrator.h"
#include "tests/support/lambda_system.h"

using namespace rollrig;
using tests::LambdaSystem;

namespace {

LambdaSystem ramp() {  // y = t
  return LambdaSystem({0.0}, [](double, const double*, double* r) { r[0] = 1.0; });
}

/// y' = input: a knot at 10.25 s where the rate jumps from 1 to -3.
sim::Program kinked_program() {
  sim::Program program;
  sim::Phase phase;
  phase.name = "kinked";
  phase.segments = {{10.25, {{1.0, 0.0}}}, {9.75, {{-3.0, 0.0}}}};
  program.phases = {phase};
  return program;
}

double kinked(double t) { return t < 10.25 ? t : 10.25 - 3.0 * (t - 10.25); }
double kinked_integral(double t) {
  return t < 10.25 ? 0.5 * t * t : 0.5 * 10.25 * 10.25 + 10.25 * (t - 10.25) - 1.5 * (t - 10.25) * (t - 10.25);
}

template <class Integrator>
void check_kinked() {
  LambdaSystem system({0.0}, [](double, const double*, double* r) { r[0] = 0.0; });
  Integrator integrator(system);
  const auto recording = sim::simulate<double>(system, integrator, kinked_program());
  REQUIRE(recording.row_count() == 21);
  for (std::size_t i = 0; i < recording.row_count(); ++i) {
    const double t = recording.time_s[i];
    INFO("t = " << t);
    const double from = std::max(0.0, t - 0.5);
    const double to = std::min(20.0, t + 0.5);
    CHECK(recording.channel("y0")[i] == Approx(kinked(t)).margin(1e-6));
    CHECK(recording.channel("mean_y0")[i] ==
          Approx((kinked_integral(to) - kinked_integral(from)) / (to - from)).margin(1e-6));
  }
}

}  // namespace

TEST_CASE("rows hold instants and centered means, also across a knot and at both ends", "[fast]") {
  check_kinked<sim::FixedGridIntegrator<double>>();
  check_kinked<sim::CvodesIntegrator>();
}

TEST_CASE("the rows of a stride are those of a run without one, however long the steps", "[fast]") {
  const auto run = [](int stride, double step_s) {
    LambdaSystem system({1.0}, [](double, const double* y, double* r) { r[0] = -y[0] / 300.0; });
    sim::FixedGridIntegrator<double> integrator(system);
    sim::Program program;
    program.sample_interval_s = 1.0;
    program.phases = {tests::plain_phase(200.5, step_s), tests::plain_phase(90.0, step_s)};
    program.phases[0].segments.push_back(program.phases[0].segments[0]);
    program.phases[0].row_stride = stride;
    return sim::simulate<double>(system, integrator, program);
  };
  const int stride = GENERATE(2, 3, 7, 60, 401, 1000);
  const double step_s = GENERATE(0.7, 5.0, 40.0);
  INFO("stride " << stride << ", steps of " << step_s << " s");
  const sim::Recording<double> all = run(1, step_s), some = run(stride, step_s);
  std::size_t row = 0;
  for (std::size_t i = 0; i < all.time_s.size(); ++i) {
    if (all.phase[i] == 0 && i % static_cast<std::size_t>(stride) != 0) continue;
    REQUIRE(row < some.time_s.size());
    CHECK(some.time_s[row] == all.time_s[i]);
    CHECK(some.phase[row] == all.phase[i]);
    CHECK(some.channel("y0")[row] == all.channel("y0")[i]);
    CHECK(some.channel("mean_y0")[row] == Approx(all.channel("mean_y0")[i]).epsilon(1e-12));
    ++row;
  }
  CHECK(row == some.time_s.size());
}

TEST_CASE("a stride writes every so many rows, with means over the base interval", "[fast]") {
  LambdaSystem system = ramp();
  sim::FixedGridIntegrator<double> integrator(system);
  sim::Program program;
  program.start_time_s = -120.0;
  program.phases = {tests::plain_phase(120.0), tests::plain_phase(5.0)};
  program.phases[0].row_stride = 60;
  const auto recording = sim::simulate<double>(system, integrator, program);
  CHECK(recording.time_s == std::vector<double>{-120.0, -60.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0});
  CHECK(recording.phase == std::vector<std::size_t>{0, 0, 1, 1, 1, 1, 1, 1});
  CHECK(recording.channel("mean_y0")[1] == Approx(60.0));
  CHECK(recording.channel("mean_y0")[2] == Approx(120.0));
  CHECK(recording.channel("mean_y0").back() == Approx(124.75));  // half an interval at the end
}

TEST_CASE("samples may lie at times of their own", "[fast]") {
  LambdaSystem system = ramp();
  sim::FixedGridIntegrator<double> integrator(system);
  sim::Program program;
  program.sample_times_s = {0.0, 1.0, 3.0, 7.0};
  program.phases = {tests::plain_phase(7.0)};
  const auto recording = sim::simulate<double>(system, integrator, program);
  CHECK(recording.time_s == program.sample_times_s);
  // means from half-way to half-way: [0, 0.5], [0.5, 2], [2, 5], [5, 7]
  CHECK(recording.channel("mean_y0")[0] == Approx(0.25));
  CHECK(recording.channel("mean_y0")[1] == Approx(1.25));
  CHECK(recording.channel("mean_y0")[2] == Approx(3.5));
  CHECK(recording.channel("mean_y0")[3] == Approx(6.0));
}

TEST_CASE("samples that lie a nanosecond apart are all there, the last ones too", "[fast]") {
  LambdaSystem system = ramp();
  sim::FixedGridIntegrator<double> integrator(system);
  for (const double step_s : {1e-12, 3e-10, 1e-9}) {
    INFO("step " << step_s << " s");
    sim::Program program;
    for (int row = 0; row < 5; ++row) program.sample_times_s.push_back(step_s * row);
    sim::Phase phase = tests::plain_phase(0.0);
    phase.segments.front().duration_s = program.sample_times_s.back();
    program.phases = {phase};
    const auto recording = sim::simulate<double>(system, integrator, program);
    CHECK(recording.time_s == program.sample_times_s);
    for (const std::vector<double>& column : recording.values) CHECK(column.size() == program.sample_times_s.size());
  }
}

TEST_CASE("a phase that ends early is followed by the next, and commands act at its start", "[fast]") {
  LambdaSystem system = ramp();
  sim::CvodesIntegrator integrator(system);
  sim::Program program;
  program.phases = {tests::plain_phase(100.0), tests::plain_phase(3.0)};
  program.phases[0].until = sim::StopCondition{"y0", 4.5, sim::StopCondition::Direction::kRising};
  program.phases[1].commands = {{"add", 10.0}};
  const auto recording = sim::simulate<double>(system, integrator, program);
  CHECK(recording.phases[0].end_s == Approx(4.5).margin(1e-6));
  CHECK(recording.phases[1].end_s == Approx(7.5).margin(1e-6));
  CHECK(recording.final_state[0] == Approx(17.5).margin(1e-5));
  CHECK(recording.channel("y0")[5] == Approx(15.0).margin(1e-5));  // at 5 s, half a second into the second phase
}

TEST_CASE("progress rises to one", "[fast]") {
  LambdaSystem system = ramp();
  sim::FixedGridIntegrator<double> integrator(system);
  sim::Program program;
  program.phases = {tests::plain_phase(10.0, 1.0)};
  double last = 0.0;
  sim::simulate<double>(system, integrator, program, [&last](double done) {
    CHECK(done > last);
    last = done;
  });
  CHECK(last == Approx(1.0));
}
