#include "rigs/multibody/simbody_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "models/quantities.h"

namespace rollrig::rigs {

using SimTK::Inertia;
using SimTK::Vec3;

SimTK::Body::Rigid make_rotor(double mass_kg, double spin_inertia_kg_m2) {
  constexpr double kTransverseShare = 0.6;  // between a disk (0.5) and a ring; no motion depends on it
  const double transverse_kg_m2 = kTransverseShare * spin_inertia_kg_m2;
  return SimTK::Body::Rigid(
      SimTK::MassProperties(mass_kg, Vec3(0), Inertia(transverse_kg_m2, transverse_kg_m2, spin_inertia_kg_m2)));
}

SimTK::Body::Rigid make_wheel(const models::TireParameters<double>& tire) {
  return make_rotor(tire.geometry.mass_kg + tire.geometry.wheel_mass_kg, tire.geometry.spin_inertia_kg_m2);
}

SimTK::Body::Rigid make_block(double mass_kg) {
  return SimTK::Body::Rigid(SimTK::MassProperties(mass_kg, Vec3(0), Inertia(mass_kg)));
}

models::ContactPort<double> find_contact_port(const models::Corner<double>& corner) {
  const std::vector<double> x(corner.state_count(), 0.0);
  models::Instant<double> now;
  corner.apply_inputs(x.data(), now);
  return now.contact;
}

void SpeedHold::require(double time_s, double set_m_s, double is_m_s) const {
  if (std::abs(is_m_s - set_m_s) <= floor_m_s + share * std::abs(set_m_s)) return;
  const Unit& unit = unit_of_key(models::quantities::kSpeed.header());
  throw RunFailure(fmt::format(
      "at t = {:.1f} s {} the speed: set {:.1f} km/h, is {:.1f} km/h; what drives or brakes it (speeds, slope, wind, "
      "effects) is more than it can do",
      time_s, who, unit.from_si(set_m_s), unit.from_si(is_m_s)));
}

SimbodySystem::SimbodySystem(Lists lists, std::vector<models::Corner<double>*> corners, RigStart<double> start,
                             bool surface_recorded)
    : RigSystem(std::move(lists), surface_recorded),
      matter_(system_),
      forces_(system_),
      gravity_(forces_, matter_, Vec3(0, -kStandardGravity_m_s2, 0)),
      corners_(std::move(corners)),
      start_(std::move(start)) {
  matter_.setShowDefaultGeometry(false);
}

void SimbodySystem::add_forces(RigForces* forces) {
  rig_forces_ = forces;
  SimTK::Force::Custom(forces_, forces);
  state_ = system_.realizeTopology();
  system_.realizeModel(state_);
}

void SimbodySystem::begin_run(const sim::Segment& first, double time_s, const std::vector<double>& loads_N,
                              const std::vector<double>& pressures_Pa) {
  present_.take(first, time_s);
  present_.drive_on = true;
  SimTK::Vector& y = state_.updY();
  y = 0.0;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    rig_forces_->contacts()[i].set_inflation(start_.inflation(pressures_Pa[i]));
    corners_[i]->initialize(start_.tire_temperature_K, start_.history_under(loads_N[i]),
                            &y[static_cast<int>(slip_state(i)) + 1]);
  }
  state_.setTime(time_s);
}

void SimbodySystem::begin_segment(const sim::Segment& segment, double time_s, double*, double*) {
  present_.take(segment, time_s);
  state_.invalidateAllCacheAtOrAbove(SimTK::Stage::Time);
}

void SimbodySystem::set_pressure(double pressure_Pa, double* y) {
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    models::Inflation<double> inflation = rig_forces_->contacts()[i].inflation();
    corners_[i]->inflate(pressure_Pa, y + slip_state(i) + 1, inflation);
    rig_forces_->contacts()[i].set_inflation(inflation);
  }
  state_.invalidateAllCacheAtOrAbove(SimTK::Stage::Time);
}

void SimbodySystem::set_drive(bool on, double* y) {
  RigSystem::set_drive(on, y);
  state_.invalidateAllCacheAtOrAbove(SimTK::Stage::Time);
}

std::size_t SimbodySystem::tire_temperature_state() const {
  return slip_state(0) + 1 + corners_.front()->state_of(models::Node::kLiner);
}

void SimbodySystem::evaluate(double time_s, const double* y, double* rates, double* integrands) {
  set_state(time_s, y);
  if (rates != nullptr) {
    system_.realize(state_, SimTK::Stage::Acceleration);
    const SimTK::Vector& y_dot = state_.getYDot();
    std::copy(&y_dot[0], &y_dot[0] + y_dot.size(), rates);
  }
  if (integrands != nullptr) {
    system_.realize(state_, SimTK::Stage::Dynamics);
    fill_integrands(integrands);
  }
}

void SimbodySystem::require_possible(const double* y) const {
  for (std::size_t i = 0; i < corners_.size(); ++i) corners_[i]->require_possible(y + slip_state(i) + 1);
}

void SimbodySystem::calc_stored(double time_s, const double* y, double* stored_J) {
  realize_at(time_s, y, SimTK::Stage::Dynamics);
  double springs_J = 0.0;
  double slip_J = 0.0;
  double heat_J = 0.0;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    springs_J += rig_forces_->contacts()[i].calc_tire_spring_J(contact(i));
    slip_J += rig_forces_->calc_slip_spring_J(state_, i);
    heat_J += corners_[i]->calc_stored_heat_J(y + slip_state(i) + 1);
  }
  stored_J[index_of(RigStore::kKinetic)] = system_.calcKineticEnergy(state_);
  stored_J[index_of(RigStore::kGravity)] = gravity_.calcPotentialEnergyContribution(state_);
  stored_J[index_of(RigStore::kSprings)] = springs_J + rig_forces_->calc_own_springs_J(state_);
  stored_J[index_of(RigStore::kSlipSpring)] = slip_J;
  stored_J[index_of(RigStore::kHeat)] = heat_J;
}

void SimbodySystem::set_state(double time_s, const double* y) {
  const SimTK::Vector& present = state_.getY();
  if (state_.getTime() == time_s && std::equal(y, y + present.size(), &present[0])) return;
  state_.setTime(time_s);
  SimTK::Vector& all = state_.updY();
  std::copy(y, y + all.size(), &all[0]);
}

void SimbodySystem::realize_at(double time_s, const double* y, SimTK::Stage stage) {
  set_state(time_s, y);
  system_.realize(state_, stage);
}

void SimbodySystem::copy_state(double* y) const {
  const SimTK::Vector& all = state_.getY();
  std::copy(&all[0], &all[0] + all.size(), y);
}

double* SimbodySystem::put_further_states(std::size_t wheel, const double* y, double* values) const {
  const double* states = y + slip_state(wheel) + 1;
  return std::copy(states + 2, states + corners_[wheel]->state_count(), values);
}

void SimbodySystem::put_tolerances(std::size_t wheel, double slip_force_N, double state_share,
                                   std::vector<double>& tolerances) const {
  double* own = &tolerances[slip_state(wheel)];
  *own++ = slip_force_N / rig_forces_->contacts()[wheel].slip_spring_N_per_m();
  for (const models::CornerState& state : corners_[wheel]->states()) *own++ = state_share * state.scale_SI;
}

}  // namespace rollrig::rigs
