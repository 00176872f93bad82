#include "measurements/wheel_ledger.h"

#include <cmath>

#include "models/vehicle/vehicle.h"

namespace rollrig::measurements {

WheelLedger::WheelLedger(const MeasuredRun& run, const models::Corner<double>& corner, int wheels,
                         std::vector<std::string> channels)
    : corner_(corner), wheels_(wheels), means_(run, std::move(channels)) {}

void WheelLedger::begin(const double* states) { heat_start_J_ = corner_.calc_stored_heat_J(states); }

void WheelLedger::end(const double* states) { heat_end_J_ = corner_.calc_stored_heat_J(states); }

void WheelLedger::add(const WheelInterval& part, const models::Instant<double>& now, const double& force_N) {
  const WheelPowers power = find_powers(now, force_N);
  const double duration_s = part.duration_s;
  sum_J_.hub_W += duration_s * power.hub_W;
  sum_J_.roller_W += duration_s * power.roller_W;
  sum_J_.gravity_W += duration_s * power.gravity_W;
  sum_J_.tire_W += duration_s * power.tire_W;
  sum_J_.slip_W += duration_s * power.slip_W;
  sum_J_.bearing_W += duration_s * power.bearing_W;
  sum_J_.drag_W += duration_s * power.drag_W;
  throughput_J_ += duration_s * (std::abs(power.hub_W) + std::abs(power.roller_W));
  heat_in_J_ += duration_s * now.heat.heat_in_W;
  to_air_J_ += duration_s * now.heat.to_air_W;
  to_road_J_ += duration_s * now.heat.to_road_W;
  const double half_change_m_s = 0.5 * duration_s * now.motion.acceleration_m_s2;
  const auto calc_kinetic_J = [&](double speed_m_s) { return 0.5 * power.moving_kg * speed_m_s * speed_m_s; };
  const double before_J = calc_kinetic_J(now.motion.speed_m_s - half_change_m_s);
  if (moved_) jumps_J_ += before_J - kinetic_J_;
  if (!moved_) kinetic_start_J_ = before_J;
  moved_ = true;
  kinetic_J_ = calc_kinetic_J(now.motion.speed_m_s + half_change_m_s);
  means_.add(part, read_channels(now));
}

sim::EnergyAudit WheelLedger::make_audit() const {
  using Ledger = sim::EnergyTerm::Ledger;
  sim::EnergyAudit audit;
  audit.throughput_J = throughput_J_;
  audit.terms = {{sim::kMotorWork, Ledger::kMechanical, sum_J_.hub_W},
                 {"rollers", Ledger::kMechanical, sum_J_.roller_W},
                 {"gravity", Ledger::kMechanical, sum_J_.gravity_W},
                 {"load_changes", Ledger::kMechanical, jumps_J_},
                 {"tire_loss", Ledger::kMechanical, -sum_J_.tire_W},
                 {"slip_loss", Ledger::kMechanical, -sum_J_.slip_W},
                 {"bearing_loss", Ledger::kMechanical, -sum_J_.bearing_W},
                 {"drag_loss", Ledger::kMechanical, -sum_J_.drag_W},
                 {"kinetic", Ledger::kMechanical, kinetic_start_J_ - kinetic_J_},
                 {"heat_generated", Ledger::kThermal, wheels_ * heat_in_J_},
                 {"heat_to_air", Ledger::kThermal, -wheels_ * to_air_J_},
                 {"heat_to_road", Ledger::kThermal, -wheels_ * to_road_J_},
                 {"stored_heat", Ledger::kThermal, wheels_ * (heat_start_J_ - heat_end_J_)}};
  return audit;
}

namespace {

using models::Instant;
using models::Node;

class DynoLedger : public WheelLedger {
 public:
  DynoLedger(const MeasuredRun& run, const models::Corner<double>& corner)
      : WheelLedger(run, corner, 1, {"rolling_resistance_N", "parasitic_N"}) {}

