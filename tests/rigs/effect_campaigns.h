#pragma once
/// Campaigns on which every effect must keep its contract: one for each kind of rig that has both
/// fidelities. A rig comes into the contract by one more entry in campaigns().

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "models/effect.h"
#include "sim/recording.h"
#include "tests/support/machines.h"

namespace rollrig::tests {

using Effects = std::vector<models::ActiveEffect>;

/// Runs on one kind of rig that show every effect that can be seen there.
struct EffectCampaign {
  tests::Machine kind;
  std::string force_channel;                // the fidelities are compared in it, and in temperature
  std::vector<std::string> settled_phases;  // at whose end force and temperature hold still
  double audit_limit;
  std::function<sim::Recording<double>(const Effects&, const std::string& tire_model)> run_quasi_static;
  std::function<sim::Recording<double>(const Effects&, const std::string& tire_model)> run_multibody;
  /// With derivatives by the first parameter of the only effect, in place 0.
  std::function<sim::Recording<Jet>(const Effects&, const std::string& tire_model)> run_with_derivatives;
};

/// Measured channels of a kind (formats.md).
std::set<std::string> measured_on(tests::Machine kind);

/// One campaign for each kind of rig that has a fast and a multibody fidelity.
const std::vector<EffectCampaign>& campaigns();

}  // namespace rollrig::tests
