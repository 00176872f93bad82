#include "rigs/multibody_rig.h"

#include <utility>

#include "rigs/simbody_system.h"

namespace rollrig::rigs {

MultibodyRig::MultibodyRig(std::unique_ptr<sim::OdeSystem<double>> system) : system_(std::move(system)) {}
MultibodyRig::~MultibodyRig() = default;

std::size_t MultibodyRig::state_count() const { return system_->state_count(); }
std::vector<double> MultibodyRig::state_tolerances() const { return system_->state_tolerances(); }
const std::vector<sim::Integral>& MultibodyRig::integrals() const { return system_->integrals(); }
const std::vector<sim::Store>& MultibodyRig::stores() const { return system_->stores(); }
const std::vector<sim::Channel>& MultibodyRig::channels() const { return system_->channels(); }
std::vector<sim::PoseCoordinate> MultibodyRig::poses() const { return system_->poses(); }
void MultibodyRig::initialize(const sim::Segment& first, double time_s, double* state) {
  guarded([&] { system_->initialize(first, time_s, state); });
}
void MultibodyRig::begin_phase(const sim::Phase& phase, double time_s, double* state) {
  guarded([&] { system_->begin_phase(phase, time_s, state); });
}
void MultibodyRig::begin_segment(const sim::Segment& segment, double time_s, double* state, double* integrals) {
  guarded([&] { system_->begin_segment(segment, time_s, state, integrals); });
}
void MultibodyRig::evaluate(double time_s, const double* state, double* rates, double* integrands) {
  guarded([&] { system_->evaluate(time_s, state, rates, integrands); });
}
void MultibodyRig::require_possible(const double* state) const { system_->require_possible(state); }
double MultibodyRig::watch(const std::string& name, double time_s, const double* state) {
  return guarded([&] { return system_->watch(name, time_s, state); });
}
void MultibodyRig::observe(double time_s, const double* state, double* values) {
  guarded([&] { system_->observe(time_s, state, values); });
}
void MultibodyRig::calc_stored(double time_s, const double* state, double* stored_J) {
  guarded([&] { system_->calc_stored(time_s, state, stored_J); });
}

}  // namespace rollrig::rigs
