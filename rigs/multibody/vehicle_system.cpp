#include "rigs/multibody/vehicle_system.h"

#include <Simbody.h>

#include <algorithm>
#include <utility>

#include "models/wheel/rolling_wheel.h"
#include "rigs/multibody/guarded_rig.h"
#include "rigs/multibody/simbody_system.h"
#include "rigs/multibody/vehicle_bodies.h"
#include "rigs/multibody/vehicle_drive.h"

namespace rollrig::rigs {

using models::Corner;
using SimTK::Stage;

namespace {

// Errors that do not matter at a relative tolerance of 1e-6, for the integrator's control. A drive starts
// afresh at every row of its trace, so that mechanics are held to what the audit of a drive needs.
constexpr double kVehicleAngleError_rad = 100.0;
constexpr double kVehicleDistanceError_m = 100.0;
constexpr double kVehicleHeightError_m = 1e-6;
constexpr double kVehicleSpeedError_rad_s = 1e-5;
constexpr double kVehicleSpeedError_m_s = 1e-5;
constexpr double kVehicleSlipForceError_N = 0.5;
constexpr double kVehicleStateShare = 1e-6;  // of a corner state's scale
constexpr double kVehicleSpeedIntegralError_m = 1e-5;

// Assumed: about the tolerance of drive cycles, 2 mph, and of SAE J1634 at low speed.
constexpr SpeedHold kDriverHold{"the driver does not keep", 0.02, 0.5};

class VehicleSystem : public SimbodySystem {
 public:
  VehicleSystem(std::vector<Corner<double>>& corners, const VehicleLayout& layout, RigStart<double> start,
                bool surface_recorded)
      : SimbodySystem({make_vehicle_integrals(layout), make_vehicle_stores(),
                       make_vehicle_channels(layout, corners, surface_recorded)},
                      list_corners(corners), std::move(start), surface_recorded),
        layout_(layout),
        contact_port_(find_contact_port(corners.front())) {
    Tires tires;
    for (const Corner<double>& corner : corners) tires.push_back(&corner.context().tire);
    bodies_ = add_vehicle_bodies(matter_, layout_, tires, contact_port_.vehicle_mass_factor);
    std::vector<WheelContact> contacts;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const VehicleBodies::Wheel& wheel = bodies_.wheels[i];
      const auto surface = is_on_road() ? SimTK::GroundIndex : wheel.roller.getMobilizedBodyIndex();
      contacts.emplace_back(
          matter_,
          WheelContact::Bodies{wheel.wheel.getMobilizedBodyIndex(), surface, wheel.upright.getMobilizedBodyIndex()},
          corners[i], find_contact_port(corners[i]).slip_compliance_per_N);
    }
    drive_ = new VehicleDrive(forces_, std::move(contacts), bodies_, layout_, present_);
    add_forces(drive_);
  }

  std::vector<double> state_tolerances() const override {
    std::vector<double> tolerances(state_count(), 0.0);
    const auto put = [&](const SimTK::MobilizedBody& body, double position, double speed) {
      tolerances[q_state(body)] = position;
      tolerances[u_state(body)] = speed;
    };
    if (bodies_.has_sled())
      put(bodies_.sled, is_on_road() ? kVehicleDistanceError_m : kVehicleHeightError_m, kVehicleSpeedError_m_s);
    put(bodies_.heave, kVehicleHeightError_m, kVehicleSpeedError_m_s);
    put(bodies_.body, kVehicleHeightError_m, kVehicleSpeedError_m_s);
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      put(bodies_.wheels[i].upright, kVehicleHeightError_m, kVehicleSpeedError_m_s);
      put(bodies_.wheels[i].wheel, kVehicleAngleError_rad, kVehicleSpeedError_rad_s);
      if (!is_on_road()) put(bodies_.wheels[i].roller, kVehicleAngleError_rad, kVehicleSpeedError_rad_s);
      put_tolerances(i, kVehicleSlipForceError_N, kVehicleStateShare, tolerances);
    }
    tolerances[own_state()] = kVehicleSpeedIntegralError_m;
    return tolerances;
  }

