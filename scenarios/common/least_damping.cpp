#include "scenarios/common/least_damping.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/error.h"

namespace rollrig::scenarios {

void require_damping(const DampedMass& damped) {
  constexpr double kLeastRatio = 0.05;
  const double critical = 2.0 * std::sqrt(damped.stiffness_N_per_m * damped.mass_kg);
  const double ratio = damped.damping_N_s_per_m / critical;
  if (ratio >= kLeastRatio) return;
  throw InputError(
      {fmt::format("{} has {:.2g} of critical damping: {} through the whole test", damped.damper, ratio, damped.bounce),
       damped.path, 0, "damping_N_s_per_m", fmt::format("{:g}", damped.damping_N_s_per_m),
       fmt::format("at least {:.0f} N s/m, {} of critical damping, or --fidelity quasi_static",
                   std::ceil(kLeastRatio * critical), kLeastRatio),
       ""});
}

}  // namespace rollrig::scenarios
