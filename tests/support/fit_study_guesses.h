#pragma once
/// Tire files with guesses instead of true numbers, for tests of how honest a fit is.

#include "measurements/measurement_set.h"

namespace rollrig::tests {

/// The set with a tire and a rig whose numbers are guesses: each number that `fit tire` holds by a prior is drawn from
/// this prior around the truth, jointly where the tire's file gives correlations, and the numbers that it asks for are
/// off by 15 %. Draws that a tire file may not have are drawn again. Nothing that was measured changes.
measurements::MeasurementSet guess_numbers(const measurements::MeasurementSet& truth, std::uint64_t seed);

/// The tire without a word on how well its numbers are known, with conductances of its own on the set's rig.
void forget_uncertainties(measurements::MeasurementSet& set);

/// Every so many samples, for fits that cost less.
void thin(measurements::MeasurementSet& set, std::size_t every);

}  // namespace rollrig::tests
