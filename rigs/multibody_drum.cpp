#include "rigs/multibody_drum.h"

#include <fmt/format.h>

#include <Simbody.h>

#include <algorithm>
#include <stdexcept>

#include "models/contact_force_element.h"
#include "rigs/drum_actuators.h"
#include "rigs/simbody_system.h"
#include "sim/core/error.h"

namespace rollrig::rigs {

using models::ContactEvaluation;
using models::ContactForceElement;
using models::Corner;
using models::Node;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::Transform;
using SimTK::Vec3;

namespace {

/// A body that turns about z: the given inertia about that axis, a plausible one about the others.
SimTK::Body::Rigid make_rotor(double mass_kg, double spin_inertia_kg_m2) {
  constexpr double kTransverseShare = 0.6;  // between a disk (0.5) and a ring; no motion depends on it
  const double transverse_kg_m2 = kTransverseShare * spin_inertia_kg_m2;
  return SimTK::Body::Rigid(
      SimTK::MassProperties(mass_kg, Vec3(0), SimTK::Inertia(transverse_kg_m2, transverse_kg_m2, spin_inertia_kg_m2)));
}

SimTK::Body::Rigid make_block(double mass_kg) {
  return SimTK::Body::Rigid(SimTK::MassProperties(mass_kg, Vec3(0), SimTK::Inertia(mass_kg)));
}

// Errors that do not matter at a relative tolerance of 1e-6, for the integrator's control.
constexpr double kAngle_rad = 1.0;
constexpr double kHeight_m = 1e-9;
constexpr double kSpeed_rad_s = 1e-8;
constexpr double kCarriageSpeed_m_s = 1e-8;
constexpr double kSlipForce_N = 1e-4;
constexpr double kStateShare = 1e-7;  // of a corner state's scale
constexpr double kSpeedIntegral_rad = 1e-8;
constexpr double kCylinderLag_N = 1e-5;

}  // namespace

class MultibodyDrum::Implementation : public SimbodySystem {
 public:
  Implementation(Corner<double>& corner, const RigFile& rig, DrumStart<double> start, bool surface_recorded)
      : SimbodySystem(make_drum_integrals(Detail::kFull), make_drum_stores(Detail::kFull),
                      make_drum_channels(corner.states(), surface_recorded, Detail::kFull)),
        corner_(corner),
        start_(std::move(start)),
        surface_recorded_(surface_recorded),
        contact_port_(find_contact_port(corner)),
        drum_(matter_.Ground(), Transform(),
              make_rotor(kDrumMass_kg, rig.drum.inertia_kg_m2 * contact_port_.machine_inertia_factor), Transform()),
        carriage_(matter_.Ground(), kUpwards, make_block(rig.carriage.mass_kg), kUpwards),
        wheel_(carriage_, kReversed,
               make_rotor(corner.context().tire.geometry.mass_kg + corner.context().tire.geometry.wheel_mass_kg,
                          corner.context().tire.geometry.spin_inertia_kg_m2),
               kReversed),
        contact_(new ContactForceElement(
            forces_, matter_,
            {wheel_.getMobilizedBodyIndex(), drum_.getMobilizedBodyIndex(), carriage_.getMobilizedBodyIndex()}, corner,
            [this](const SimTK::State& state) { return find_inputs(state.getTime()); })),
        actuators_(new DrumActuators(
            forces_, matter_,
            {drum_.getMobilizedBodyIndex(), carriage_.getMobilizedBodyIndex(), wheel_.getMobilizedBodyIndex()}, rig,
            *contact_, corner.context())) {
    contact_->update_contact_parameters(contact_port_.slip_compliance_per_N);
    SimTK::Force::Custom(forces_, contact_);
    SimTK::Force::Custom(forces_, actuators_);
    realize_topology();
  }

