#include "rigs/multibody_vehicle.h"

#include <fmt/format.h>

#include <Simbody.h>

#include <algorithm>
#include <stdexcept>

#include "models/contact_force_element.h"
#include "models/wheel/rolling_wheel.h"
#include "rigs/simbody_system.h"
#include "rigs/vehicle_bodies.h"
#include "rigs/vehicle_drive.h"
#include "sim/core/error.h"

namespace rollrig::rigs {

using models::ContactEvaluation;
using models::ContactForceElement;
using models::Corner;
using models::Node;
using SimTK::Vec3;

namespace {

// Errors that do not matter at a relative tolerance of 1e-6, for the integrator's control. A drive starts
// afresh at every row of its trace, so that mechanics are held to what the audit of a drive needs.
constexpr double kAngle_rad = 100.0;
constexpr double kDistance_m = 100.0;
constexpr double kHeight_m = 1e-6;
constexpr double kSpeed_rad_s = 1e-5;
constexpr double kSpeed_m_s = 1e-5;
constexpr double kSlipForce_N = 0.5;
constexpr double kStateShare = 1e-6;  // of a corner state's scale
constexpr double kSpeedIntegral_m = 1e-5;

}  // namespace

class MultibodyVehicle::Implementation : public SimbodySystem {
 public:
  Implementation(std::vector<Corner<double>>& corners, const VehicleLayout& layout, const VehicleFile& vehicle,
                 const RigFile& rig, VehicleStart<double> start, bool surface_recorded)
      : SimbodySystem(make_vehicle_integrals(layout), make_vehicle_stores(),
                      make_vehicle_channels(layout, corners.front().states(), surface_recorded)),
        corners_(corners),
        layout_(layout),
        start_(std::move(start)),
        surface_recorded_(surface_recorded),
        contact_port_(find_contact_port(corners.front())),
        roller_radius_m_(rig.drum.diameter_m / 2.0),
        bodies_(add_vehicle_bodies(matter_, layout, vehicle, rig, corners.front().context().tire,
                                   contact_port_.vehicle_mass_factor)) {
    add_forces(vehicle, rig);
    realize_topology();
    first_u_ = static_cast<std::size_t>(state_.getNQ());
    first_z_ = first_u_ + static_cast<std::size_t>(state_.getNU());
  }

  std::vector<double> state_tolerances() const override {
    std::vector<double> tolerances(state_count(), 0.0);
    const auto put = [&](const SimTK::MobilizedBody& body, double position, double speed) {
      tolerances[static_cast<std::size_t>(body.getFirstQIndex(state_))] = position;
      tolerances[first_u_ + static_cast<std::size_t>(body.getFirstUIndex(state_))] = speed;
    };
    if (bodies_.has_sled()) put(bodies_.sled, is_flat() ? kDistance_m : kHeight_m, kSpeed_m_s);
    put(bodies_.heave, kHeight_m, kSpeed_m_s);
    put(bodies_.body, kHeight_m, kSpeed_m_s);
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      put(bodies_.wheels[i].upright, kHeight_m, kSpeed_m_s);
      put(bodies_.wheels[i].wheel, kAngle_rad, kSpeed_rad_s);
      if (!is_flat()) put(bodies_.wheels[i].roller, kAngle_rad, kSpeed_rad_s);
      double* own = &tolerances[slip_state(i)];
      *own++ = kSlipForce_N / slip_spring_N_per_m();
      for (const models::CornerState& state : corners_[i].states()) *own++ = kStateShare * state.scale_SI;
    }
    tolerances[driver_state()] = kSpeedIntegral_m;
    return tolerances;
  }

