#include "measurements/wheel_replay.h"

#include <algorithm>
#include <cmath>

#include "measurements/replay_start.h"
#include "models/reference_conditions.h"
#include "models/tire/drum_curvature.h"
#include "models/tire/rolling_resistance.h"
#include "models/vehicle/vehicle.h"
#include "models/wheel/rolling_wheel.h"
#include "rigs/drum_channels.h"

namespace rollrig::measurements {
namespace {

using models::Node;

template <class S>
models::InputPort<S> read_inputs(const WheelInterval& part, bool surface_recorded) {
  models::InputPort<S> inputs;
  inputs.speed_m_s = S(part.speed_m_s);
  inputs.acceleration_m_s2 = S(part.acceleration_m_s2);
  inputs.load_N = S(part.load_N);
  inputs.ambient_K = S(part.ambient_K);
  inputs.surface_recorded = surface_recorded;
  inputs.surface_K = S(part.surface_K);
  inputs.slope = S(part.slope);
  inputs.air_density_ratio = S(1.0);
  return inputs;
}

/// Moves a corner's states through the intervals; `evaluate(part, x, now)` fills `now` up to what the rates need,
/// `record(part, now)` returns the force that was recorded.
template <class S, class Evaluate, class Record>
void march(const models::Corner<S>& corner, const rigs::RigStart<S>& start, const S& tire_temperature_K,
           const S& load_N, const std::vector<WheelInterval>& intervals, ReplayObserver<S>* observer,
           Evaluate&& evaluate, Record&& record) {
  std::vector<S> x(corner.state_count());
  std::vector<S> middle(x.size());
  std::vector<S> rates(x.size());
  models::Instant<S> now;
  now.inflation = start.inflation();
  corner.initialize(tire_temperature_K, start.history_under(load_N), x.data());
  if (observer != nullptr) observer->begin(x.data());
  evaluate(intervals.front(), x.data(), now);
  corner.calc_rates(x.data(), now, rates.data());
  for (const WheelInterval& part : intervals) {
    for (std::size_t i = 0; i < x.size(); ++i) middle[i] = x[i] + (0.5 * part.duration_s) * rates[i];
    evaluate(part, middle.data(), now);
    corner.calc_rates(middle.data(), now, rates.data());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += part.duration_s * rates[i];
    corner.require_possible(x.data());
    const S& force_N = record(part, now);
    if (observer != nullptr) observer->add(part, now, force_N);
  }
  if (observer != nullptr) observer->end(x.data());
}

/// Slip and what it costs, from a force at the contact against the wheel's motion.
template <class S>
S find_slip(const S& contact_N, models::Instant<S>& now) {
  models::Motion<S>& motion = now.motion;
  const models::Context<S>& context = *now.context;
  const S geometry = S(1.0) + calc_loaded_radius_m(context.tire, motion.load_N) * context.surface_curvature_per_m;
  const S slip = contact_N * now.contact.slip_compliance_per_N;
  motion.longitudinal_force_N = contact_N;
  motion.slip_power_W = contact_N * slip * motion.speed_m_s;
  motion.rolling_speed_m_s = motion.speed_m_s * (S(1.0) - slip / geometry);
  return slip;
}

/// Ports up to the losses, at what really acts.
template <class S>
void find_losses(const models::Corner<S>& corner, const S* x, models::Instant<S>& now) {
  corner.apply_inputs(x, now);
  now.motion = {};
  now.motion.speed_m_s = now.acting.speed_m_s;
  now.motion.acceleration_m_s2 = now.acting.acceleration_m_s2;
  now.motion.load_N = now.acting.load_N;
  corner.calc_losses(x, now);
}

}  // namespace

template <class S>
sim::Recording<S> replay_dyno_run(const MeasurementSet& set, const MeasuredRun& run,
                                  const std::vector<WheelInterval>& intervals, models::Corner<S>& corner,
                                  ReplayObserver<S>* observer) {
  const bool has_rim = corner.nodes()[models::index_of(Node::kRim)];
  std::vector<std::string> names{"loss_force_N", "liner_temperature_degC", "cavity_pressure_kPa",
                                 "gas_temperature_degC"};
  if (has_rim) names.emplace_back("rim_temperature_degC");
  RowMeans<S> means(run, names);
  const bool surface_recorded = run.has("surface_temperature_degC");
  S loss_N{};
  const auto evaluate = [&](const WheelInterval& part, const S* x, models::Instant<S>& now) {
    now.recorded = read_inputs<S>(part, surface_recorded);
    now.recorded.longitudinal_force_N = S(part.longitudinal_force_N);
    now.recorded.brake_force_N = S(std::max(0.0, -part.longitudinal_force_N));
    find_losses(corner, x, now);
    const S slip = find_slip(S(-now.acting.longitudinal_force_N), now);
    loss_N = models::calc_loss_force_N(now, S(now.motion.longitudinal_force_N * slip), now.motion.acceleration_m_s2);
  };
  std::vector<S> values(names.size());
  const auto record = [&](const WheelInterval& part, const models::Instant<S>& now) -> const S& {
    const auto& temperature_K = now.thermal.temperature_K;
    values[0] = loss_N;
    values[1] = temperature_K[models::index_of(Node::kRubber)];
    values[2] = now.pressure_Pa;
    values[3] = temperature_K[models::index_of(Node::kGas)];
    if (has_rim) values[4] = temperature_K[models::index_of(Node::kRim)];
    means.add(part, values);
    return loss_N;
  };
  const rigs::RigStart<S> start = make_replay_start<S>(run, set.rig->environment.ambient_pressure_Pa);
  march(corner, start, start.tire_temperature_K, S(intervals.front().load_N), intervals, observer, evaluate, record);
  sim::Recording<S> recording = means.finish();
  apply_trace_beside_given(run, corner, recording);
  return recording;
}

namespace {

/// Temperature of a tire in steady driving at 80 km/h under its static load, from the network of its file. Assumed: at
/// the cold pressure, which a warm tire exceeds by some 10 %, so that it would lose 4 % less.
template <class S>
S calc_warm_temperature_K(const models::Corner<S>& corner, const S& load_N, const rigs::RigStart<S>& start) {
  const models::Context<S>& context = corner.context();
  const S speed_m_s = models::get_reference_speed_m_s<S>();
  const S cooling_W_per_K = context.tire.thermal.z_W_per_K + context.tire.thermal.f_W_s_per_m_K * speed_m_s;
  S warm_K = start.tire_temperature_K;
  constexpr int kRounds = 20;  // each takes about a third of the error
  for (int i = 0; i < kRounds; ++i) {
    const S loss_N = models::calc_curvature_factor(context) *
                     models::calc_rolling_resistance_N(context.tire, speed_m_s, load_N, start.cold_pressure_Pa, warm_K);
    warm_K = start.tire_temperature_K + loss_N * speed_m_s / cooling_W_per_K;
  }
  return warm_K;
}

}  // namespace

template <class S>
sim::Recording<S> replay_road_run(const MeasurementSet& set, const MeasuredRun& run,
                                  const std::vector<WheelInterval>& intervals, models::Corner<S>& corner,
                                  ReplayObserver<S>* observer) {
  const models::VehicleBody<S>& body = corner.context().vehicle;
  const double tires = set.vehicle->tires;
  const S load_N = body.mass_kg * S(kStandardGravity_m_s2 / tires);
  const S motor_limit_N = body.mass_kg * S(set.vehicle->powertrain.regeneration_limit_m_s2);
  const S fade_m_s(set.vehicle->powertrain.regeneration_fade_m_s);
  RowMeans<S> means(run, {"traction_force_N"});
  S traction_N{};
  const auto evaluate = [&](const WheelInterval& part, const S* x, models::Instant<S>& now) {
    now.recorded = read_inputs<S>(part, false);
    now.recorded.load_N = load_N;
    find_losses(corner, x, now);
    const S density_kg_per_m3 = now.acting.air_density_ratio *
                                models::calc_air_density_kg_per_m3(S(kStandardAtmosphere_Pa), now.recorded.ambient_K);
    const S moving_kg = now.contact.vehicle_mass_factor * (body.mass_kg + body.rotating_mass_kg);
    traction_N = tires * (now.rolling_resistance_N + now.parasitic_N) +
                 models::calc_grade_N(body.mass_kg, now.acting.slope) +
                 models::calc_drag_N(density_kg_per_m3, body.drag_area_m2, now.motion.speed_m_s, now.acting.wind_m_s) +
                 moving_kg * now.motion.acceleration_m_s2;
    const auto demand = models::blend_brakes(traction_N, motor_limit_N, now.motion.speed_m_s, fade_m_s);
    now.acting.brake_force_N = demand.friction_N / tires;
    now.acting.longitudinal_force_N = traction_N / tires;  // Assumed: all tires alike
    find_slip(S(-now.acting.longitudinal_force_N), now);
  };
  std::vector<S> values(1);
  const auto record = [&](const WheelInterval& part, const models::Instant<S>&) -> const S& {
    values[0] = traction_N;
    means.add(part, values);
    return traction_N;
  };
  const rigs::RigStart<S> start = make_replay_start<S>(run, kStandardAtmosphere_Pa);
  const bool begins_warm = run.started_warm && set.baseline == models::Baseline::kCombined;  // else no loss sees it
  const S tire_temperature_K = begins_warm ? calc_warm_temperature_K(corner, load_N, start) : start.tire_temperature_K;
  march(corner, start, tire_temperature_K, load_N, intervals, observer, evaluate, record);
  sim::Recording<S> recording = means.finish();
  apply_trace_beside_given(run, corner, recording);
  return recording;
}

double find_tire_load_N(const rigs::VehicleFile& vehicle) {
  return vehicle.body.mass_kg * kStandardGravity_m_s2 / vehicle.tires;
}

models::Context<double> make_road_context(const MeasurementSet& set) {
  const rigs::VehicleFile& vehicle = *set.vehicle;
  if (vehicle.road_load.has_value()) {
    throw InputError({"a vehicle that is given by its road load has no tires to tell of", vehicle.path, 0,
                      "[road_load]", "", "drag_area_m2 instead, with the tire of the set", ""});
  }
  models::Context<double> context;
  context.rig_kind = models::RigKind::kFlat;
  context.baseline = set.baseline;
  context.vehicle = vehicle.body;
  context.tire =
      set.baseline == models::Baseline::kConstantRrc
          ? set.tire.parameters_with_class_values(find_tire_load_N(vehicle), set.runs.front().cold_pressure_Pa)
          : set.tire.parameters_on("", set.baseline);
  return context;
}

template sim::Recording<double> replay_dyno_run(const MeasurementSet&, const MeasuredRun&,
                                                const std::vector<WheelInterval>&, models::Corner<double>&,
                                                ReplayObserver<double>*);
template sim::Recording<Jet> replay_dyno_run(const MeasurementSet&, const MeasuredRun&,
                                             const std::vector<WheelInterval>&, models::Corner<Jet>&,
                                             ReplayObserver<Jet>*);
template sim::Recording<double> replay_road_run(const MeasurementSet&, const MeasuredRun&,
                                                const std::vector<WheelInterval>&, models::Corner<double>&,
                                                ReplayObserver<double>*);
template sim::Recording<Jet> replay_road_run(const MeasurementSet&, const MeasuredRun&,
                                             const std::vector<WheelInterval>&, models::Corner<Jet>&,
                                             ReplayObserver<Jet>*);

}  // namespace rollrig::measurements
