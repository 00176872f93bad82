#include "rigs/multibody/drum_system.h"

#include <Simbody.h>

#include <utility>

#include "models/wheel/rolling_wheel.h"
#include "rigs/multibody/drum_actuators.h"
#include "rigs/multibody/guarded_rig.h"
#include "rigs/multibody/simbody_system.h"

namespace rollrig::rigs {

using models::Corner;
using SimTK::MobilizedBody;
using SimTK::Stage;
using SimTK::Transform;

namespace {

// Errors that do not matter at a relative tolerance of 1e-6, for the integrator's control.
constexpr double kDrumAngleError_rad = 1.0;
constexpr double kDrumHeightError_m = 1e-9;
constexpr double kDrumSpeedError_rad_s = 1e-8;
constexpr double kDrumCarriageSpeedError_m_s = 1e-8;
constexpr double kDrumSlipForceError_N = 1e-4;
constexpr double kDrumStateShare = 1e-7;  // of a corner state's scale
constexpr double kDrumSpeedIntegralError_rad = 1e-8;
constexpr double kDrumCylinderLagError_N = 1e-5;

constexpr double kDrumMass_kg = 1000.0;  // no motion depends on it: the drum turns about its center

/// Along -x, in which the surface of a drum moves under the wheel as well.
const Transform kBackwards(SimTK::Rotation(SimTK::Pi, SimTK::ZAxis));

constexpr SpeedHold kMotorHold{"the motor does not hold", 0.02, 0.2};  // Assumed: a rig would trip

class DrumSystem : public SimbodySystem {
 public:
  DrumSystem(Corner<double>& corner, const RigFile& rig, RigStart<double> start, bool surface_recorded)
      : SimbodySystem({make_drum_integrals(Detail::kFull), make_drum_stores(Detail::kFull),
                       make_drum_channels(corner.context().machine, corner.states(), surface_recorded, Detail::kFull)},
                      {&corner}, std::move(start), surface_recorded) {
    const models::ContactPort<double> port = find_contact_port(corner);
    const double inertia = rig.inertia() * port.machine_inertia_factor;
    if (rig.is_curved()) {
      drum_ = MobilizedBody::Pin(matter_.Ground(), Transform(), make_rotor(kDrumMass_kg, inertia), Transform());
    } else {
      drum_ = MobilizedBody::Slider(matter_.Ground(), kBackwards, make_block(inertia), kBackwards);
    }
    surface_height_m_ = rig.is_curved() ? rig.lever_m() : 0.0;
    carriage_ = MobilizedBody::Slider(matter_.Ground(), kUpwards, make_block(rig.carriage.mass_kg), kUpwards);
    wheel_ = MobilizedBody::Pin(carriage_, kReversed, make_wheel(corner.context().tire), kReversed);
    const WheelContact contact(
        matter_, {wheel_.getMobilizedBodyIndex(), drum_.getMobilizedBodyIndex(), carriage_.getMobilizedBodyIndex()},
        corner, port.slip_compliance_per_N);
    actuators_ = new DrumActuators(forces_, contact, {drum_, carriage_}, rig, present_);
    add_forces(actuators_);
  }

  std::vector<double> state_tolerances() const override {
    std::vector<double> tolerances(state_count(), 0.0);
    const auto put = [&](const MobilizedBody& body, double position, double speed) {
      tolerances[q_state(body)] = position;
      tolerances[u_state(body)] = speed;
    };
    put(drum_, kDrumAngleError_rad, kDrumSpeedError_rad_s);
    put(carriage_, kDrumHeightError_m, kDrumCarriageSpeedError_m_s);
    put(wheel_, kDrumAngleError_rad, kDrumSpeedError_rad_s);
    put_tolerances(0, kDrumSlipForceError_N, kDrumStateShare, tolerances);
    tolerances[own_state()] = kDrumSpeedIntegralError_rad;
    tolerances[own_state() + 1] = kDrumCylinderLagError_N;
    return tolerances;
  }

  /// The axle of the wheel is at the carriage's height above that of the drum.
  std::vector<sim::PoseCoordinate> poses() const override {
    return {{surface_height_m_ > 0.0 ? Quantity("drum_angle", "rad") : Quantity("belt_way", "m"), q_state(drum_)},
            {{"axle_height", "m"}, q_state(carriage_)},
            {{"wheel_angle", "rad"}, q_state(wheel_)}};
  }

  void initialize(const sim::Segment& first, double time_s, double* y) override {
    begin_run(first, time_s, {first.inputs[index_of(DrumInput::kLoad)].start}, {0.0});
    set_equilibrium();
    copy_state(y);
  }

  /// What the cylinder presses goes on from where it was.
  void begin_segment(const sim::Segment& segment, double time_s, double* y, double* integrals) override {
    const double former_N = find_acting(time_s, y).load_N;
    SimbodySystem::begin_segment(segment, time_s, y, integrals);
    y[own_state() + 1] += former_N - find_acting(time_s, y).load_N;
  }

