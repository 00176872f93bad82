#include "rigs/multibody/rig_forces.h"

#include <utility>

namespace rollrig::rigs {

using SimTK::State;
using SimTK::ZIndex;

RigForces::RigForces(const SimTK::GeneralForceSubsystem& forces, std::vector<WheelContact> contacts, int own_states)
    : forces_(forces), contacts_(std::move(contacts)), own_states_(own_states) {}

ZIndex RigForces::contact_z(std::size_t wheel) const {
  int z = first_z_;
  for (std::size_t i = 0; i < wheel; ++i) z += static_cast<int>(contacts_[i].state_count());
  return ZIndex(z);
}

void RigForces::realizeTopology(State& state) const {
  int count = own_states_;
  for (const WheelContact& contact : contacts_) count += static_cast<int>(contact.state_count());
  first_z_ = forces_.allocateZ(state, SimTK::Vector(count, 0.0));
  cache_ =
      forces_.allocateCacheEntry(state, SimTK::Stage::Dynamics, new SimTK::Value<Contacts>(Contacts(contacts_.size())));
  allocate_own_caches(state);
}

models::InputPort<double> RigForces::find_acting(const State& state, std::size_t wheel,
                                                 const models::InputPort<double>& recorded) const {
  models::Instant<double> now;
  now.recorded = recorded;
  contacts_[wheel].apply_inputs(&forces_.getZ(state)[contact_z(wheel)], now);
  return now.acting;
}

const ContactEvaluation& RigForces::contact_evaluation(const State& state, std::size_t wheel) const {
  return SimTK::Value<Contacts>::downcast(forces_.getCacheEntry(state, cache_)).get()[wheel];
}

ContactEvaluation RigForces::evaluate_contact(const State& state, std::size_t wheel) const {
  ContactEvaluation at;
  at.now.recorded = find_recorded(state, wheel);
  contacts_[wheel].evaluate(state, &forces_.getZ(state)[contact_z(wheel)], at);
  return at;
}

double RigForces::calc_slip_spring_J(const State& state, std::size_t wheel) const {
  return contacts_[wheel].calc_slip_spring_J(&forces_.getZ(state)[contact_z(wheel)]);
}

void RigForces::calcForce(const State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                          SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& mobility_forces) const {
  Contacts& at = SimTK::Value<Contacts>::updDowncast(forces_.updCacheEntry(state, cache_)).upd();
  const double* z = &forces_.getZ(state)[first_z_];
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    at[i].now.recorded = find_recorded(state, i);
    contacts_[i].evaluate(state, z, at[i]);
    contacts_[i].add_forces(state, at[i], body_forces);
    z += contacts_[i].state_count();
  }
  add_own_forces(state, at, body_forces, mobility_forces);
}

void RigForces::realizeAcceleration(const State& state) const {
  const Contacts& at = SimTK::Value<Contacts>::downcast(forces_.getCacheEntry(state, cache_)).get();
  double* rates = &forces_.updZDot(state)[first_z_];
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    WheelContact::put_rates(at[i], rates);
    rates += contacts_[i].state_count();
  }
  put_own_rates(state, at, rates);
}

SimTK::Real RigForces::calcPotentialEnergy(const State& state) const {
  double energy_J = calc_own_springs_J(state);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    energy_J += contacts_[i].calc_tire_spring_J(contact_evaluation(state, i)) + calc_slip_spring_J(state, i);
  }
  return energy_J;
}

}  // namespace rollrig::rigs
