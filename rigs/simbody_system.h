#pragma once
/// What the multibody rigs share around Simbody.

#include <Simbody.h>

#include <string>
#include <vector>

#include "models/corner.h"
#include "sim/core/error.h"
#include "sim/ode_system.h"

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

/// Port "contact and inertia" of a corner. The bodies are built with it, so on a multibody rig it may depend
/// on parameters only, not on time or state.
inline models::ContactPort<double> find_contact_port(const models::Corner<double>& corner) {
  const std::vector<double> x(corner.state_count(), 0.0);
  models::Instant<double> now;
  corner.apply_inputs(x.data(), now);
  return now.contact;
}

/// Bodies and forces in Simbody under gravity, y up. The state vector is Simbody's: q, u, z of all bodies and forces.
/// A rig's constructor adds them, then calls realize_topology().
class SimbodySystem : public sim::OdeSystem<double> {
 public:
  std::size_t state_count() const override { return static_cast<std::size_t>(state_.getNY()); }
  const std::vector<sim::Integral>& integrals() const override { return integrals_; }
  const std::vector<sim::Store>& stores() const override { return stores_; }
  const std::vector<sim::Channel>& channels() const override { return channels_; }
  void evaluate(double time_s, const double* y, double* rates, double* integrands) override;

 protected:
  SimbodySystem(std::vector<sim::Integral> integrals, std::vector<sim::Store> stores,
                std::vector<sim::Channel> channels);
  /// At a state realized to Stage::Dynamics.
  virtual void fill_integrands(double* integrands) const = 0;

  void realize_topology();
  void take_segment(const sim::Segment& segment, double time_s);
  double time_in_segment_s(double time_s) const { return time_s - segment_start_s_; }
  /// What is realized stays where neither time nor state has changed.
  void set_state(double time_s, const double* y);
  void copy_state(double* y) const;

  sim::Segment segment_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::Force::UniformGravity gravity_;
  SimTK::State state_;

 private:
  std::vector<sim::Integral> integrals_;
  std::vector<sim::Store> stores_;
  std::vector<sim::Channel> channels_;
  double segment_start_s_ = 0.0;
};

}  // namespace rollrig::rigs
