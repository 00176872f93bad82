#pragma once
/// Where the clocks of two logs stand to each other: the maximum of a likelihood, and how wide it is.

#include <vector>

#include "measurements/logs/tie.h"

namespace rollrig::measurements {

struct ClockPrior {
  double center_s = 0.0;      // of the search over the shift
  double half_width_s = 0.0;  // of the search
  double shift_sd_s = 0.0;    // 0: any shift of the search alike
  double rate_sd = 0.0;       // 0: the rate is held at 0
};

struct ClockPeak {
  Clock clock;
  double shift_sd_s = 0.0;
  double rate_sd = 0.0;
  double gain = 0.0;         // log likelihood beyond that of no connection
  double gain_next = 0.0;    // the highest beyond six standard deviations of the peak
  std::vector<TieFit> fits;  // of each tie
};

/// The likeliest clock.
///
/// Equation  L(shift, rate) = sum over ties of n/2 ln(chi2_alone/chi2) - rate^2/(2 sd_rate^2)
///                            - (shift - center)^2/(2 sd_shift^2):
///           rows that only one log covers count as not connected. A grid, then Gauss-Newton; the noise of each tie
///           (white and drift) from its rest, by maximum likelihood; standard deviations from the curvature
/// Symbols   chi2 of the tie's rest, whitened; chi2_alone without the functions of the torque log's time
/// Checked   tests/measurements/logs/clock_test.cpp
ClockPeak search_clock(std::vector<Tie> ties, const ClockPrior& prior);

}  // namespace rollrig::measurements
