#pragma once
/// Ranges of speed where the rig itself resonates.

#include <vector>

#include "estimation/drum_deceleration/deceleration_fit.h"

namespace rollrig::estimation {

/// A resonance found in runs of one kind.
struct Resonance {
  SpeedRange range;       // to be left out
  double peak_m_s = 0.0;  // where the excess is largest
  double excess = 0.0;    // there, of the deceleration [1], mean over the runs
  double sd = 0.0;        // of that mean, from the scatter of rows or of runs
};

/// Looks for local excess of deceleration that runs of one kind show in common.
/// Equation  deceleration in bins of 1 m/s of each run, each over the quadratic in speed through its neighbors at
///           1.5 to 5 m/s; a bin stands out when the mean over the runs is above 1 % and beyond the normal
///           interval at 0.1 % shared out among the bins, by the scatter of rows or of runs, whichever is larger; of
///           one or two runs each must show half of the mean. The range goes one bin further to both sides.
/// Validity  a bump narrower than 4 m/s, else it is the law's own shape and is kept
/// Source    Assumed: bin width, 1 %, 0.1 %
/// Checked   tests/estimation/rig_resonance_test.cpp
std::vector<Resonance> find_resonances(const std::vector<Coast>& coasts);

}  // namespace rollrig::estimation
