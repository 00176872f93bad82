#include "tools/study_tires.h"

#include "rigs/quasi_static_drum.h"
#include "sim/core/assets.h"
#include "sim/fixed_grid_integrator.h"
#include "sim/simulate.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

constexpr double kSteady_min = 180.0;  // leaves less than 0.01 % of the loss of a car's tire
constexpr double kSteadyTruck_min = 480.0;

sim::Phase make_phase(const Step& step, double load_N) {
  sim::Segment segment{step.duration_s, sim::Ramps(rigs::kDrumInputCount)};
  segment.inputs[rigs::index_of(rigs::DrumInput::kSpeed)] = {step.speed_m_s, 0.0};
  segment.inputs[rigs::index_of(rigs::DrumInput::kLoad)] = {load_N, 0.0};
  segment.inputs[rigs::index_of(rigs::DrumInput::kAmbient)] = {step.ambient_K, 0.0};
  segment.inputs[rigs::index_of(rigs::DrumInput::kSurface)] = {step.ambient_K, 0.0};
  sim::Phase phase;
  phase.name = "step";
  phase.segments = {segment};
  return phase;
}

RollingState read_state(const sim::Recording<double>& recording, std::size_t row) {
  namespace q = models::quantities;
  return {recording.channel(q::kRollingResistance)[row], recording.channel("tread_temperature_degC")[row],
          recording.channel(q::kLinerTemperature)[row], recording.channel(q::kCavityPressure)[row]};
}

}  // namespace

void StudyTire::scale_cooling(double factor) {
  const auto thermal = tire.parameters_on(rig.cooling_rig(), models::Baseline::kCombined).thermal;
  models::RigThermal& own = tire.rig_thermal[rig.name];
  own.rest_conductance_W_per_K = factor * thermal.rest_conductance_W_per_K;
  own.speed_conductance_W_s_per_m_K = factor * thermal.speed_conductance_W_s_per_m_K;
}

StudyTire read_study_tire(const std::string& name) {
  return {models::read_tire(read_config(find_asset("tires", name))),
          rigs::read_rig(read_config(find_asset("rigs", "drum_2m")))};
}

TestConditions make_iso_conditions(const StudyTire& tire) {
  TestConditions conditions;
  conditions.load_N = tire.load_N();
  conditions.pressure_Pa = tire.pressure_Pa();
  return conditions;
}

SteadyLoss measure_steady(const StudyTire& tire, const TestConditions& conditions) {
  scenarios::RunSpec spec = make_spec(
      "iso_28580", tire.tire.path,
      {fmt::format("load_N={}", conditions.load_N), fmt::format("pressure_kPa={}", conditions.pressure_Pa / 1e3),
       fmt::format("speed_km_h={}", 3.6 * conditions.speed_m_s),
       fmt::format("ambient_degC={}", conditions.ambient_K - kZeroCelsius_K),
       fmt::format("warm_up_min={}", tire.is_truck() ? kSteadyTruck_min : kSteady_min)});
  spec.tire = tire.tire;
  spec.rig = tire.rig;
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  const std::size_t row = outcome.recording.row_at(number(outcome.result, "end_s") - 1.0);
  return {read_state(outcome.recording, row).loss_N, number(outcome.result, "rolling_resistance_N")};
}

std::vector<RollingState> roll_steps(const StudyTire& tire, double load_N, double cold_pressure_Pa,
                                     const std::vector<Step>& steps, double sample_s) {
  sim::Program program;
  for (const Step& step : steps) program.phases.push_back(make_phase(step, load_N));
  if (sample_s > 0.0) program.sample_interval_s = sample_s;
  models::Corner<double> corner(rigs::make_context(tire.tire, tire.rig, models::Baseline::kCombined), {});
  rigs::RigStart<double> start;
  start.tire_temperature_K = steps.front().ambient_K;
  start.cold_pressure_Pa = cold_pressure_Pa;
  start.ambient_pressure_Pa = tire.rig.environment.ambient_pressure_Pa;
  rigs::QuasiStaticDrum<double> drum(corner, start, false, rigs::Detail::kFull);
  sim::FixedGridIntegrator<double> integrator(drum);
  const sim::Recording<double> recording = sim::simulate<double>(drum, integrator, program);
  std::vector<RollingState> states;
  if (sample_s > 0.0) {
    for (std::size_t row = 0; row < recording.row_count(); ++row) states.push_back(read_state(recording, row));
    return states;
  }
  for (const sim::PhaseSpan& phase : recording.phases) {
    states.push_back(read_state(recording, recording.row_at(phase.end_s - program.sample_interval_s)));
  }
  return states;
}

}  // namespace rollrig::tools