  std::vector<double> state_tolerances() const override {
    const double spring_N_per_m = slip_spring_N_per_m();
    std::vector<double> tolerances{kAngle_rad,
                                   kHeight_m,
                                   kAngle_rad,
                                   kSpeed_rad_s,
                                   kCarriageSpeed_m_s,
                                   kSpeed_rad_s,
                                   kSlipForce_N / spring_N_per_m};
    for (const models::CornerState& state : corner_.states()) tolerances.push_back(kStateShare * state.scale_SI);
    tolerances.push_back(kSpeedIntegral_rad);
    tolerances.push_back(kCylinderLag_N);
    return tolerances;
  }

  /// The axle of the wheel is at the carriage's height above that of the drum.
  std::vector<sim::PoseCoordinate> poses() const override {
    return {{"drum_angle_rad", 0}, {"axle_height_m", 1}, {"wheel_angle_rad", 2}};
  }

  const models::Inflation<double>& inflation() const { return contact_->inflation(); }

  void initialize(const sim::Segment& first, double time_s, double* y) override {
    take_segment(first, time_s);
    actuators_->set_motor(true);
    contact_->set_inflation(start_.inflation());
    SimTK::Vector& z = forces_.updZ(state_);
    z = 0.0;
    const double load_N = first.inputs[index_of(DrumInput::kLoad)].start;
    corner_.initialize(start_.tire_temperature_K, start_.history_under(load_N), &z[contact_->first_z() + 1]);
    set_equilibrium(time_s);
    copy_state(y);
  }

  void begin_phase(const sim::Phase& phase, double, double* y) override {
    for (const sim::Command& command : phase.commands) {
      if (command.name == kSetPressure) {
        models::Inflation<double> inflation = contact_->inflation();
        corner_.inflate(command.value_SI, y + corner_offset(), inflation);
        contact_->set_inflation(inflation);
      } else if (command.name == kMotor) {
        actuators_->set_motor(command.value_SI != 0.0);
      } else {
        throw std::invalid_argument("drum rig: unknown command " + command.name);
      }
    }
    state_.invalidateAllCacheAtOrAbove(SimTK::Stage::Time);
  }

  void begin_segment(const sim::Segment& segment, double time_s, double* y, double*) override {
    const double former_N = find_acting(time_s, y).load_N;
    take_segment(segment, time_s);
    y[kSlipState + static_cast<std::size_t>(actuators_->lag_z() - contact_->first_z())] +=
        former_N - find_acting(time_s, y).load_N;
  }

  void require_possible(const double* y) const override { corner_.require_possible(y + corner_offset()); }

  double watch(const std::string& name, double time_s, const double* y) override {
    if (name == kWatchTireTemperature) return y[corner_offset() + corner_.state_of(Node::kRubber)];
    if (name != kWatchSpeed) throw std::invalid_argument("drum rig: cannot watch " + name);
    return find_recorded_speed_m_s(time_s, y);
  }

  void observe(double time_s, const double* y, double* values) override {
    const models::InputPort<double> inputs = find_inputs(time_s);
    if (actuators_->motor_on()) require_speed_held(time_s, y);
    *values++ = actuators_->motor_on() ? inputs.speed_m_s : find_recorded_speed_m_s(time_s, y);
    *values++ = inputs.load_N;
    *values++ = inputs.ambient_K;
    if (surface_recorded_) *values++ = inputs.surface_K;
    for (std::size_t i = 2; i < corner_.state_count(); ++i) *values++ = y[corner_offset() + i];
  }

  void calc_stored(double time_s, const double* y, double* stored_J) override {
    set_state(time_s, y);
    system_.realize(state_, SimTK::Stage::Dynamics);
    const ContactEvaluation& at = contact_->evaluation(state_);
    stored_J[index_of(DrumStore::kKinetic)] = system_.calcKineticEnergy(state_);
    stored_J[index_of(DrumStore::kTireSpring)] = contact_->calc_tire_spring_J(at);
    stored_J[index_of(DrumStore::kSlipSpring)] = contact_->calc_slip_spring_J(state_);
    stored_J[index_of(DrumStore::kGravity)] = system_.calcPotentialEnergy(state_) -
                                              stored_J[index_of(DrumStore::kTireSpring)] -
                                              stored_J[index_of(DrumStore::kSlipSpring)];
    stored_J[index_of(DrumStore::kHeat)] = corner_.calc_stored_heat_J(y + corner_offset());
  }

