#pragma once
/// What the multibody rigs share around Simbody.

#include <Simbody.h>

#include <string>
#include <vector>

#include "models/corner.h"
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

/// Port "contact and inertia" of a corner. The bodies are built with it, so on a multibody rig it may depend
/// on parameters only, not on time or state.
inline models::ContactPort<double> find_contact_port(const models::Corner<double>& corner) {
  const std::vector<double> x(corner.state_count(), 0.0);
  models::Instant<double> now;
  corner.apply_inputs(x.data(), now);
  return now.contact;
}

}  // namespace rollrig::rigs
