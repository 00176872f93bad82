#pragma once
/// What the integrator counted, for the manifest.

#include "sim/core/json.h"
#include "sim/cvodes_integrator.h"

namespace rollrig::scenarios {

inline Json to_json(const sim::CvodesStatistics& counted) {
  return {{"steps", counted.steps},
          {"rate_evaluations", counted.rate_evaluations},
          {"jacobian_evaluations", counted.jacobian_evaluations},
          {"error_test_failures", counted.error_test_failures}};
}

}  // namespace rollrig::scenarios
