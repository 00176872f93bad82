#pragma once
/// Where in the data measurement and recalibrated baseline differ.

#include <string>
#include <vector>

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// A stretch in which a gap may be located.
struct LocationStretch {
  std::string channel;
  std::string run;
  std::string phase;
  double start_s = 0.0;
  double end_s = 0.0;
  double floor = 0.0;  // noise floor in the unit in which a location's size is given
  std::string unit;
};

/// All stretches that find_locations() tests.
std::vector<LocationStretch> list_location_stretches(const PreparedSet& set);

/// Stretches of a series in which the measurement lies above or below the recalibrated baseline: each phase of each
/// run, those longer than 900 s cut after 10 min, in each channel. Largest share first.
///
/// Significant stretches are put in one by one, the clearest first, each with its own constant, until none that is
/// left would be significant beside them: one gap that shifts a session's offset is not listed again, with the other
/// sign, wherever else that offset counts. What is not explained yet counts as noise: while much of a large gap is
/// left, base parameters stay near their priors, and only what is clear against the rest is put in.
///
/// Equation  y = baseline + sum_j size_j t_j, t_j = 1 in stretch j: generalized least squares under noise, discrepancy,
///           and the priors of base parameters and offsets, noise and discrepancy times max(1, chi^2/N);
///           z = size over its standard deviation. Listed where |z| > q(1 - 0.01/(2 n)), q the normal quantile
///           (family-wise 1 %); share = max(0, sum (d/f)^2 - (s/f)^2) in the stretch over that of all listed, and what
///           the others have together.
///           If chi^2/N > 1.1 (Assumed), constants in stretches do not describe the gap, and base parameters that fit
///           some stretches enlarge the sizes of others: a size above 2 |m| (Assumed), or of the other sign, becomes m
///           or 0, z in proportion
/// Symbols   chi^2/N mean square of the whitened residuals beside the stretches; n stretches tested; d measured -
///           simulated - offset of a block, with base parameters and offsets as they fit best beside the stretches;
///           s what noise would give it; f the series' noise floor; m mean difference of the stretch from the
///           recalibrated baseline; size in N at the drum's surface, degC or kPa
/// Validity  gaps that hold their sign for a good part of a stretch; the null's own unknowns to first order. What base
///           parameters and offsets can take within their uncertainty does not count as a gap
/// Source    Bonferroni's inequality; forward selection; chi^2/N: R. T. Birge, Phys. Rev. 40 (1932) 207
/// Checked   tests/diagnosis/locations_test.cpp
std::vector<Location> find_locations(const Study& study);

}  // namespace rollrig::diagnosis
