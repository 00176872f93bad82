#pragma once
/// What the multibody rigs share around Simbody.

#include <Simbody.h>

#include <string>
#include <vector>

#include "models/corner.h"
#include "rigs/multibody/rig_forces.h"
#include "sim/core/error.h"

namespace rollrig::rigs {

/// Runs `call`; what Simbody refuses (a state that is not finite, say) is a failed run.
template <class Call>
auto guarded(Call&& call) {
  try {
    return call();
  } catch (const SimTK::Exception::Base& error) {
    throw RunFailure(std::string("the multibody rig cannot go on: ") + error.getMessage());
  }
}

/// A slider moves along its frame's x axis, here the ground's y; a pin turns about its frame's z axis, here the
/// ground's -z, so that a wheel that rolls forwards turns positively.
inline const SimTK::Transform kUpwards(SimTK::Rotation(SimTK::Pi / 2, SimTK::ZAxis), SimTK::Vec3(0));
inline const SimTK::Transform kReversed(SimTK::Rotation(SimTK::Pi, SimTK::XAxis), SimTK::Vec3(0));

/// A body that turns about z: the given inertia about that axis, a plausible one about the others.
SimTK::Body::Rigid make_rotor(double mass_kg, double spin_inertia_kg_m2);
/// A tire on its wheel.
SimTK::Body::Rigid make_wheel(const models::TireParameters<double>& tire);
/// A body that does not turn.
SimTK::Body::Rigid make_block(double mass_kg);

/// Port "contact and inertia" of a corner. The bodies are built with it, so on a multibody rig it may depend
/// on parameters only, not on time or state.
models::ContactPort<double> find_contact_port(const models::Corner<double>& corner);

/// Speed that a rig's motor or driver has to keep: the recorded speed is the set point, and who does not follow it
/// makes a failed run, not a result.
struct SpeedHold {
  const char* who;  // "the motor does not hold"
  double share;
  double floor_m_s;

  /// Throws RunFailure where the speed is off by more than the floor and the share.
  void require(double time_s, double set_m_s, double is_m_s) const;
};

/// Bodies and forces in Simbody under gravity, y up. The state vector is Simbody's: q, u, z of all bodies and forces.
/// A rig's constructor adds the bodies, then calls add_forces().
class SimbodySystem : public RigSystem<double> {
 public:
  std::size_t state_count() const override { return static_cast<std::size_t>(state_.getNY()); }
  void begin_segment(const sim::Segment& segment, double time_s, double* y, double* integrals) override;
  void evaluate(double time_s, const double* y, double* rates, double* integrands) override;
  void require_possible(const double* y) const override;
  void calc_stored(double time_s, const double* y, double* stored_J) override;

  const models::Inflation<double>& inflation() const { return rig_forces_->contacts().front().inflation(); }

 protected:
  /// `corners`, one a wheel, outlive it.
  SimbodySystem(Lists lists, std::vector<models::Corner<double>*> corners, RigStart<double> start,
                bool surface_recorded);
  /// At a state realized to Stage::Dynamics.
  virtual void fill_integrands(double* integrands) const = 0;

  /// Takes over all forces beside gravity; the system is complete then.
  void add_forces(RigForces* forces);
  /// Everything at zero but the corners, whose tires are soaked and inflated, to pressures of their own where these are
  /// not 0; `loads_N` rest on them.
  void begin_run(const sim::Segment& first, double time_s, const std::vector<double>& loads_N,
                 const std::vector<double>& pressures_Pa);
  void set_pressure(double pressure_Pa, double* y) override;
  void set_drive(bool on, double* y) override;
  std::size_t tire_temperature_state() const override;

  /// What is realized stays where neither time nor state has changed.
  void set_state(double time_s, const double* y);
  void realize_at(double time_s, const double* y, SimTK::Stage stage);
  void copy_state(double* y) const;

  std::size_t q_state(const SimTK::MobilizedBody& body) const {
    return static_cast<std::size_t>(body.getFirstQIndex(state_));
  }
  std::size_t u_state(const SimTK::MobilizedBody& body) const {
    return static_cast<std::size_t>(state_.getNQ() + body.getFirstUIndex(state_));
  }
  /// Index of a contact's slip deflection in the state vector, which the states of its corner follow; of the first
  /// state of the rig's own.
  std::size_t slip_state(std::size_t wheel) const { return state_of(rig_forces_->contact_z(wheel)); }
  std::size_t own_state() const { return state_of(rig_forces_->own_z()); }
  const ContactEvaluation& contact(std::size_t wheel) const { return rig_forces_->contact_evaluation(state_, wheel); }
  const models::Corner<double>& corner(std::size_t wheel) const { return *corners_[wheel]; }
  /// Effects' and further nodes' states after those of rubber and gas; returns the place after them.
  double* put_further_states(std::size_t wheel, const double* y, double* values) const;
  /// Tolerances of a contact's states, from the force that does not matter and the share of a state's scale.
  void put_tolerances(std::size_t wheel, double slip_force_N, double state_share,
                      std::vector<double>& tolerances) const;

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::Force::UniformGravity gravity_;
  SimTK::State state_;

 private:
  std::size_t state_of(SimTK::ZIndex z) const {
    return static_cast<std::size_t>(state_.getNQ() + state_.getNU()) + static_cast<std::size_t>(z);
  }

  std::vector<models::Corner<double>*> corners_;
  RigStart<double> start_;
  RigForces* rig_forces_ = nullptr;  // owned by the force subsystem
};

}  // namespace rollrig::rigs
