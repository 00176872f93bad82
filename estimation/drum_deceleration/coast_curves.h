#pragma once
/// Decelerations of coasts in bins of speed, to compare runs with each other.

#include <limits>
#include <vector>

#include "estimation/drum_deceleration/drum_coastdown.h"

namespace rollrig::estimation {

constexpr double kCurveBin_m_s = 2.0;  // Assumed

/// Deceleration of the drum of a run, bin by bin from standstill up; NaN where there are too few rows.
struct CoastCurve {
  std::size_t run = 0;  // in the set
  std::vector<double> value_m_s2;

  double at(std::size_t bin) const {
    return bin < value_m_s2.size() ? value_m_s2[bin] : std::numeric_limits<double>::quiet_NaN();
  }
};

inline double curve_speed_m_s(std::size_t bin) { return (static_cast<double>(bin) + 0.5) * kCurveBin_m_s; }

/// Slopes of lines through the rows of each bin; rows in a range that is left out do not count.
std::vector<CoastCurve> make_coast_curves(const std::vector<CoastAnalysis>& analyses);

/// Median of curves, bin by bin.
CoastCurve calc_median_curve(const std::vector<const CoastCurve*>& curves);

/// Mean of ln(a/b) over the bins that both have, with their number.
struct CurveRatio {
  double log = 0.0;
  int bins = 0;
};
CurveRatio compare_curves(const CoastCurve& a, const CoastCurve& b);

}  // namespace rollrig::estimation
