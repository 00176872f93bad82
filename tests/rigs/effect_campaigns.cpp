#include "tests/rigs/effect_campaigns.h"

#include <map>

#include "rigs/trace_effects.h"
#include "tests/support/drum_fixture.h"

namespace rollrig::tests {
namespace {

/// Cold start, two loads, two speeds, skims, rest.
sim::Program drum_program() {
  const double v80 = 80.0 / 3.6;
  const double v120 = 120.0 / 3.6;
  sim::Program program;
  sim::Phase up = rolling("run-up", 60.0, 0.0, 200.0);
  up.segments = {drum_segment(60.0, 0.0, v80, 200.0)};
  sim::Phase faster = rolling("faster", 60.0, v80, 5400.0);
  faster.segments = {drum_segment(60.0, v80, v120, 5400.0)};
  sim::Phase down = rolling("run-down", 60.0, v120, 200.0);
  down.segments = {drum_segment(60.0, v120, 0.0, 200.0)};
  program.phases = {up,
                    rolling("load", 600.0, v80, 5400.0),
                    rolling("skim", 180.0, v80, 200.0),
                    rolling("high load", 300.0, v80, 6865.0),
                    rolling("load again", 60.0, v80, 5400.0),
                    faster,
                    rolling("fast", 300.0, v120, 5400.0),
                    rolling("fast skim", 120.0, v120, 200.0),
                    down,
                    rolling("rest", 300.0, 0.0, 200.0)};
  return program;
}

sim::Recording<Jet> run_drum_with_derivatives(const Effects& effects) {
  DrumFixture fixture;
  models::Corner<Jet> corner(models::convert_context<Jet>(fixture.context()), effects);
  corner.effects()[0].parameters[0] = Jet(corner.effects()[0].parameters[0].a, 0);
  rigs::DrumStart<Jet> start;
  start.tire_temperature_K = Jet(fixture.initial_K);
  start.cold_pressure_Pa = Jet(fixture.cold_pressure_Pa);
  start.ambient_pressure_Pa = Jet(fixture.rig.environment.ambient_pressure_Pa);
  rigs::QuasiStaticDrum<Jet> drum(corner, start, false, rigs::Detail::kMeasured);
  sim::FixedGridIntegrator<Jet> integrator(drum);
  sim::Recording<Jet> recording = sim::simulate<Jet>(drum, integrator, rigs::refine_near_standstill(drum_program()));
  rigs::apply_trace_effects(corner, recording);
  return recording;
}

DrumFixture drum_with(const Effects& effects) {
  DrumFixture fixture;
  fixture.effects = effects;
  return fixture;
}

}  // namespace

const std::set<std::string>& measured_on(models::RigKind kind) {
  static const std::map<models::RigKind, std::set<std::string>> channels{
      {models::RigKind::kDrum, {"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"}},
      {models::RigKind::kDyno, {"loss_force_N", "liner_temperature_degC", "cavity_pressure_kPa"}},
      {models::RigKind::kFlat, {"traction_force_N"}}};
  return channels.at(kind);
}

const std::vector<Campaign>& campaigns() {
  static const std::vector<Campaign> all{
      {models::RigKind::kDrum,
       "drum_torque_Nm",
       {"load", "skim", "fast"},
       [](const Effects& effects) { return drum_with(effects).run_quasi_static(drum_program()); },
       [](const Effects& effects) { return drum_with(effects).run_multibody(drum_program()); },
       run_drum_with_derivatives}};
  return all;
}

}  // namespace rollrig::tests
