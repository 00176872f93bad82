#pragma once
/// How well a run agrees with its simulation, allowing for parts that the simulation does not know.

#include <array>

#include "diagnosis/checks/common_parts.h"

namespace rollrig::diagnosis {

/// Sizes of the parts that a simulation may not know (effects and uncertain numbers), in the tolerances of
/// plausibility.h, and their prior probabilities. Assumed: effects of the catalog at usual sizes give 0.03 to 0.5.
constexpr std::array<double, 7> kUnknownSizes{0.03, 0.06, 0.12, 0.25, 0.5, 1.0, 2.0};
constexpr std::array<double, 7> kSizeWeights{0.2, 0.2, 0.2, 0.2, 0.13, 0.06, 0.01};

/// Logarithm of the likelihood of what a run measured, minus that of residuals which are noise alone.
///
/// The likelihood of a channel is raised to the power 0.5: samples that all lack the same part of the physics are less
/// independent than their noise.
/// Equation  y - h = B (m + a) + b + n;  a ~ N(0, s^2),  b ~ N(0, offset_sd^2),  n ~ k N(0, C),  summed over k
/// Symbols   y measured, h simulated; m common parts of all runs; a amplitudes of the other parts; s size, half of it
///           if common parts are given; b sensor offset; n noise; C covariance of drift and noise of the sensor; k 1 to
///           50, for what B leaves, with a probability in proportion to 1/k^2.
///           Columns of B (mistake_unknowns.h): the tolerance of the channel at rest, also fading over 10 min or in
///           proportion to speed; its share of the change of h from rest, also fading or in proportion to speed or
///           load; of temperatures and pressures, a lag. If the kind of set lists unknown forces, a force has these
///           instead of the share, with sizes that do not depend on s
/// Validity  the scatter of numbers in another unit is not counted here, since the noise that a set states may be a
///           guess. Samples are averaged over 20 s; not on the road, where every change of speed counts
/// Source    Assumed: B, the values of k and their probabilities
/// Checked   tests/diagnosis/planted_mistakes_test.cpp
double calc_log_likelihood(const RunProducts& products, const CommonParts& common, double size);

/// Logarithm of the likelihood of the given columns of a run, without any simulation: a soaked tire is as warm as the
/// air, one that has run is not colder, and a run at the heights of the others is likelier than one far from them.
/// `run` is run r of the set, or the same with a mistake undone.
///
/// Equation  sum of -3 ln(1 + (x/s)^2/5), Student's t with five degrees of freedom, over temperature and height
/// Symbols   x difference; s 3 K for the temperature; for the height, the scatter of the others, at least 100 m
/// Source    Assumed: all limits
double calc_given_log_likelihood(const measurements::MeasurementSet& set, std::size_t r,
                                 const measurements::MeasuredRun& run);

}  // namespace rollrig::diagnosis