  DrumForces find_forces(double time_s, const double* y) {
    set_state(time_s, y);
    system_.realize(state_, SimTK::Stage::Acceleration);
    const ContactEvaluation& at = contact_->evaluation(state_);
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
  static constexpr double kDrumMass_kg = 1000.0;  // no motion depends on it: the drum turns about its center
  static constexpr std::size_t kSpeeds = 3;       // after three angles and positions
  static constexpr std::size_t kSlipState = 6;

  // A slider moves along its frame's x axis, here the ground's y; a pin turns about its frame's z axis,
  // here the ground's -z, so that a rolling wheel turns positively.
  static const Transform kUpwards;
  static const Transform kReversed;

  static constexpr std::size_t corner_offset() { return kSlipState + 1; }

  models::InputPort<double> find_inputs(double time_s) const {
    return read_drum_inputs<double>(segment_, time_in_segment_s(time_s), surface_recorded_);
  }

  /// Inputs as they really act.
  models::InputPort<double> find_acting(double time_s, const double* y) {
    set_state(time_s, y);
    models::Instant<double> now;
    contact_->evaluate_inputs(state_, now);
    return now.acting;
  }

  /// Of the drum as it turns, whether the motor drives it or not.
  double find_recorded_speed_m_s(double time_s, const double* y) {
    const models::InputPort<double> acting = find_acting(time_s, y);
    return models::calc_recorded_speed_m_s(y[kSpeeds] * corner_.context().machine_radius_m, find_inputs(time_s),
                                           acting);
  }

  /// The recorded speed is the set point; a motor that does not follow it is a failed run, not a result.
  void require_speed_held(double time_s, const double* y) {
    constexpr double kShare = 0.02;  // Assumed: a rig would trip
    constexpr double kFloor_m_s = 0.2;
    const double set_m_s = find_acting(time_s, y).speed_m_s;
    const double is_m_s = y[kSpeeds] * corner_.context().machine_radius_m;
    if (std::abs(is_m_s - set_m_s) <= kFloor_m_s + kShare * std::abs(set_m_s)) return;
    throw RunFailure(fmt::format(
        "at t = {:.1f} s the motor does not hold the speed: set {:.1f} km/h, is {:.1f} km/h; what drives or brakes "
        "it (speeds, slope, wind, effects) is more than it can do",
        time_s, unit_of_key("speed_km_h").from_si(set_m_s), unit_of_key("speed_km_h").from_si(is_m_s)));
  }

  double slip_spring_N_per_m() const {
    return models::make_contact_parameters(corner_.context().tire, contact_port_.slip_compliance_per_N)
        .slip_spring_N_per_m;
  }

  /// Steady rolling at the first inputs: load carried, no slip, motor in balance.
  void set_equilibrium(double time_s) {
    models::Instant<double> now;
    state_.setTime(time_s);
    contact_->evaluate_inputs(state_, now);
    const models::Context<double>& context = corner_.context();
    const double radius_m = context.machine_radius_m;
    const double loaded_radius_m = calc_loaded_radius_m(context.tire, now.acting.load_N);
    carriage_.setOneQ(state_, 0, radius_m + loaded_radius_m);
    drum_.setOneU(state_, 0, now.acting.speed_m_s / radius_m);
    wheel_.setOneU(state_, 0, now.acting.speed_m_s / loaded_radius_m);
    system_.realize(state_, SimTK::Stage::Velocity);
    ContactEvaluation at;
    contact_->evaluate(state_, at);
    const double torque_Nm = radius_m * (at.now.rolling_resistance_N + at.now.parasitic_N);
    forces_.updZ(state_)[contact_->first_z()] = at.couple_Nm / loaded_radius_m / slip_spring_N_per_m();
    forces_.updZ(state_)[actuators_->integral_z()] =
        actuators_->find_integral_rad(torque_Nm, now.acting.speed_m_s, now.acting.load_N);
  }

  void fill_integrands(double* integrands) const override {
    const ContactEvaluation& at = contact_->evaluation(state_);
    const ActuatorEvaluation drive = actuators_->evaluate(state_, at.now.acting);
    const double carriage_m_s = carriage_.getOneU(state_, 0);
    const auto put = [integrands](DrumIntegral integral, double value) { integrands[index_of(integral)] = value; };
    put(DrumIntegral::kDrumTorque, drive.motor_torque_Nm);
    put(DrumIntegral::kLinerTemperature, at.now.thermal.temperature_K[models::index_of(Node::kRubber)]);
    put(DrumIntegral::kCavityPressure, at.now.pressure_Pa);
    put(DrumIntegral::kGasTemperature, at.now.thermal.temperature_K[models::index_of(Node::kGas)]);
    put(DrumIntegral::kRollingResistance, at.now.rolling_resistance_N);
    put(DrumIntegral::kParasitic, at.now.parasitic_N);
    put(DrumIntegral::kSpindleForce, at.slip.force_N);
    put(DrumIntegral::kContactLoad, at.normal_N);
    put(DrumIntegral::kMotorWork, drive.motor_torque_Nm * at.surface_speed_rad_s);
    put(DrumIntegral::kMotorThroughput, std::abs(drive.motor_torque_Nm * at.surface_speed_rad_s));
    put(DrumIntegral::kLoadActuatorWork, -drive.cylinder_force_N * carriage_m_s);
    put(DrumIntegral::kKnotWork, 0.0);
    put(DrumIntegral::kTireLoss, at.couple_Nm * (at.wheel_speed_rad_s + at.surface_speed_rad_s));
    put(DrumIntegral::kSlipLoss, at.slip.dissipated_W);
    put(DrumIntegral::kBearingLoss, at.now.parasitic_N * at.surface_speed_rad_s * corner_.context().machine_radius_m);
    const double spring_N = corner_.context().tire.stiffness.vertical_N_per_m * std::max(0.0, at.deflection_m);
    put(DrumIntegral::kTireDamperLoss, (at.normal_N - spring_N) * at.deflection_rate_m_s);
    put(DrumIntegral::kCylinderDamperLoss, -drive.damper_force_N * carriage_m_s);
    put(DrumIntegral::kHeatGenerated, at.now.heat.heat_in_W);
    put(DrumIntegral::kHeatToAir, at.now.heat.to_air_W);
    put(DrumIntegral::kHeatToRoad, at.now.heat.to_road_W);
  }

  Corner<double>& corner_;
  DrumStart<double> start_;
  bool surface_recorded_;
  models::ContactPort<double> contact_port_;
  MobilizedBody::Pin drum_;
  MobilizedBody::Slider carriage_;
  MobilizedBody::Pin wheel_;
  ContactForceElement* contact_;  // both owned by the force subsystem
  DrumActuators* actuators_;
};

const Transform MultibodyDrum::Implementation::kUpwards(Rotation(SimTK::Pi / 2, SimTK::ZAxis), Vec3(0));
const Transform MultibodyDrum::Implementation::kReversed(Rotation(SimTK::Pi, SimTK::XAxis), Vec3(0));

MultibodyDrum::MultibodyDrum(Corner<double>& corner, const RigFile& rig, DrumStart<double> start, bool surface_recorded)
    : MultibodyRig(
          guarded([&] { return std::make_unique<Implementation>(corner, rig, std::move(start), surface_recorded); })),
      implementation_(static_cast<Implementation&>(system())) {}

const models::Inflation<double>& MultibodyDrum::inflation() const { return implementation_.inflation(); }
DrumForces MultibodyDrum::find_forces(double time_s, const double* state) {
  return guarded([&] { return implementation_.find_forces(time_s, state); });
}

}  // namespace rollrig::rigs
