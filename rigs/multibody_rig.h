#pragma once
/// A rig as a multibody system in Simbody, whose headers it keeps from those who only run it.

#include <memory>
#include <string>
#include <vector>

#include "sim/ode_system.h"

namespace rollrig::rigs {

/// Hands everything on to the system inside.
/// Errors  RunFailure: what Simbody refuses
class MultibodyRig : public sim::OdeSystem<double> {
 public:
  ~MultibodyRig() override;
  MultibodyRig(const MultibodyRig&) = delete;
  MultibodyRig& operator=(const MultibodyRig&) = delete;

  std::size_t state_count() const override;
  std::vector<double> state_tolerances() const override;
  const std::vector<sim::Integral>& integrals() const override;
  const std::vector<sim::Store>& stores() const override;
  const std::vector<sim::Channel>& channels() const override;
  std::vector<sim::PoseCoordinate> poses() const override;

  void initialize(const sim::Segment& first, double time_s, double* state) override;
  void begin_phase(const sim::Phase& phase, double time_s, double* state) override;
  void begin_segment(const sim::Segment& segment, double time_s, double* state, double* integrals) override;
  void evaluate(double time_s, const double* state, double* rates, double* integrands) override;
  void require_possible(const double* state) const override;
  double watch(const std::string& name, double time_s, const double* state) override;
  void observe(double time_s, const double* state, double* values) override;
  void calc_stored(double time_s, const double* state, double* stored_J) override;

 protected:
  explicit MultibodyRig(std::unique_ptr<sim::OdeSystem<double>> system);
  sim::OdeSystem<double>& system() { return *system_; }

 private:
  std::unique_ptr<sim::OdeSystem<double>> system_;
};

}  // namespace rollrig::rigs
