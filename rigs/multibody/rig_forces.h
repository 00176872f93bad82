#pragma once
/// All forces of a multibody rig but gravity, as one force element of Simbody.

#include <Simbody.h>

#include <vector>

#include "rigs/multibody/wheel_contact.h"
#include "rigs/rig_system.h"

namespace rollrig::rigs {

/// Machine or vehicle with its wheels' contacts. At a state it first finds what its motors, brakes and springs do, for
/// which it reads what inputs really act on a wheel; then each contact is handed the inputs of its wheel.
///
/// States    z: those of each contact, then its own
class RigForces : public SimTK::Force::Custom::Implementation {
 public:
  const std::vector<WheelContact>& contacts() const { return contacts_; }
  std::vector<WheelContact>& contacts() { return contacts_; }

  /// Indices among the z of the subsystem: of a contact's first state (its slip deflection), of the first of its own.
  SimTK::ZIndex contact_z(std::size_t wheel) const;
  SimTK::ZIndex own_z() const { return contact_z(contacts_.size()); }

  /// What is known of a contact at a state realized to Dynamics.
  const ContactEvaluation& contact_evaluation(const SimTK::State& state, std::size_t wheel) const;
  /// The same, found anew, at a state realized to Velocity.
  ContactEvaluation evaluate_contact(const SimTK::State& state, std::size_t wheel) const;
  double calc_slip_spring_J(const SimTK::State& state, std::size_t wheel) const;

  /// Energy of its own springs.
  virtual double calc_own_springs_J(const SimTK::State& /*state*/) const { return 0.0; }

  void realizeTopology(SimTK::State& state) const override;
  void realizeAcceleration(const SimTK::State& state) const override;
  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces, SimTK::Vector& mobility_forces) const override;
  /// At a state realized to Dynamics: tires, slip, own springs.
  SimTK::Real calcPotentialEnergy(const SimTK::State& state) const override;

 protected:
  using Contacts = std::vector<ContactEvaluation>;

  RigForces(const SimTK::GeneralForceSubsystem& forces, std::vector<WheelContact> contacts, int own_states);

  /// Recorded inputs of a wheel, with what the hub does, at a state realized to Velocity.
  virtual models::InputPort<double> find_recorded(const SimTK::State& state, std::size_t wheel) const = 0;
  virtual void add_own_forces(const SimTK::State& state, const Contacts& contacts,
                              SimTK::Vector_<SimTK::SpatialVec>& body_forces, SimTK::Vector& mobility_forces) const = 0;
  virtual void put_own_rates(const SimTK::State& state, const Contacts& contacts, double* z_rates) const = 0;
  /// Caches of its own.
  virtual void allocate_own_caches(SimTK::State& /*state*/) const {}

  /// What really acts on a wheel whose recorded inputs are these.
  models::InputPort<double> find_acting(const SimTK::State& state, std::size_t wheel,
                                        const models::InputPort<double>& recorded) const;
  const double* own_states(const SimTK::State& state) const { return &forces_.getZ(state)[own_z()]; }

  const SimTK::GeneralForceSubsystem& forces_;

 private:
  std::vector<WheelContact> contacts_;
  int own_states_;
  mutable SimTK::ZIndex first_z_;
  mutable SimTK::CacheEntryIndex cache_;
};

}  // namespace rollrig::rigs