 protected:
  WheelPowers find_powers(const Instant<double>& now, double) const override {
    const models::Context<double>& context = *now.context;
    const models::Motion<double>& motion = now.motion;
    const double loaded_radius_m = calc_loaded_radius_m(context.tire, motion.load_N);
    const double curvature_per_m = context.surface_curvature_per_m;
    const double spin_kg = context.tire.geometry.spin_inertia_kg_m2 / (loaded_radius_m * loaded_radius_m);
    const double roller_kg = now.contact.machine_inertia_factor * context.machine_mass_kg;
    const double at_wheel_N = now.rolling_resistance_N / (1.0 + loaded_radius_m * curvature_per_m);
    const double at_roller_N = now.rolling_resistance_N - at_wheel_N;
    const double driving_N = now.acting.longitudinal_force_N;
    const double hub_N = at_wheel_N + spin_kg * motion.acceleration_m_s2 + driving_N;
    const double roller_N = at_roller_N + now.parasitic_N + roller_kg * motion.acceleration_m_s2 - driving_N;
    WheelPowers power;
    power.hub_W = hub_N * motion.speed_m_s + motion.slip_power_W;
    power.roller_W = roller_N * motion.speed_m_s;
    power.tire_W = now.rolling_resistance_N * motion.speed_m_s;
    power.slip_W = motion.slip_power_W;
    power.bearing_W = now.parasitic_N * motion.speed_m_s;
    power.moving_kg = spin_kg + roller_kg;
    return power;
  }
  std::vector<double> read_channels(const Instant<double>& now) const override {
    return {now.rolling_resistance_N, now.parasitic_N};
  }
};

class RoadLedger : public WheelLedger {
 public:
  RoadLedger(const MeasuredRun& run, const models::Corner<double>& corner, int tires)
      : WheelLedger(
            run, corner, tires,
            {"rolling_resistance_N", "parasitic_N", "liner_temperature_degC", "cavity_pressure_kPa", kFrictionBrake}) {}

 protected:
  WheelPowers find_powers(const Instant<double>& now, double traction_N) const override {
    const models::VehicleBody<double>& body = now.context->vehicle;
    const double speed_m_s = now.motion.speed_m_s;
    const double slip = now.motion.longitudinal_force_N * now.contact.slip_compliance_per_N;
    const double density_kg_per_m3 =
        now.acting.air_density_ratio *
        models::calc_air_density_kg_per_m3(double{kStandardAtmosphere_Pa}, now.recorded.ambient_K);
    WheelPowers power;
    power.hub_W = traction_N * speed_m_s * (1.0 - slip);
    power.gravity_W = -models::calc_grade_N(body.mass_kg, now.acting.slope) * speed_m_s;
    power.tire_W = wheels() * now.rolling_resistance_N * speed_m_s;
    power.slip_W = wheels() * now.motion.slip_power_W;
    power.bearing_W = wheels() * now.parasitic_N * speed_m_s;
    power.drag_W =
        models::calc_drag_N(density_kg_per_m3, body.drag_area_m2, speed_m_s, now.acting.wind_m_s) * speed_m_s;
    power.moving_kg = now.contact.vehicle_mass_factor * (body.mass_kg + body.rotating_mass_kg);
    return power;
  }
  std::vector<double> read_channels(const Instant<double>& now) const override {
    return {now.rolling_resistance_N, now.parasitic_N, now.thermal.temperature_K[models::index_of(Node::kRubber)],
            now.pressure_Pa, wheels() * now.acting.brake_force_N};
  }
};

}  // namespace

std::unique_ptr<WheelLedger> make_dyno_ledger(const MeasuredRun& run, const models::Corner<double>& corner) {
  return std::make_unique<DynoLedger>(run, corner);
}

std::unique_ptr<WheelLedger> make_road_ledger(const MeasuredRun& run, const models::Corner<double>& corner, int tires) {
  return std::make_unique<RoadLedger>(run, corner, tires);
}

}  // namespace rollrig::measurements
