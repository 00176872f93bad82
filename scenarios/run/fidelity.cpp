#include "scenarios/run/fidelity.h"

#include <algorithm>
#include <utility>

#include "rigs/standstill_grid.h"
#include "sim/cvodes_integrator.h"
#include "sim/held_steps.h"
#include "sim/rosenbrock_integrator.h"
#include "sim/stabilized_integrator.h"

namespace rollrig::scenarios {

namespace {

/// Whether a program is made of many short segments, such as the rows of a drive cycle or of a log: at each of its
/// knots a multistep method would begin anew.
bool has_many_knots(const sim::Program& program) {
  constexpr double kLongSegment_s = 10.0;   // Assumed: from there on CVODES takes less time
  constexpr std::size_t kFewSegments = 30;  // Assumed: below, there is little to save
  std::size_t segments = 0, short_ones = 0;
  for (const sim::Phase& phase : program.phases) {
    for (const sim::Segment& segment : phase.segments) {
      ++segments;
      short_ones += segment.duration_s < kLongSegment_s ? 1 : 0;
    }
  }
  return segments >= kFewSegments && 2 * short_ones > segments;
}

template <class TheIntegrator, class Options>
sim::Recording<double> integrate(sim::OdeSystem<double>& rig, const sim::Program& program, const Options& options,
                                 const sim::Progress& progress, Json& statistics) {
  TheIntegrator integrator(rig, options);
  sim::Recording<double> recording = sim::simulate<double>(rig, integrator, program, progress);
  const sim::IntegratorStatistics counted = integrator.statistics();
  statistics = {{"method", TheIntegrator::kName},
                {"steps", counted.steps},
                {"rate_evaluations", counted.rate_evaluations},
                {"jacobian_evaluations", counted.jacobian_evaluations},
                {"error_test_failures", counted.error_test_failures}};
  return recording;
}

sim::Recording<double> integrate_with(double tolerance_factor, sim::OdeSystem<double>& rig, const sim::Program& program,
                                      const sim::Progress& progress, Json& statistics) {
  if (has_many_knots(program)) {
    sim::RosenbrockOptions options;
    options.tolerance_factor = tolerance_factor;
    return integrate<sim::RosenbrockIntegrator>(rig, program, options, progress, statistics);
  }
  sim::CvodesOptions options;
  options.tolerance_factor = tolerance_factor;
  return integrate<sim::CvodesIntegrator>(rig, program, options, progress, statistics);
}

}  // namespace

sim::Recording<double> run_multibody(sim::OdeSystem<double>& rig, const sim::Program& program, const RunSpec& spec,
                                     double audit_limit, const sim::Progress& progress, Json& statistics) {
  sim::Recording<double> recording;
  for (const double tightening : {1.0, 0.1, 0.01}) {
    const double factor = tightening * spec.tolerance_factor;
    recording = integrate_with(factor, rig, program, progress, statistics);
    statistics["tolerance_factor"] = factor;
    if (recording.audit.is_closed(audit_limit)) break;
  }
  return recording;
}

sim::Recording<double> run_quasi_static(sim::OdeSystem<double>& rig, sim::Program program, std::size_t speed_input,
                                        const RunSpec& spec, const sim::Progress& progress) {
  // Assumed: steps of at most about a quarter of the time in which a tire cools, some 20 min, and a fiftieth of the
  // time since a change. Temperatures of the stored cases are then within 1 mK of those of short steps.
  constexpr double kMost_s = 320.0;
  constexpr double kStepsBeforeDoubling = 100.0;
  const double finer = std::min(1.0, spec.tolerance_factor);
  // What is stable in the steps of a phase stays stable when they grow.
  sim::StabilizedIntegrator<double> integrator(rig, finer * sim::Phase{}.max_step_s);
  sim::Program on_grid = rigs::refine_near_standstill(
      sim::lengthen_held_steps(std::move(program), kMost_s, kStepsBeforeDoubling), speed_input);
  for (sim::Phase& phase : on_grid.phases) {
    phase.max_step_s *= finer;
    for (sim::Segment& segment : phase.segments) segment.max_step_s *= finer;
  }
  return sim::simulate<double>(rig, integrator, on_grid, progress);
}

void apply_sensors(const RunSpec& spec, sim::Recording<double>& recording) {
  if (!spec.sensors.has_value()) return;
  for (const auto& [channel, sensor] : *spec.sensors) {
    models::apply_sensor(sensor, channel, {spec.seed, "session", "run"}, recording.time_s, recording.channel(channel));
  }
}

}  // namespace rollrig::scenarios
