#pragma once
/// How well a run agrees with its simulation, whatever it is that the simulation does not know.

#include <array>

#include "diagnosis/checks/common_parts.h"

namespace rollrig::diagnosis {

/// Sizes of what a simulation may not know (effects, and numbers that are not known well), in the tolerances of
/// plausibility.h, and how likely each is before a set has been looked at. Assumed: the effects of the catalog at usual
/// sizes make 0.03 to 0.5.
constexpr std::array<double, 7> kUnknownSizes{0.03, 0.06, 0.12, 0.25, 0.5, 1.0, 2.0};
constexpr std::array<double, 7> kSizeWeights{0.2, 0.2, 0.2, 0.2, 0.13, 0.06, 0.01};

/// Logarithm of the likelihood of what a run measured, above that of residuals which are noise and no more.
///
/// The square root of what this gives is taken: samples that all lack the same part of the physics are less independent
/// than their noise.
/// Equation  y - h = B (m + a) + b + n;  a ~ N(0, s^2),  b ~ N(0, offset_sd^2),  n ~ k N(0, C),  summed over k
/// Symbols   y measured, h simulated; s size, half of it where common parts m are given; columns of B: the tolerance of
///           the channel at rest and its share of h, each as it is, fading over 10 min, and in proportion to speed and
///           load; of temperatures and pressures a lag; of a force what its kind lists, whose size does not depend on
///           s. C drift and noise of the sensor, k 1 to 50 for what B leaves, with a probability in proportion to 1/k^2
/// Validity  The scatter of numbers in another unit is not counted, since the noise that a set states may be a guess.
///           Samples are averaged over 20 s, but on the road, where every change of speed tells
/// Source    Assumed: B, the values of k and their probabilities
/// Checked   tests/diagnosis/planted_mistakes_test.cpp
double calc_log_likelihood(const RunProducts& products, const CommonParts& common, double size);

/// What the given columns of a run tell by themselves: a soaked tire is as warm as the air, one that has run is no
/// colder, and a run at the heights of the others is likelier than one far from them. `run` is run r of the set, or the
/// same with a mistake undone.
///
/// Equation  -3 ln(1 + (x/s)^2/5), Student's t with five degrees of freedom
/// Symbols   x difference, s 3 K, or 100 m and no less than the scatter of the others
/// Source    Assumed: all limits
double calc_given_log_likelihood(const measurements::MeasurementSet& set, std::size_t r,
                                 const measurements::MeasuredRun& run);

}  // namespace rollrig::diagnosis
