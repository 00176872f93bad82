#pragma once
/// Sets simulated with a known difference from the baseline, for tests of the diagnosis.

#include <vector>

#include "diagnosis/race.h"

namespace rollrig::tests {

/// Drum runs in two sessions, each skim, 80 km/h, a faster speed, skim; the tire a50 on the asset rig, whose every
/// effect of `effects` acts. Free of noise. Up to six runs, from 2,000 to 3,500 s at 1 Hz.
scenarios::MeasurementSet make_gap_set(const std::vector<models::ActiveEffect>& effects, std::size_t runs);

/// A set made ready, and the baseline fitted to it.
struct FittedBaseline {
  explicit FittedBaseline(const scenarios::MeasurementSet& measured);

  diagnosis::PreparedSet set;
  std::vector<identification::FreeParameter> base;
  diagnosis::Remainder remainder;
  diagnosis::Contender null;
};

}  // namespace rollrig::tests
