#include "tests/support/vehicle_fixture.h"

#include "rigs/trace_effects.h"
#include "sim/core/assets.h"
#include "sim/rosenbrock_integrator.h"

namespace rollrig::tests {

VehicleFixture::VehicleFixture(const std::string& rig_name, bool is_whole, std::size_t quarter_wheel)
    : rig(rigs::read_rig(read_config(find_asset("rigs", rig_name)))), whole(is_whole), quarter(quarter_wheel) {}

void VehicleFixture::take_losses_away() {
  baseline = models::Baseline::kConstantRrc;
  tire.has_constant = true;
  tire.values.constant.rrc = 0.0;
  rig.parasitic = {};
}

rigs::VehicleLayout VehicleFixture::layout() const {
  const double ambient_K = rig.environment.ambient_K;
  return whole ? rigs::make_whole_vehicle(vehicle, rig, ambient_K, set_load)
               : rigs::make_one_wheel(vehicle, rig, ambient_K, set_load, quarter);
}

std::vector<models::Corner<double>> VehicleFixture::corners() const {
  std::vector<models::Corner<double>> list;
  for (const rigs::WheelPlace& wheel : layout().wheels) {
    list.emplace_back(context_of(vehicle.axles[wheel.axle]), effects);
  }
  return list;
}

rigs::RigStart<double> VehicleFixture::start() const {
  rigs::RigStart<double> at;
  at.tire_temperature_K = 293.15;
  at.cold_pressure_Pa = cold_pressure_Pa;
  at.ambient_pressure_Pa = rig.environment.ambient_pressure_Pa;
  return at;
}

namespace {

template <class TheIntegrator, class Options>
sim::Recording<double> integrate(const VehicleFixture& fixture, const sim::Program& program, const Options& options) {
  std::vector<models::Corner<double>> at = fixture.corners();
  const auto system = rigs::make_multibody_vehicle(at, fixture.layout(), fixture.start(), false);
  TheIntegrator integrator(*system, options);
  sim::Recording<double> recording = sim::simulate<double>(*system, integrator, program);
  rigs::apply_trace_effects(at.front(), recording);
  return recording;
}

}  // namespace

sim::Recording<double> VehicleFixture::run_multibody(const sim::Program& program) const {
  return integrate<sim::CvodesIntegrator>(*this, program, cvodes);
}

sim::Recording<double> VehicleFixture::run_multibody_rosenbrock(const sim::Program& program) const {
  return integrate<sim::RosenbrockIntegrator>(*this, program, sim::RosenbrockOptions{});
}

sim::Recording<double> VehicleFixture::run_quasi_static(const sim::Program& program) const {
  std::vector<models::Corner<double>> at = corners();
  rigs::QuasiStaticVehicle<double> system(at, layout(), start(), false);
  sim::FixedGridIntegrator<double> integrator(system);
  sim::Recording<double> recording = sim::simulate<double>(system, integrator, program);
  rigs::apply_trace_effects(at.front(), recording);
  return recording;
}

sim::Segment vehicle_segment(double duration_s, double speed_start_m_s, double speed_end_m_s, double slope,
                             double wind_m_s) {
  using rigs::VehicleInput;
  sim::Segment segment{duration_s, sim::Ramps(rigs::kVehicleInputCount)};
  if (speed_end_m_s != speed_start_m_s) segment.max_step_s = 0.2;  // knees of the brakes' blending
  const auto put = [&segment](VehicleInput input, double start, double slope_per_s = 0.0) {
    segment.inputs[rigs::index_of(input)] = {start, slope_per_s};
  };
  put(VehicleInput::kSpeed, speed_start_m_s, (speed_end_m_s - speed_start_m_s) / duration_s);
  put(VehicleInput::kAmbient, 293.15);
  put(VehicleInput::kSurface, 293.15);
  put(VehicleInput::kSlope, slope);
  put(VehicleInput::kWind, wind_m_s);
  put(VehicleInput::kCounted, 1.0);
  return segment;
}

sim::Phase driving(const std::string& name, double duration_s, double speed_start_m_s, double speed_end_m_s,
                   double slope) {
  sim::Phase phase;
  phase.name = name;
  phase.segments = {vehicle_segment(duration_s, speed_start_m_s, speed_end_m_s, slope)};
  phase.commands = {{rigs::kDrive, 1.0}};
  return phase;
}

sim::Phase coasting(double start_m_s, double end_m_s, double longest_s, double slope, double wind_m_s) {
  sim::Phase phase;
  phase.name = "coast";
  phase.segments = {vehicle_segment(longest_s, start_m_s, start_m_s, slope, wind_m_s)};
  phase.commands = {{rigs::kDrive, 0.0}};
  phase.max_step_s = 1.0;
  phase.until = sim::StopCondition{rigs::kWatchSpeed, end_m_s, sim::StopCondition::Direction::kFalling};
  return phase;
}

sim::Program make_program(std::vector<sim::Phase> phases) {
  sim::Program program;
  program.phases = std::move(phases);
  return program;
}

double find_total(const sim::Recording<double>& recording, rigs::VehicleIntegral integral) {
  return recording.final_integrals[rigs::index_of(integral)];
}

}  // namespace rollrig::tests
