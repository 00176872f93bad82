#pragma once
/// From a recording of pulses to the coast: where it starts, which pulses were missed.

#include "estimation/drum_deceleration/coast_set.h"

namespace rollrig::estimation {

/// Rows of the coast, wrong pulses taken out.
struct Coast {
  std::vector<double> time_s;      // at which the speed holds: the middle of the pulse's period where that is known
  std::vector<double> speed_m_s;   // as measured
  std::vector<double> smooth_m_s;  // running median, by which rows are chosen: choosing by the noise would bias
  double start_s = 0.0;
  std::size_t missed = 0;   // speed a half or a third
  std::size_t doubled = 0;  // speed twice
  std::size_t other = 0;    // off by more than a quarter
  std::size_t stopped = 0;  // at the end, constant after the body stopped
  double rise_m_s = 0.0;    // largest rise of the smooth speed after the start; 0 in a true coast
};

/// Finds the coast: it begins where the running median leaves the top (98 % of the highest) for the last time.
/// A pulse is missed when the speed of its row is near a half or a third of the running median of its
/// neighbors, double when near twice. A speed that repeats to the end of the record is of a body at rest.
/// Symbols   pulse_length_m way between two pulses: a speed from a period holds half a period before its row
/// Source    Assumed: all limits.
/// Errors    InputError: fewer than twenty rows of coast
/// Checked   tests/estimation/coast_cleaning_test.cpp
Coast find_coast(const CoastSeries& series, const std::optional<double>& pulse_length_m, const CoastRun& run);

}  // namespace rollrig::estimation
