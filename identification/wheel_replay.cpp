#include "identification/wheel_replay.h"

#include <algorithm>
#include <cmath>

#include "identification/replay_start.h"
#include "models/drum_curvature.h"
#include "models/reference_conditions.h"
#include "models/rolling_resistance.h"
#include "models/vehicle.h"
#include "rigs/drum_channels.h"

namespace rollrig::identification {
namespace {

using models::Node;
using scenarios::MeasuredRun;
using scenarios::MeasurementSet;

constexpr double kLongest_s = 2.5;

/// Inputs at a share of the way from one row to the next.
class RowPair {
 public:
  RowPair(const MeasuredRun& run, std::size_t row) : run_(run), row_(row) {}

  double at(const char* column, double share) const {
    const std::vector<double>& values = run_.columns.at(column);
    return values[row_] + share * (values[row_ + 1] - values[row_]);
  }
  double change(const char* column) const { return at(column, 1.0) - at(column, 0.0); }

 private:
  const MeasuredRun& run_;
  std::size_t row_;
};

double find_slope(const RowPair& rows, double duration_s) {
  constexpr double kSlowest_m_s = 1.0;  // Assumed: below it the way is too short to tell
  const double speed_m_s = rows.at("speed_km_h", 0.5);
  return speed_m_s < kSlowest_m_s ? 0.0 : rows.change("elevation_m") / (speed_m_s * duration_s);
}

/// Root mean square of a force that runs linearly by `change` about `middle`, with the sign of its middle.
double calc_rms_with_sign(double middle, double change) {
  return std::copysign(std::sqrt(middle * middle + change * change / 12.0), middle);
}

}  // namespace

std::vector<WheelInterval> make_wheel_intervals(const MeasuredRun& run) {
  std::vector<WheelInterval> intervals;
  for (std::size_t row = 0; row + 1 < run.time_s.size(); ++row) {
    const RowPair rows(run, row);
    const double between_s = run.time_s[row + 1] - run.time_s[row];
    auto parts = static_cast<int>(std::ceil(between_s / kLongest_s - 1e-9));
    if (parts > 1) parts += parts % 2;  // so that none lies across the middle
    WheelInterval part;
    part.duration_s = between_s / parts;
    part.acceleration_m_s2 = rows.change("speed_km_h") / between_s;
    part.row = row;
    if (run.has("load_N")) part.load_N = run.columns.at("load_N")[row];
    if (run.has("elevation_m")) part.slope = find_slope(rows, between_s);
    for (int i = 0; i < parts; ++i) {
      const double share = (i + 0.5) / parts;
      part.speed_m_s = rows.at("speed_km_h", share);
      part.ambient_K = rows.at("ambient_degC", share);
      part.surface_K =
          run.has("surface_temperature_degC") ? rows.at("surface_temperature_degC", share) : part.ambient_K;
      if (run.has("longitudinal_force_N")) {
        part.longitudinal_force_N =
            calc_rms_with_sign(rows.at("longitudinal_force_N", share), rows.change("longitudinal_force_N") / parts);
      }
      part.share_of_row = parts == 1 ? 0.5 : (share < 0.5 ? 1.0 : 0.0);
      intervals.push_back(part);
    }
  }
  return intervals;
}

namespace {

/// Means of channels over what belongs to each row.
template <class S>
class RowMeans {
 public:
  RowMeans(const MeasuredRun& run, std::vector<std::string> names) : weights_(run.time_s.size(), 0.0) {
    recording_.time_s = run.time_s;
    for (std::string& name : names) {
      recording_.channels.push_back({std::move(name)});
      recording_.values.emplace_back(run.time_s.size(), S(0.0));
    }
  }

  void add(const WheelInterval& part, const std::vector<S>& values) {
    for (const std::size_t next : {0, 1}) {
      const double weight = part.duration_s * (next == 0 ? part.share_of_row : 1.0 - part.share_of_row);
      if (weight == 0.0) continue;
      weights_[part.row + next] += weight;
      for (std::size_t c = 0; c < values.size(); ++c) recording_.values[c][part.row + next] += weight * values[c];
    }
  }

  sim::Recording<S> finish() {
    for (std::vector<S>& column : recording_.values) {
      for (std::size_t row = 0; row < column.size(); ++row) column[row] = column[row] * (1.0 / weights_[row]);
    }
    return std::move(recording_);
  }