  /// Heights are relative: the body's to where it is under static load, an axle's to the body.
  std::vector<sim::PoseCoordinate> poses() const override {
    std::vector<sim::PoseCoordinate> poses;
    const auto add = [&](const std::string& name, const SimTK::MobilizedBody& body) {
      poses.push_back({name, static_cast<std::size_t>(body.getFirstQIndex(state_))});
    };
    if (bodies_.has_sled()) add("position_m", bodies_.sled);
    add("body_heave_m", bodies_.heave);
    if (is_flat() && bodies_.wheels.size() > 1) add("body_pitch_rad", bodies_.body);
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      add(wheel_channel("axle_travel_m", layout_.wheels[i]), bodies_.wheels[i].upright);
      add(wheel_channel("wheel_angle_rad", layout_.wheels[i]), bodies_.wheels[i].wheel);
      if (!is_flat()) add(wheel_channel("roller_angle_rad", layout_.wheels[i]), bodies_.wheels[i].roller);
    }
    return poses;
  }

  void initialize(const sim::Segment& first, double time_s, double* y) override {
    take_segment(first, time_s);
    drive_->set_driver(true);
    state_.updY() = 0.0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      contacts_[i]->set_inflation(start_.inflation());
      corners_[i].initialize(start_.tire_temperature_K, start_.history_under(layout_.wheels[i].static_load_N),
                             &state_.updY()[static_cast<int>(slip_state(i)) + 1]);
    }
    state_.setTime(time_s);
    set_equilibrium();
    copy_state(y);
  }

  void begin_phase(const sim::Phase& phase, double, double* y) override {
    for (const sim::Command& command : phase.commands) {
      if (command.name == kSetPressure) {
        for (std::size_t i = 0; i < corners_.size(); ++i) {
          models::Inflation<double> inflation = contacts_[i]->inflation();
          corners_[i].inflate(command.value_SI, y + slip_state(i) + 1, inflation);
          contacts_[i]->set_inflation(inflation);
        }
      } else if (command.name == kDriver) {
        drive_->set_driver(command.value_SI != 0.0);
        if (command.value_SI == 0.0) y[driver_state()] = 0.0;
      } else {
        throw std::invalid_argument("vehicle: unknown command " + command.name);
      }
    }
    state_.invalidateAllCacheAtOrAbove(SimTK::Stage::Time);
  }

  void begin_segment(const sim::Segment& segment, double time_s, double*, double*) override {
    take_segment(segment, time_s);
  }

  void require_possible(const double* y) const override {
    for (std::size_t i = 0; i < corners_.size(); ++i) corners_[i].require_possible(y + slip_state(i) + 1);
  }

  double watch(const std::string& name, double time_s, const double* y) override {
    if (name == kWatchTireTemperature) return y[slip_state(0) + 1 + corners_.front().state_of(Node::kRubber)];
    if (name != kWatchSpeed) throw std::invalid_argument("vehicle: cannot watch " + name);
    realize_at(time_s, y);
    return calc_recorded_speed_m_s(time_s);
  }

  void observe(double time_s, const double* y, double* values) override {
    realize_at(time_s, y);
    const models::InputPort<double> inputs = program_inputs(time_s);
    if (drive_->driver_on()) require_speed_held(time_s);
    *values++ = drive_->driver_on() ? inputs.speed_m_s : calc_recorded_speed_m_s(time_s);
    *values++ = inputs.ambient_K;
    if (surface_recorded_) *values++ = inputs.surface_K;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      *values++ = layout_.wheels[i].static_load_N;
      for (std::size_t k = 2; k < corners_[i].state_count(); ++k) *values++ = y[slip_state(i) + 1 + k];
    }
  }

  void calc_stored(double time_s, const double* y, double* stored_J) override {
    realize_at(time_s, y);
    system_.realize(state_, SimTK::Stage::Dynamics);
    double tires_J = 0.0;
    double slip_J = 0.0;
    double heat_J = 0.0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      tires_J += contacts_[i]->calc_tire_spring_J(contacts_[i]->evaluation(state_));
      slip_J += contacts_[i]->calc_slip_spring_J(state_);
      heat_J += corners_[i].calc_stored_heat_J(y + slip_state(i) + 1);
    }
    const double springs_J = tires_J + drive_->calcPotentialEnergy(state_);
    stored_J[index_of(VehicleStore::kKinetic)] = system_.calcKineticEnergy(state_);
    stored_J[index_of(VehicleStore::kGravity)] = system_.calcPotentialEnergy(state_) - springs_J - slip_J;
    stored_J[index_of(VehicleStore::kSprings)] = springs_J;
    stored_J[index_of(VehicleStore::kSlipSpring)] = slip_J;
    stored_J[index_of(VehicleStore::kHeat)] = heat_J;
  }

  VehicleForces find_forces(double time_s, const double* y) {
    realize_at(time_s, y);
    system_.realize(state_, SimTK::Stage::Acceleration);
    const DriveEvaluation& drive = drive_->evaluation(state_);
    VehicleForces forces;
    forces.tie_down_N = drive.tie_down_N + drive.tie_down_damper_N;
    forces.speed_m_s = drive.speed_m_s;
    for (std::size_t i = 0; i < corners_.size(); ++i) forces.wheels.push_back(find_wheel_forces(i));
    return forces;
  }

 private:
  VehicleForces::Wheel find_wheel_forces(std::size_t i) const {
    const VehicleBodies::Wheel& bodies = bodies_.wheels[i];
    const ContactEvaluation& at = contacts_[i]->evaluation(state_);
    const DriveEvaluation::Wheel& drive = drive_->evaluation(state_).wheels[i];
    const SimTK::SpatialVec hub = bodies.wheel.findMobilizerReactionOnBodyAtMInGround(state_);
    VehicleForces::Wheel wheel;
    wheel.contact_load_N = at.normal_N;
    wheel.contact_force_N = at.slip.force_N * at.tangent[0];
    wheel.rolling_resistance_N = at.now.rolling_resistance_N;
    wheel.loaded_radius_m = at.loaded_radius_m;
    wheel.wheel_speed_rad_s = at.wheel_speed_rad_s;
    wheel.roller_speed_rad_s = at.surface_speed_rad_s;
    wheel.spindle_reaction_N = hub[1][0];
    wheel.hub_torque_Nm = drive.motor_Nm - drive.brake_Nm;
    wheel.roller_mass_kg = bodies.roller_mass_kg;
    if (is_flat()) return wheel;
    const SimTK::SpatialVec pin = bodies.roller.findMobilizerReactionOnBodyAtMInGround(state_);
    wheel.roller_reaction_N = pin[1][0];
    wheel.roller_lift_N = pin[1][1];
    return wheel;
  }

  bool is_flat() const { return layout_.rig_kind == RigKind::kFlat; }
  std::size_t slip_state(std::size_t wheel) const {
    return first_z_ + static_cast<std::size_t>(contacts_[wheel]->first_z());
  }
  std::size_t driver_state() const { return first_z_ + static_cast<std::size_t>(drive_->integral_z()); }

  models::InputPort<double> program_inputs(double time_s) const {
    return read_vehicle_inputs<double>(segment_, time_in_segment_s(time_s), surface_recorded_);
  }

  void add_forces(const VehicleFile& vehicle, const RigFile& rig) {
    VehicleDrive::Bodies driven;
    driven.body = bodies_.body.getMobilizedBodyIndex();
    if (bodies_.has_sled()) driven.sled = bodies_.sled.getMobilizedBodyIndex();
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      const VehicleBodies::Wheel& wheel = bodies_.wheels[i];
      const SimTK::MobilizedBodyIndex roller = is_flat() ? SimTK::GroundIndex : wheel.roller.getMobilizedBodyIndex();
      auto* contact = new ContactForceElement(
          forces_, matter_, {wheel.wheel.getMobilizedBodyIndex(), roller, wheel.upright.getMobilizedBodyIndex()},
          corners_[i], [this, i](const SimTK::State& state) { return drive_->find_recorded(state, i); });
      contact->update_contact_parameters(contact_port_.slip_compliance_per_N);
      SimTK::Force::Custom(forces_, contact);
      contacts_.push_back(contact);
      driven.wheels.push_back({contact, wheel.wheel.getMobilizedBodyIndex(), wheel.upright.getMobilizedBodyIndex(),
                               roller, wheel.roller_mass_kg, wheel.preload_N, wheel.ballast_N});
    }
    drive_ = new VehicleDrive(forces_, matter_, std::move(driven), layout_, vehicle, rig, corners_.front().context());
    drive_->program_inputs = [this](double time_s) { return program_inputs(time_s); };
    SimTK::Force::Custom(forces_, drive_);
    suspension_stiffness_N_per_m_ = vehicle.suspension.stiffness_N_per_m;
  }

  void realize_at(double time_s, const double* y) {
    set_state(time_s, y);
    system_.realize(state_, SimTK::Stage::Velocity);
  }

  double calc_speed_m_s() const {
    system_.realize(state_, SimTK::Stage::Velocity);
    return drive_->evaluation(state_).speed_m_s;
  }

  double calc_recorded_speed_m_s(double time_s) const {
    const double true_m_s = calc_speed_m_s();
    return models::calc_recorded_speed_m_s(true_m_s, program_inputs(time_s), drive_->evaluation(state_).acting);
  }

  /// The recorded speed is the set point; a driver who does not keep it is a failed run, not a result.
  void require_speed_held(double time_s) const {
    constexpr double kShare = 0.02;     // Assumed: about the tolerance of drive cycles, 2 mph
    constexpr double kFloor_m_s = 0.5;  // and of SAE J1634 at low speed
    const double set_m_s = drive_->evaluation(state_).acting.speed_m_s;
    const double is_m_s = calc_speed_m_s();
    if (std::abs(is_m_s - set_m_s) <= kFloor_m_s + kShare * std::abs(set_m_s)) return;
    throw RunFailure(fmt::format(
        "at t = {:.1f} s the driver does not keep the speed: set {:.1f} km/h, is {:.1f} km/h; what drives or brakes "
        "it (speeds, slope, wind, effects) is more than it can do",
        time_s, unit_of_key("speed_km_h").from_si(set_m_s), unit_of_key("speed_km_h").from_si(is_m_s)));
  }

  double slip_spring_N_per_m() const {
    return models::make_contact_parameters(corners_.front().context().tire, contact_port_.slip_compliance_per_N)
        .slip_spring_N_per_m;
  }

  /// Steady rolling at the first inputs: restraint carried, no slip, driver in balance.
  void set_equilibrium() {
    system_.realize(state_, SimTK::Stage::Velocity);
    const DriveEvaluation drive = drive_->evaluation(state_);
    const double speed_m_s = drive.acting.speed_m_s;
    const models::TireParameters<double>& tire = corners_.front().context().tire;
    const double sinks_by_N = drive.wheels.front().on_body_N;  // the same at every wheel: the body does not pitch
    const double tire_N_per_m = tire.stiffness.vertical_N_per_m;
    const double heave_m = -sinks_by_N / suspension_stiffness_N_per_m_ - sinks_by_N / tire_N_per_m;
    bodies_.heave.setOneQ(state_, 0, heave_m);
    if (is_flat()) bodies_.sled.setOneU(state_, 0, speed_m_s);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const VehicleBodies::Wheel& wheel = bodies_.wheels[i];
      const double restraint_N = drive.wheels[i].restraint_N;
      const double loaded_radius_m = calc_loaded_radius_m(tire, layout_.wheels[i].static_load_N + restraint_N);
      wheel.upright.setOneQ(state_, 0, -heave_m - restraint_N / tire_N_per_m);
      wheel.wheel.setOneU(state_, 0, speed_m_s / loaded_radius_m);
      if (!is_flat()) wheel.roller.setOneU(state_, 0, speed_m_s / roller_radius_m_);
    }
    set_driver_in_balance(drive.acting);
  }

  void set_driver_in_balance(const models::InputPort<double>& acting) {
    system_.realize(state_, SimTK::Stage::Velocity);
    double force_N = drive_->evaluation(state_).drag_N + drive_->evaluation(state_).grade_N;
    if (!is_flat()) {
      force_N += models::calc_standstill_fade(acting.speed_m_s) *
                 models::calc_road_load_N(layout_.resistance, acting.speed_m_s);
    }
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      ContactEvaluation at;
      contacts_[i]->evaluate(state_, at);
      force_N += at.now.rolling_resistance_N + (is_flat() ? at.now.parasitic_N : 0.0);
    }
    force_N += (layout_.mass_kg + layout_.rotating_mass_kg) * acting.acceleration_m_s2;
    state_.updY()[static_cast<int>(driver_state())] = drive_->find_integral_m(force_N, acting);
    for (std::size_t i = 0; i < corners_.size(); ++i) set_slip_in_balance(i);
  }

  /// The deflection that carries the wheel's torques at its present speed.
  void set_slip_in_balance(std::size_t i) {
    system_.realize(state_, SimTK::Stage::Velocity);
    ContactEvaluation at;
    contacts_[i]->evaluate(state_, at);
    const DriveEvaluation::Wheel& wheel = drive_->evaluation(state_).wheels[i];
    const double torque_Nm =
        at.couple_Nm - wheel.motor_Nm + wheel.brake_Nm + (is_flat() ? at.now.parasitic_N * at.loaded_radius_m : 0.0);
    state_.updY()[static_cast<int>(slip_state(i))] = torque_Nm / at.loaded_radius_m / slip_spring_N_per_m();
  }

  void fill_integrands(double* integrands) const override {
    fill_vehicle_integrands(integrands);
    for (std::size_t i = 0; i < corners_.size(); ++i) fill_wheel_integrands(i, integrands);
  }

  void fill_vehicle_integrands(double* integrands) const {
    const auto put = [integrands](VehicleIntegral integral, double value) { integrands[index_of(integral)] = value; };
    const DriveEvaluation& at = drive_->evaluation(state_);
    const double counted = segment_.inputs[index_of(VehicleInput::kCounted)].start;
    const double body_m_s = at.speed_m_s;
    double motor_W = 0.0, brake_W = 0.0, roller_W = 0.0, tire_W = 0.0, slip_W = 0.0, bearing_W = 0.0;
    double own_share = 0.0;  // of the motor, at the simulated hubs
    double tire_damper_W = 0.0, suspension_W = 0.0, heat_W = 0.0, air_W = 0.0, road_W = 0.0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const ContactEvaluation& contact = contacts_[i]->evaluation(state_);
      const DriveEvaluation::Wheel& wheel = at.wheels[i];
      const double hub_rad_s = bodies_.wheels[i].wheel.getOneU(state_, 0);  // against the upright, which may pitch
      motor_W += wheel.motor_Nm * hub_rad_s;
      brake_W += wheel.brake_Nm * hub_rad_s;
      own_share += layout_.wheels[i].motor_share;
      tire_W += contact.couple_Nm * (contact.wheel_speed_rad_s + contact.surface_speed_rad_s);
      slip_W += contact.slip.dissipated_W;
      bearing_W += contact.now.parasitic_N *
                   (is_flat() ? contact.loaded_radius_m * hub_rad_s : roller_radius_m_ * contact.surface_speed_rad_s);
      const double spring_N =
          corners_[i].context().tire.stiffness.vertical_N_per_m * std::max(0.0, contact.deflection_m);
      tire_damper_W += (contact.normal_N - spring_N) * contact.deflection_rate_m_s;
      suspension_W += wheel.suspension_damper_N * bodies_.wheels[i].upright.getOneU(state_, 0);
      roller_W += calc_given_W(i, wheel, at);
      heat_W += contact.now.heat.heat_in_W;
      air_W += contact.now.heat.to_air_W;
      road_W += contact.now.heat.to_road_W;
    }
    if (is_flat()) roller_W += (at.assist_N - at.grade_N) * body_m_s;
    if (!is_flat() && bodies_.has_sled()) suspension_W -= at.tie_down_damper_N * bodies_.sled.getOneU(state_, 0);
    const double drive_W = own_share > 0.0 ? motor_W / own_share : at.motor_N * body_m_s;
    put(VehicleIntegral::kTraction, at.demand_N);
    put(VehicleIntegral::kDistance, body_m_s);
    put(VehicleIntegral::kCountedTime, counted);
    put(VehicleIntegral::kCountedDistance, counted * body_m_s);
    put(VehicleIntegral::kDriveEnergy, std::max(0.0, drive_W));
    put(VehicleIntegral::kRecuperated, std::max(0.0, -drive_W));
    put(VehicleIntegral::kDriveWork, motor_W);
    put(VehicleIntegral::kRollerWork, roller_W);
    put(VehicleIntegral::kThroughput, std::abs(motor_W) + std::abs(roller_W));
    put(VehicleIntegral::kKnotWork, 0.0);
    put(VehicleIntegral::kTireLoss, tire_W);
    put(VehicleIntegral::kSlipLoss, slip_W);
    put(VehicleIntegral::kBearingLoss, bearing_W);
    put(VehicleIntegral::kBrakeLoss, brake_W);
    put(VehicleIntegral::kDragLoss, at.drag_N * body_m_s);
    put(VehicleIntegral::kTireDamperLoss, tire_damper_W);
    put(VehicleIntegral::kSuspensionDamperLoss, suspension_W);
    put(VehicleIntegral::kHeatGenerated, heat_W);
    put(VehicleIntegral::kHeatToAir, air_W);
    put(VehicleIntegral::kHeatToRoad, road_W);
  }

  /// Power of the roller's motor, of the rest of the vehicle through it, and of the restraint.
  double calc_given_W(std::size_t i, const DriveEvaluation::Wheel& wheel, const DriveEvaluation& at) const {
    const Vec3 axle_m_s = bodies_.body.findStationVelocityInGround(state_, Vec3(layout_.wheels[i].axle_x_m, 0, 0));
    const Vec3 upright_m_s = bodies_.wheels[i].upright.getBodyOriginVelocity(state_);
    const double restraint_W =
        -(wheel.on_body_N + bodies_.wheels[i].ballast_N) * axle_m_s[1] - wheel.on_upright_N * upright_m_s[1];
    if (is_flat()) return restraint_W;
    const double assist_Nm = at.assist_N * roller_radius_m_ / static_cast<double>(corners_.size());
    return restraint_W + (wheel.roller_Nm + assist_Nm) * bodies_.wheels[i].roller.getOneU(state_, 0);
  }

  /// Of the vehicle: what the driver follows, or what slows it while it coasts.
  double calc_acceleration_m_s2() const {
    const DriveEvaluation& at = drive_->evaluation(state_);
    if (drive_->driver_on()) return at.acting.acceleration_m_s2;
    double resistance_N = at.drag_N + at.grade_N;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const models::Instant<double>& now = contacts_[i]->evaluation(state_).now;
      resistance_N += now.rolling_resistance_N + now.parasitic_N;
      if (!is_flat()) resistance_N -= at.wheels[i].roller_Nm / roller_radius_m_;
    }
    return -resistance_N / (contact_port_.vehicle_mass_factor * (layout_.mass_kg + layout_.rotating_mass_kg));
  }

  void fill_wheel_integrands(std::size_t i, double* integrands) const {
    const auto put = [&](WheelIntegral integral, double value) { integrands[index_of(integral, i)] = value; };
    const ContactEvaluation& at = contacts_[i]->evaluation(state_);
    const models::Instant<double>& now = at.now;
    const double counted = segment_.inputs[index_of(VehicleInput::kCounted)].start;
    const double speed_m_s = now.motion.speed_m_s;
    const double rolling_W = now.rolling_resistance_N * now.motion.rolling_speed_m_s;
    constexpr double kLeast_m_s = 1.0;  // below, slip power over speed says nothing
    // What the stiff contact of the baseline dissipates is of the numerics, not of the tire (baseline.md).
    const double slip_W = now.contact.slip_compliance_per_N > 0.0 ? at.slip.dissipated_W : 0.0;
    put(WheelIntegral::kLossForce,
        models::calc_loss_force_N(now, slip_W / std::max(std::abs(speed_m_s), kLeast_m_s), calc_acceleration_m_s2()));
    put(WheelIntegral::kLinerTemperature, now.thermal.temperature_K[models::index_of(Node::kRubber)]);
    put(WheelIntegral::kCavityPressure, now.pressure_Pa);
    put(WheelIntegral::kGasTemperature, now.thermal.temperature_K[models::index_of(Node::kGas)]);
    put(WheelIntegral::kRollingResistance, now.rolling_resistance_N);
    put(WheelIntegral::kParasitic, now.parasitic_N);
    put(WheelIntegral::kLongitudinalForce, now.recorded.longitudinal_force_N);
    put(WheelIntegral::kContactLoad, at.normal_N);
    put(WheelIntegral::kRollingEnergy, rolling_W);
    put(WheelIntegral::kCountedRollingEnergy, counted * rolling_W);
    put(WheelIntegral::kCountedRrc, at.normal_N > 0.0 ? counted * now.rolling_resistance_N / at.normal_N : 0.0);
  }

  std::vector<Corner<double>>& corners_;
  VehicleLayout layout_;
  VehicleStart<double> start_;
  bool surface_recorded_;
  models::ContactPort<double> contact_port_;
  double roller_radius_m_;
  double suspension_stiffness_N_per_m_ = 0.0;
  VehicleBodies bodies_;
  std::vector<ContactForceElement*> contacts_;  // these and the drive are owned by the force subsystem
  VehicleDrive* drive_ = nullptr;
  std::size_t first_u_ = 0;
  std::size_t first_z_ = 0;
};

MultibodyVehicle::MultibodyVehicle(std::vector<Corner<double>>& corners, const VehicleLayout& layout,
                                   const VehicleFile& vehicle, const RigFile& rig, VehicleStart<double> start,
                                   bool surface_recorded)
    : MultibodyRig(guarded([&] {
        return std::make_unique<Implementation>(corners, layout, vehicle, rig, std::move(start), surface_recorded);
      })),
      implementation_(static_cast<Implementation&>(system())) {}

VehicleForces MultibodyVehicle::find_forces(double time_s, const double* state) {
  return guarded([&] { return implementation_.find_forces(time_s, state); });
}

}  // namespace rollrig::rigs
