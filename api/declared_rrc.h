#pragma once
/// The RRc that an option of the command line gives.

#include <fmt/format.h>

#include "models/tire/label_class.h"
#include "sim/core/error.h"

namespace rollrig {

/// In N/N. Throws InputError for a coefficient that no tire has.
inline double read_declared_rrc(double rrc_N_per_kN) {
  const double rrc = 1e-3 * rrc_N_per_kN;
  if (const auto mistake = models::find_rrc_mistake(rrc)) {
    throw InputError(
        {mistake->what, "command line", 0, "--rrc", fmt::format("{:g}", rrc_N_per_kN), mistake->allowed, ""});
  }
  return rrc;
}

}  // namespace rollrig