 private:
  sim::Recording<S> recording_;
  std::vector<double> weights_;
};

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

/// Moves a corner's states through the intervals; `evaluate(part, x, now)` fills `now` up to what the rates need.
template <class S, class Evaluate, class Record>
void march(const models::Corner<S>& corner, const rigs::DrumStart<S>& start, const S& tire_temperature_K,
           const S& load_N, const std::vector<WheelInterval>& intervals, Evaluate&& evaluate, Record&& record) {
  std::vector<S> x(corner.state_count());
  std::vector<S> middle(x.size());
  std::vector<S> rates(x.size());
  models::Instant<S> now;
  now.inflation = start.inflation();
  corner.initialize(tire_temperature_K, start.history_under(load_N), x.data());
  evaluate(intervals.front(), x.data(), now);
  corner.calc_rates(x.data(), now, rates.data());
  for (const WheelInterval& part : intervals) {
    for (std::size_t i = 0; i < x.size(); ++i) middle[i] = x[i] + (0.5 * part.duration_s) * rates[i];
    evaluate(part, middle.data(), now);
    corner.calc_rates(middle.data(), now, rates.data());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += part.duration_s * rates[i];
    record(part, now);
  }
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
                                  const std::vector<WheelInterval>& intervals, models::Corner<S>& corner) {
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
    const models::Context<S>& context = corner.context();
    const S& curvature_per_m = context.surface_curvature_per_m;
    const S roller_kg = context.machine_inertia_kg_m2 * curvature_per_m * curvature_per_m;
    loss_N = now.rolling_resistance_N + now.parasitic_N + now.motion.longitudinal_force_N * slip +
             (now.contact.machine_inertia_factor - S(1.0)) * roller_kg * now.motion.acceleration_m_s2;
  };
  std::vector<S> values(names.size());
  const auto record = [&](const WheelInterval& part, const models::Instant<S>& now) {
    const auto& temperature_K = now.thermal.temperature_K;
    values[0] = loss_N;
    values[1] = temperature_K[models::index_of(Node::kRubber)];
    values[2] = now.pressure_Pa;
    values[3] = temperature_K[models::index_of(Node::kGas)];
    if (has_rim) values[4] = temperature_K[models::index_of(Node::kRim)];
    means.add(part, values);
  };
  const rigs::DrumStart<S> start = make_replay_start<S>(run, set.rig->environment.ambient_pressure_Pa);
  march(corner, start, start.tire_temperature_K, S(intervals.front().load_N), intervals, evaluate, record);
  sim::Recording<S> recording = means.finish();
  apply_trace_beside_given(run, corner, recording);
  return recording;
}

namespace {

/// Temperature of a tire in steady driving at 80 km/h under its static load, from the network of its file. Assumed: at
/// the cold pressure, which a warm tire exceeds by some 10 %, so that it would lose 4 % less.
template <class S>
S calc_warm_temperature_K(const models::Corner<S>& corner, const S& load_N, const rigs::DrumStart<S>& start) {
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
                                  const std::vector<WheelInterval>& intervals, models::Corner<S>& corner) {
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
  const auto record = [&](const WheelInterval& part, const models::Instant<S>&) {
    values[0] = traction_N;
    means.add(part, values);
  };
  const rigs::DrumStart<S> start = make_replay_start<S>(run, kStandardAtmosphere_Pa);
  const bool begins_warm = run.started_warm && set.baseline == models::Baseline::kCombined;  // else no loss sees it
  const S tire_temperature_K = begins_warm ? calc_warm_temperature_K(corner, load_N, start) : start.tire_temperature_K;
  march(corner, start, tire_temperature_K, load_N, intervals, evaluate, record);
  sim::Recording<S> recording = means.finish();
  apply_trace_beside_given(run, corner, recording);
  return recording;
}

template sim::Recording<double> replay_dyno_run(const MeasurementSet&, const MeasuredRun&,
                                                const std::vector<WheelInterval>&, models::Corner<double>&);
template sim::Recording<Jet> replay_dyno_run(const MeasurementSet&, const MeasuredRun&,
                                             const std::vector<WheelInterval>&, models::Corner<Jet>&);
template sim::Recording<double> replay_road_run(const MeasurementSet&, const MeasuredRun&,
                                                const std::vector<WheelInterval>&, models::Corner<double>&);
template sim::Recording<Jet> replay_road_run(const MeasurementSet&, const MeasuredRun&,
                                             const std::vector<WheelInterval>&, models::Corner<Jet>&);

}  // namespace rollrig::identification