  /// Heights are relative: the body's to where it is under static load, an axle's to the body.
  std::vector<sim::PoseCoordinate> poses() const override {
    std::vector<sim::PoseCoordinate> poses;
    const auto add = [&](const Quantity& quantity, const SimTK::MobilizedBody& body) {
      poses.push_back({quantity, q_state(body)});
    };
    if (bodies_.has_sled()) add({"position", "m"}, bodies_.sled);
    add({"body_heave", "m"}, bodies_.heave);
    if (bodies_.pitches) add({"body_pitch", "rad"}, bodies_.body);
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      add(wheel_channel({"axle_travel", "m"}, layout_.wheels[i]), bodies_.wheels[i].upright);
      add(wheel_channel({"wheel_angle", "rad"}, layout_.wheels[i]), bodies_.wheels[i].wheel);
      if (!is_on_road()) add(wheel_channel({"roller_angle", "rad"}, layout_.wheels[i]), bodies_.wheels[i].roller);
    }
    return poses;
  }

  void initialize(const sim::Segment& first, double time_s, double* y) override {
    std::vector<double> loads_N;
    std::vector<double> pressures_Pa;
    for (const WheelPlace& wheel : layout_.wheels) {
      loads_N.push_back(wheel.static_load_N);
      pressures_Pa.push_back(wheel.pressure_Pa);
    }
    begin_run(first, time_s, loads_N, pressures_Pa);
    set_equilibrium();
    copy_state(y);
  }

  void observe(double time_s, const double* y, double* values) override {
    models::InputPort<double> inputs;
    read_vehicle_inputs(present_, time_s, inputs);
    const double recorded_m_s = find_recorded_speed_m_s(time_s, y);
    const DriveEvaluation& at = drive_->evaluation(state_);
    if (present_.drive_on) kDriverHold.require(time_s, at.acting.speed_m_s, at.speed_m_s);
    *values++ = present_.drive_on ? inputs.speed_m_s : recorded_m_s;
    *values++ = inputs.ambient_K;
    if (present_.surface_recorded) *values++ = inputs.surface_K;
    for (std::size_t i = 0; i < layout_.wheels.size(); ++i) {
      *values++ = layout_.wheels[i].static_load_N;
      values = put_further_states(i, y, values);
    }
  }

  VehicleForces find_forces(double time_s, const double* y) {
    realize_at(time_s, y, Stage::Acceleration);
    const DriveEvaluation& drive = drive_->evaluation(state_);
    VehicleForces forces;
    forces.tie_down_N = drive.tie_down_N + drive.tie_down_damper_N;
    forces.speed_m_s = drive.speed_m_s;
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) forces.wheels.push_back(find_wheel_forces(i));
    return forces;
  }

 private:
  VehicleForces::Wheel find_wheel_forces(std::size_t i) const {
    const VehicleBodies::Wheel& bodies = bodies_.wheels[i];
    const ContactEvaluation& at = contact(i);
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
    if (is_on_road()) return wheel;
    const SimTK::SpatialVec pin = bodies.roller.findMobilizerReactionOnBodyAtMInGround(state_);
    wheel.roller_reaction_N = pin[1][0];
    wheel.roller_lift_N = pin[1][1];
    return wheel;
  }

  bool is_on_road() const { return models::is_on_road(layout_.machine); }

  void set_drive(bool on, double* y) override {
    SimbodySystem::set_drive(on, y);
    if (!on) y[own_state()] = 0.0;
  }

  double find_recorded_speed_m_s(double time_s, const double* y) override {
    realize_at(time_s, y, Stage::Velocity);
    const DriveEvaluation& at = drive_->evaluation(state_);
    models::InputPort<double> recorded;
    read_vehicle_inputs(present_, time_s, recorded);
    return models::calc_recorded_speed_m_s(at.speed_m_s, recorded, at.acting);
  }

  /// Steady rolling at the first inputs: restraint carried, no slip, driver in balance.
  void set_equilibrium() {
    system_.realize(state_, Stage::Velocity);
    const DriveEvaluation drive = drive_->evaluation(state_);
    const double speed_m_s = drive.acting.speed_m_s;
    bodies_.heave.setOneQ(state_, 0, -drive.sinks_m);
    if (is_on_road()) bodies_.sled.setOneU(state_, 0, speed_m_s);
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      const VehicleBodies::Wheel& wheel = bodies_.wheels[i];
      wheel.upright.setOneQ(state_, 0, drive.sinks_m - drive.wheels[i].restraint_N / drive_->tire_N_per_m(i));
      wheel.wheel.setOneU(state_, 0, speed_m_s / drive.wheels[i].radius_m);
      if (!is_on_road()) wheel.roller.setOneU(state_, 0, speed_m_s / layout_.roller_radius_m);
    }
    set_driver_in_balance(drive.acting);
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) set_slip_in_balance(i);
  }

  void set_driver_in_balance(const models::InputPort<double>& acting) {
    system_.realize(state_, Stage::Velocity);
    double force_N = drive_->evaluation(state_).drag_N + drive_->evaluation(state_).grade_N;
    if (!is_on_road()) force_N += models::calc_faded_road_load_N(layout_.resistance, acting.speed_m_s);
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      const models::Instant<double> now = drive_->evaluate_contact(state_, i).now;
      force_N += now.rolling_resistance_N + (is_on_road() ? now.parasitic_N : 0.0);
    }
    force_N += (layout_.mass_kg + layout_.rotating_mass_kg) * acting.acceleration_m_s2;
    state_.updY()[static_cast<int>(own_state())] = drive_->find_integral_m(force_N, acting);
  }

  /// The deflection that carries the wheel's torques at its present speed.
  void set_slip_in_balance(std::size_t i) {
    system_.realize(state_, Stage::Velocity);
    const ContactEvaluation at = drive_->evaluate_contact(state_, i);
    const DriveEvaluation::Wheel& wheel = drive_->evaluation(state_).wheels[i];
    const double torque_Nm =
        at.couple_Nm - wheel.motor_Nm + wheel.brake_Nm + (is_on_road() ? at.now.parasitic_N * at.loaded_radius_m : 0.0);
    state_.updY()[static_cast<int>(slip_state(i))] =
        torque_Nm / at.loaded_radius_m / drive_->contacts()[i].slip_spring_N_per_m();
  }

  void fill_integrands(double* integrands) const override {
    const DriveEvaluation& at = drive_->evaluation(state_);
    const VehiclePowers<double> powers = find_powers();
    put_vehicle_integrands(present_, at.demand_N, at.speed_m_s, powers, integrands);
    put_battery_integrand(layout_, at.speed_m_s, powers.drive_W, integrands);
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      const models::Instant<double>& now = contact(i).now;
      constexpr double kLeast_m_s = 1.0;  // below, slip power over speed says nothing
      // What the stiff contact of the baseline dissipates is of the numerics, not of the tire.
      const double slip_W = now.contact.slip_compliance_per_N > 0.0 ? now.motion.slip_power_W : 0.0;
      const double slip_N = slip_W / std::max(std::abs(now.motion.speed_m_s), kLeast_m_s);
      put_wheel_integrands(present_, now, models::calc_loss_force_N(now, slip_N, calc_acceleration_m_s2(at)),
                           &integrands[index_of(WheelIntegral::kLossForce, i)]);
    }
  }

  VehiclePowers<double> find_powers() const {
    VehiclePowers<double> power = drive_->find_powers(state_);
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      const ContactEvaluation& at = contact(i);
      const double bearing_m_s = is_on_road() ? at.loaded_radius_m * bodies_.wheels[i].wheel.getOneU(state_, 0)
                                              : layout_.roller_radius_m * at.surface_speed_rad_s;
      power.tire_W += at.couple_Nm * (at.wheel_speed_rad_s + at.surface_speed_rad_s);
      power.bearing_W += at.now.parasitic_N * bearing_m_s;
      power.tire_damper_W += drive_->contacts()[i].calc_tire_damper_W(at);
      power.add_slip_and_heat(at.now);
    }
    return power;
  }

  /// Of the vehicle: what the driver follows, or what slows it while it coasts.
  double calc_acceleration_m_s2(const DriveEvaluation& at) const {
    if (present_.drive_on) return at.acting.acceleration_m_s2;
    double resistance_N = at.drag_N + at.grade_N;
    for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
      const models::Instant<double>& now = contact(i).now;
      resistance_N += now.rolling_resistance_N + now.parasitic_N;
      if (!is_on_road()) resistance_N -= at.wheels[i].roller_Nm / layout_.roller_radius_m;
    }
    return -resistance_N / (contact_port_.vehicle_mass_factor * (layout_.mass_kg + layout_.rotating_mass_kg));
  }

  VehicleLayout layout_;
  models::ContactPort<double> contact_port_;
  VehicleBodies bodies_;
  VehicleDrive* drive_ = nullptr;  // owned by the force subsystem
};

class GuardedVehicle : public GuardedRig<MultibodyVehicle, VehicleSystem> {
 public:
  using GuardedRig::GuardedRig;

  VehicleForces find_forces(double time_s, const double* state) override {
    return guarded([&] { return system().find_forces(time_s, state); });
  }
};

}  // namespace

std::unique_ptr<MultibodyVehicle> make_vehicle_system(std::vector<Corner<double>>& corners, const VehicleLayout& layout,
                                                      const RigStart<double>& start, bool surface_recorded) {
  return std::make_unique<GuardedVehicle>(corners, layout, start, surface_recorded);
}

}  // namespace rollrig::rigs
