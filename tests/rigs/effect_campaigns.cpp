#include "tests/rigs/effect_campaigns.h"

#include "rigs/standstill_grid.h"
#include "rigs/trace_effects.h"
#include "scenarios/common/vehicle_bench.h"
#include "sim/core/assets.h"
#include "tests/support/vehicle_fixture.h"

namespace rollrig::tests {
namespace {

/// Cold start, two loads, two speeds, skims, less pressure, rest.
sim::Program drum_program() {
  const double v80 = 80.0 / 3.6;
  const double v120 = 120.0 / 3.6;
  sim::Program program;
  sim::Phase up = rolling("run-up", 60.0, 0.0, 200.0);
  up.segments = {drum_segment(60.0, 0.0, v80, 200.0)};
  sim::Phase faster = rolling("faster", 60.0, v80, 5400.0);
  faster.segments = {drum_segment(60.0, v80, v120, 5400.0)};
  sim::Phase softer = rolling("less pressure", 240.0, v80, 5400.0);
  softer.commands = {{rigs::kSetPressure, 220e3}};
  sim::Phase down = rolling("run-down", 120.0, v120, 200.0);
  down.segments = {drum_segment(120.0, v120, 0.0, 200.0)};
  program.phases = {up,
                    rolling("load", 600.0, v80, 5400.0),
                    rolling("skim", 180.0, v80, 200.0),
                    rolling("high load", 300.0, v80, 6865.0),
                    softer,
                    rolling("load again", 60.0, v80, 5400.0),
                    faster,
                    rolling("fast", 300.0, v120, 5400.0),
                    rolling("fast skim", 120.0, v120, 200.0),
                    down,
                    rolling("rest", 300.0, 0.0, 200.0)};
  return program;
}

/// The tire with another model, and what the constant coefficient needs beside its file.
template <class Fixture>
void choose_model(const std::string& model, Fixture& fixture) {
  fixture.tire.values.own = make_own(model);
  fixture.tire.has_constant = true;
  fixture.tire.values.constant.rrc = 0.0075;
}

DrumFixture drum_with(const std::string& rig, const Effects& effects, const std::string& model) {
  DrumFixture fixture;
  fixture.rig = rigs::read_rig(read_config(find_asset("rigs", rig)));
  choose_model(model, fixture);
  fixture.effects = effects;
  return fixture;
}

sim::Recording<Jet> run_drum_with_derivatives(const std::string& rig, const Effects& effects,
                                              const std::string& model) {
  const DrumFixture fixture = drum_with(rig, effects, model);
  models::Corner<Jet> corner(models::convert_context<Jet>(fixture.context()), effects);
  corner.effects()[0].parameters[0] = Jet(corner.effects()[0].parameters[0].a, 0);
  rigs::RigStart<Jet> start;
  start.tire_temperature_K = Jet(fixture.initial_K);
  start.cold_pressure_Pa = Jet(fixture.cold_pressure_Pa);
  start.ambient_pressure_Pa = Jet(fixture.rig.environment.ambient_pressure_Pa);
  rigs::QuasiStaticDrum<Jet> drum(corner, start, false, rigs::Detail::kFull);  // trace effects read the load
  sim::FixedGridIntegrator<Jet> integrator(drum);
  sim::Recording<Jet> recording = sim::simulate<Jet>(
      drum, integrator, rigs::refine_near_standstill(drum_program(), rigs::index_of(rigs::DrumInput::kSpeed)));
  rigs::apply_trace_effects(corner, recording);
  return recording;
}

EffectCampaign make_tire_campaign(Machine kind, const std::string& rig) {
  return {kind,
          kind->traits.force.header(),
          {"load", "skim", "fast"},
          sim::kAuditLimit,
          [rig](const Effects& effects, const std::string& model) {
            return drum_with(rig, effects, model).run_quasi_static(drum_program());
          },
          [rig](const Effects& effects, const std::string& model) {
            return drum_with(rig, effects, model).run_multibody(drum_program());
          },
          [rig](const Effects& effects, const std::string& model) {
            return run_drum_with_derivatives(rig, effects, model);
          }};
}

constexpr double kLoadShare = 0.55;  // of the axle, so that the wheel's load is not the tire's reference load

constexpr double kDynoPressure_Pa = 230e3;  // other than the tire's reference pressure

/// A driven quarter at the rear: 1.2 kN of drive and 1.6 kN of friction brake force at the wheel.
VehicleFixture dyno_with(const Effects& effects, const std::string& model) {
  VehicleFixture fixture("dyno_1m2", false, tests::kRear);
  choose_model(model, fixture);
  tests::set_front_load(fixture.vehicle, 1.0 - kLoadShare);
  tests::set_front_brakes(fixture.vehicle, 0.3);
  fixture.cold_pressure_Pa = kDynoPressure_Pa;
  fixture.effects = effects;
  return fixture;
}

/// Cold start, ramps, brakings beyond what the motor takes, fast stretches, rest.
sim::Program dyno_program() {
  const double v50 = 50.0 / 3.6;
  const double v120 = 120.0 / 3.6;
  const double v130 = 130.0 / 3.6;
  return make_program({driving("run-up", 30.0, 0.0, v120), driving("fast", 400.0, v120, v120),
                       driving("brake", 6.0, v120, v50), driving("slow", 240.0, v50, v50),
                       driving("faster", 20.0, v50, v130), driving("fastest", 400.0, v130, v130),
                       driving("stop", 12.0, v130, 0.0), driving("rest", 120.0, 0.0, 0.0),
                       driving("start", 15.0, 0.0, v50), driving("slow again", 300.0, v50, v50)});
}

/// A driven quarter at the front that hardly recuperates, so that moderate braking heats its brake.
VehicleFixture road_with(const Effects& effects, const std::string& model) {
  VehicleFixture fixture("road", false, tests::kFront);
  choose_model(model, fixture);
  tests::set_front_drive(fixture.vehicle, 1.0);
  tests::set_front_load(fixture.vehicle, kLoadShare);
  fixture.vehicle.powertrain.regeneration_limit_m_s2 = 0.1;
  fixture.effects = effects;
  return fixture;
}

/// Cold start, then fast stretches with brakings between them; forces stay under 1 kN at the wheel.
sim::Program road_program() {
  const double v40 = 40.0 / 3.6;
  const double v120 = 120.0 / 3.6;
  std::vector<sim::Phase> phases{driving("run-up", 60.0, 0.0, v120), driving("fast", 300.0, v120, v120)};
  for (const char* time : {"1", "2", "3", "4"}) {
    phases.push_back(driving(std::string("brake ") + time, 25.0, v120, v40));
    phases.push_back(driving(std::string("faster ") + time, 45.0, v40, v120));
  }
  phases.push_back(driving("fast again", 300.0, v120, v120));
  phases.push_back(driving("stop", 40.0, v120, 0.0));
  phases.push_back(driving("rest", 120.0, 0.0, 0.0));
  phases.push_back(driving("start", 20.0, 0.0, v40));
  phases.push_back(driving("slow", 300.0, v40, v40));
  return make_program(phases);
}

sim::Recording<Jet> run_vehicle_with_derivatives(const VehicleFixture& fixture, const sim::Program& program) {
  const rigs::VehicleLayout layout = fixture.layout();
  std::vector<models::Corner<Jet>> corners(
      layout.wheels.size(), models::Corner<Jet>(models::convert_context<Jet>(fixture.context()), fixture.effects));
  for (models::Corner<Jet>& corner : corners) {
    corner.effects()[0].parameters[0] = Jet(corner.effects()[0].parameters[0].a, 0);
  }
  const rigs::RigStart<double> at = fixture.start();
  rigs::RigStart<Jet> start;
  start.tire_temperature_K = Jet(at.tire_temperature_K);
  start.cold_pressure_Pa = Jet(at.cold_pressure_Pa);
  start.ambient_pressure_Pa = Jet(at.ambient_pressure_Pa);
  rigs::QuasiStaticVehicle<Jet> vehicle(corners, layout, start, false);
  sim::FixedGridIntegrator<Jet> integrator(vehicle);
  sim::Recording<Jet> recording = sim::simulate<Jet>(vehicle, integrator, program);
  rigs::apply_trace_effects(corners.front(), recording);
  return recording;
}

}  // namespace

std::set<std::string> measured_on(tests::Machine kind) {
  const std::vector<std::string> all = list_headers(rigs::measured_channels(*kind));
  std::set<std::string> channels(all.begin(), all.end());
  channels.erase("gas_temperature_degC");  // beside the format's list
  channels.erase("speed_reading_km_h");    // of the wheel on its roller; a vehicle records none
  return channels;
}

const std::vector<EffectCampaign>& campaigns() {
  static const std::vector<EffectCampaign> all{
      make_tire_campaign(tests::kDrum, "drum_2m"),
      make_tire_campaign(tests::kFlatBelt, "flat_belt"),
      {tests::kDyno,
       "loss_force_N",
       {"fast", "slow", "fastest", "slow again"},
       scenarios::kDriveAuditLimit,
       [](const Effects& effects, const std::string& model) {
         return dyno_with(effects, model).run_quasi_static(dyno_program());
       },
       [](const Effects& effects, const std::string& model) {
         return dyno_with(effects, model).run_multibody(dyno_program());
       },
       [](const Effects& effects, const std::string& model) {
         return run_vehicle_with_derivatives(dyno_with(effects, model), dyno_program());
       }},
      {tests::kRoad,
       "traction_force_N",
       {"fast", "fast again", "slow"},
       scenarios::kDriveAuditLimit,
       [](const Effects& effects, const std::string& model) {
         return road_with(effects, model).run_quasi_static(road_program());
       },
       [](const Effects& effects, const std::string& model) {
         return road_with(effects, model).run_multibody(road_program());
       },
       [](const Effects& effects, const std::string& model) {
         return run_vehicle_with_derivatives(road_with(effects, model), road_program());
       }}};
  return all;
}

}  // namespace rollrig::tests