  void observe(double time_s, const double* y, double* values) override {
    const models::InputPort<double> inputs = read_drum_inputs<double>(present_, time_s);
    if (present_.drive_on) kMotorHold.require(time_s, find_acting(time_s, y).speed_m_s, find_speed_m_s(y));
    *values++ = present_.drive_on ? inputs.speed_m_s : find_recorded_speed_m_s(time_s, y);
    *values++ = inputs.load_N;
    *values++ = inputs.ambient_K;
    if (present_.surface_recorded) *values++ = inputs.surface_K;
    put_further_states(0, y, values);
  }

  DrumForces find_forces(double time_s, const double* y) {
    realize_at(time_s, y, Stage::Acceleration);
    const ContactEvaluation& at = contact(0);
    const SimTK::SpatialVec hub = wheel_.findMobilizerReactionOnBodyAtMInGround(state_);
    DrumForces forces;
    forces.motor_torque_Nm = actuators_->evaluate(state_, at.now.acting).motor_torque_Nm;
    forces.contact_load_N = at.normal_N;
    forces.spindle_force_N = at.slip.force_N;
    forces.spindle_reaction_N = -SimTK::dot(hub[1], at.tangent);
    forces.hub_moment_Nm = SimTK::dot(hub[0], at.axis);
    forces.rolling_resistance_N = at.now.rolling_resistance_N;
    forces.parasitic_N = at.now.parasitic_N;
    forces.surface_speed_m_s = at.now.motion.speed_m_s;
    forces.drum_speed_rad_s = at.surface_speed_rad_s;
    forces.wheel_speed_rad_s = at.wheel_speed_rad_s;
    forces.loaded_radius_m = at.loaded_radius_m;
    return forces;
  }

 private:
  /// Inputs as they really act.
  models::InputPort<double> find_acting(double time_s, const double* y) {
    set_state(time_s, y);
    return actuators_->find_acting(state_);
  }

  double find_speed_m_s(const double* y) const { return y[u_state(drum_)] * corner(0).context().machine_radius_m; }

  double find_recorded_speed_m_s(double time_s, const double* y) override {
    return models::calc_recorded_speed_m_s(find_speed_m_s(y), read_drum_inputs<double>(present_, time_s),
                                           find_acting(time_s, y));
  }

  /// Steady rolling at the first inputs: load carried, no slip, motor in balance.
  void set_equilibrium() {
    const models::InputPort<double> acting = actuators_->find_acting(state_);
    const models::Context<double>& context = corner(0).context();
    const double radius_m = context.machine_radius_m;
    const double loaded_radius_m = calc_loaded_radius_m(context.tire, acting.load_N);
    carriage_.setOneQ(state_, 0, surface_height_m_ + loaded_radius_m);
    drum_.setOneU(state_, 0, acting.speed_m_s / radius_m);
    wheel_.setOneU(state_, 0, acting.speed_m_s / loaded_radius_m);
    system_.realize(state_, Stage::Velocity);
    const ContactEvaluation at = actuators_->evaluate_contact(state_, 0);
    const double torque_Nm = radius_m * (at.now.rolling_resistance_N + at.now.parasitic_N);
    SimTK::Vector& y = state_.updY();
    y[static_cast<int>(slip_state(0))] =
        at.couple_Nm / loaded_radius_m / actuators_->contacts().front().slip_spring_N_per_m();
    y[static_cast<int>(own_state())] = actuators_->find_integral_rad(torque_Nm, acting.speed_m_s, acting.load_N);
  }

  void fill_integrands(double* integrands) const override {
    const ContactEvaluation& at = contact(0);
    const ActuatorEvaluation drive = actuators_->evaluate(state_, at.now.acting);
    const double carriage_m_s = carriage_.getOneU(state_, 0);
    put_drum_readings(at.now, drive.motor_torque_Nm, integrands);
    DrumPowers<double> power;
    power.motor_W = drive.motor_torque_Nm * drum_.getOneU(state_, 0);
    power.load_actuator_W = -drive.cylinder_force_N * carriage_m_s;
    power.tire_W = at.couple_Nm * (at.wheel_speed_rad_s + at.surface_speed_rad_s);
    power.bearing_W = at.now.parasitic_N * drum_.getOneU(state_, 0) * corner(0).context().machine_radius_m;
    power.tire_damper_W = actuators_->contacts().front().calc_tire_damper_W(at);
    power.cylinder_damper_W = -drive.damper_force_N * carriage_m_s;
    put_drum_powers(at.now, power, integrands);
  }

  MobilizedBody drum_;             // or belt
  double surface_height_m_ = 0.0;  // height of the surface above the origin of carriage and drum
  MobilizedBody::Slider carriage_;
  MobilizedBody::Pin wheel_;
  DrumActuators* actuators_ = nullptr;  // owned by the force subsystem
};

class GuardedDrum : public GuardedRig<MultibodyDrum, DrumSystem> {
 public:
  using GuardedRig::GuardedRig;

  const models::Inflation<double>& inflation() const override { return system().inflation(); }
  DrumForces find_forces(double time_s, const double* state) override {
    return guarded([&] { return system().find_forces(time_s, state); });
  }
};

}  // namespace

std::unique_ptr<MultibodyDrum> make_drum_system(Corner<double>& corner, const RigFile& rig,
                                                const RigStart<double>& start, bool surface_recorded) {
  return std::make_unique<GuardedDrum>(corner, rig, start, surface_recorded);
}

}  // namespace rollrig::rigs
