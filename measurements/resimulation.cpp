#include "measurements/resimulation.h"

#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "models/reference_conditions.h"
#include "rigs/quasi_static_drum.h"
#include "rigs/recorded_road.h"
#include "rigs/recorded_roller.h"
#include "rigs/standstill_grid.h"
#include "rigs/trace_effects.h"
#include "sim/core/error.h"
#include "sim/held_steps.h"
#include "sim/lagged_midpoint_integrator.h"
#include "sim/simulate.h"
#include "sim/stabilized_integrator.h"

namespace rollrig::measurements {
namespace {

namespace quantities = models::quantities;
using rigs::DrumInput;

/// Parameters of a tire on the road, under a load and at a pressure.
models::TireParameters<double> find_parameters(const models::TireFile& tire, models::Baseline baseline, double load_N,
                                               double pressure_Pa) {
  if (baseline == models::Baseline::kConstantRrc) return tire.parameters_with_class_values(load_N, pressure_Pa);
  static const rigs::RigFile road = rigs::find_kind_without_rig(&models::is_on_road).make_rig();
  return tire.parameters_on(road.cooling_rig(), baseline);
}

}  // namespace

double find_tire_load_N(const rigs::VehicleFile& vehicle) {
  return vehicle.body.mass_kg * kStandardGravity_m_s2 / vehicle.count_wheels();
}

models::Context<double> make_context(const MeasurementSet& set) {
  if (is_indoors(set.kind->traits)) return rigs::make_context(set.tire, *set.rig, set.baseline);
  if (!set.vehicle.has_value()) {
    throw InputError({"a set of the road has no vehicle", set.path, 0, "vehicle", "", "a vehicle's name or path", ""});
  }
  const rigs::VehicleFile& vehicle = *set.vehicle;
  if (vehicle.road_load.has_value()) {
    throw InputError({"a vehicle that is given by its road load has no tires to tell of", vehicle.path, 0,
                      "[road_load]", "", "drag_area_m2 instead, with the tire of the set", ""});
  }
  const double load_N = find_tire_load_N(vehicle);
  const double pressure_Pa = set.runs.front().cold_pressure_Pa;
  for (const rigs::VehicleAxle& axle : vehicle.axles)
    find_parameters(rigs::tire_of(axle, set.tire), set.baseline, load_N, pressure_Pa);  // throws
  models::Context<double> context;
  context.machine = set.kind->traits;
  context.vehicle = vehicle.body;
  context.tire = find_parameters(set.tire, set.baseline, load_N, pressure_Pa);
  return context;
}

namespace {

/// Temperature, pressure and history that a run states of its beginning.
template <class S>
rigs::RigStart<S> make_start(const MeasuredRun& run, double ambient_pressure_Pa) {
  rigs::RigStart<S> start;
  start.tire_temperature_K = S(run.initial_tire_temperature_K);
  start.cold_pressure_Pa = S(run.cold_pressure_Pa);
  start.ambient_pressure_Pa = S(ambient_pressure_Pa);
  start.set_history(run.started_warm, run.rest_before_s);
  return start;
}

/// The corner with another tire.
template <class S>
models::Corner<S> put_on_tire(const models::Corner<S>& corner, const models::TireParameters<double>& tire) {
  models::Context<S> context = corner.context();
  context.tire = models::convert_tire<S>(tire);
  std::vector<models::ActiveEffect> effects;
  for (const auto& on : corner.effects()) effects.push_back({on.effect, std::vector<double>(on.parameters.size())});
  models::Corner<S> other(std::move(context), effects);
  for (std::size_t i = 0; i < effects.size(); ++i) other.effects()[i].parameters = corner.effects()[i].parameters;
  return other;
}

/// Temperature of a vehicle's tire in steady driving at 80 km/h under its static load. Assumed: at the cold pressure,
/// which a warm tire exceeds by some 10 %, so that it would lose 4 % less.
template <class S>
S calc_warm_temperature_K(const rigs::RoadTireGroup<S>& tires) {
  const S speed_m_s = models::get_reference_speed_m_s<S>();
  const S cooling_W_per_K = models::calc_cooling_W_per_K(tires.corner->context().tire.thermal, speed_m_s);
  S warm_K = tires.temperature_K;
  constexpr int kRounds = 20;  // each takes about a third of the error
  for (int i = 0; i < kRounds; ++i) {
    const S loss_N = tires.corner->calc_law_N(speed_m_s, tires.load_N, S(tires.pressure_Pa), warm_K);
    warm_K = tires.temperature_K + loss_N * speed_m_s / cooling_W_per_K;
  }
  return warm_K;
}

/// The tires of a set's vehicle when the run begins; `corners` receives those of tires that are not the set's.
template <class S>
std::vector<rigs::RoadTireGroup<S>> find_groups(const MeasurementSet& set, const MeasuredRun& run,
                                                models::Corner<S>& corner, std::deque<models::Corner<S>>& corners) {
  std::vector<rigs::RoadTireGroup<S>> made;
  for (const rigs::TireGroup& group : rigs::group_tires(*set.vehicle, run.cold_pressure_Pa)) {
    const S load_N = corner.context().vehicle.mass_kg * S(kStandardGravity_m_s2 * group.load_share / group.count);
    rigs::RoadTireGroup<S> tires{&corner, group.count, load_N, group.pressure_Pa, S(run.initial_tire_temperature_K)};
    if (group.axle->tire.has_value()) {
      corners.push_back(
          put_on_tire(corner, find_parameters(*group.axle->tire, set.baseline, value_of(load_N), group.pressure_Pa)));
      tires.corner = &corners.back();
    }
    const bool is_warm = run.started_warm && tires.corner->context().tire.model().info.loss_follows_heat;
    if (is_warm) tires.temperature_K = calc_warm_temperature_K(tires);
    made.push_back(std::move(tires));
  }
  return made;
}

/// Effects of the port "trace", beside the recorded inputs that they may read.
template <class S>
void apply_trace_beside_given(const MeasuredRun& run, const models::Corner<S>& corner, sim::Recording<S>& recording) {
  if (!rigs::has_trace_effects(corner)) return;
  for (const Quantity& quantity : {quantities::kSpeed, quantities::kLoad, quantities::kAmbient}) {
    if (!run.has(quantity)) continue;
    const std::vector<double>& given = run.column(quantity);
    recording.channels.push_back({quantity});
    recording.values.emplace_back(given.begin(), given.end());
  }
  rigs::apply_trace_effects(corner, recording);
}

template <class S, template <class> class Integrator, class Machine>
sim::Recording<S> run_on(Machine&& machine, const sim::Program& program) {
  Integrator<S> integrator(machine);
  return sim::simulate<S>(machine, integrator, program);
}

/// While speed and load are constant. Assumed: from 10 s, two fifths of the gas's time constant, to 80 s.
constexpr sim::StepGrowth kHeldSteps{10.0, 80.0};

/// Steps for the integrator. Assumed: while the speed changes, at most 10 s, and at most the time in which it changes
/// by 0.75 m/s, less than a quarter of the 12 km/h below which an error of the recorded speed matters most
/// (models/effects/speed_record.cpp).
void limit_steps(sim::Phase& phase) {
  constexpr double kMostChange_m_s = 0.75;
  constexpr double kHeld_m_s2 = 1e-9;  // as much as rounding makes of a mean
  constexpr double kHeldShare = 1e-9;
  constexpr std::size_t kSpeed = rigs::index_of(DrumInput::kSpeed);
  constexpr std::size_t kLoad = rigs::index_of(DrumInput::kLoad);
  const auto find_step_s = [](const sim::Segment& segment) -> std::optional<double> {
    const double slope = std::abs(segment.inputs[kSpeed].slope_per_s);
    if (slope <= kHeld_m_s2) return std::nullopt;
    return kMostChange_m_s / slope;
  };
  const auto continues = [](const sim::Segment& before, const sim::Segment& after) {
    const double load_N = after.inputs[kLoad].start;
    return std::abs(load_N - before.inputs[kLoad].start) <= kHeldShare * load_N;
  };
  sim::lengthen_held_steps(kHeldSteps, {find_step_s, continues}, phase);
}

}  // namespace

Resimulation::Resimulation(const MeasuredRun& run, const MachineKind& kind)
    : program_(make_recorded_program(run, kind)) {
  if (!is_of_vehicle(kind.traits)) {
    limit_steps(program_.phases.front());
    program_ = rigs::refine_near_standstill(std::move(program_), rigs::index_of(DrumInput::kSpeed));
  }
}

template <class S>
sim::Recording<S> Resimulation::simulate(const MeasurementSet& set, const MeasuredRun& run, models::Corner<S>& corner,
                                         rigs::Detail detail) const {
  const bool surface_recorded = run.has(quantities::kSurfaceTemperature);
  const rigs::RigStart<S> start =
      make_start<S>(run, set.rig.has_value() ? set.rig->environment.ambient_pressure_Pa : kStandardAtmosphere_Pa);
  sim::Recording<S> recording;
  switch (set.kind->traits.specimen) {
    case models::Specimen::kTire:
      recording = run_on<S, sim::StabilizedIntegrator>(
          rigs::QuasiStaticDrum<S>(corner, start, surface_recorded, detail), program_);
      break;
    case models::Specimen::kWheel:
      recording = run_on<S, sim::LaggedMidpointIntegrator>(
          rigs::RecordedRoller<S>(corner, start, surface_recorded, detail), program_);
      break;
    case models::Specimen::kVehicle: {
      std::deque<models::Corner<S>> corners;
      recording = run_on<S, sim::LaggedMidpointIntegrator>(
          rigs::RecordedRoad<S>(find_groups(set, run, corner, corners), set.vehicle->powertrain, start, detail),
          program_);
      break;
    }
  }
  if (recording.row_count() != run.time_s.size()) {
    throw RunFailure(fmt::format("the simulation of run {} has {} of its {} rows", run.id, recording.row_count(),
                                 run.time_s.size()));
  }
  apply_trace_beside_given(run, corner, recording);
  return recording;
}

template sim::Recording<double> Resimulation::simulate(const MeasurementSet&, const MeasuredRun&,
                                                       models::Corner<double>&, rigs::Detail) const;
template sim::Recording<Jet> Resimulation::simulate(const MeasurementSet&, const MeasuredRun&, models::Corner<Jet>&,
                                                    rigs::Detail) const;

}  // namespace rollrig::measurements
