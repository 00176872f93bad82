#include "estimation/drum_deceleration/coast_curves.h"

#include <algorithm>
#include <cmath>

#include "estimation/run_checks/robust_statistics.h"

namespace rollrig::estimation {
namespace {

/// Sums for a line of speed over time.
struct SlopeSums {
  double n = 0.0, t = 0.0, v = 0.0, tt = 0.0, tv = 0.0, high = 0.0, low = 1e9;

  void add(double time_s, double speed_m_s) {
    n += 1.0;
    t += time_s;
    v += speed_m_s;
    tt += time_s * time_s;
    tv += time_s * speed_m_s;
    high = std::max(high, speed_m_s);
    low = std::min(low, speed_m_s);
  }
  /// NaN where the rows do not fill the bin.
  double deceleration_m_s2() const {
    constexpr double kFewest = 6.0;
    constexpr double kLeastShare = 0.6;  // of the bin
    if (n < kFewest || high - low < kLeastShare * kCurveBin_m_s) return std::numeric_limits<double>::quiet_NaN();
    const double slope = (tv - t * v / n) / (tt - t * t / n);
    return slope < 0.0 ? -slope : std::numeric_limits<double>::quiet_NaN();
  }
};

CoastCurve make_coast_curve(const CoastAnalysis& analysis) {
  constexpr double kWrongPulse = 0.05;  // of the smooth speed
  const Coast& coast = analysis.coast;
  std::vector<SlopeSums> sums;
  for (std::size_t i = 0; i < coast.time_s.size(); ++i) {
    const double smooth_m_s = coast.smooth_m_s[i];
    if (std::abs(coast.speed_m_s[i] / smooth_m_s - 1.0) > kWrongPulse) continue;
    if (is_left_out(analysis.left_out, smooth_m_s)) continue;
    const auto bin = static_cast<std::size_t>(smooth_m_s / kCurveBin_m_s);
    if (bin >= sums.size()) sums.resize(bin + 1);
    sums[bin].add(coast.time_s[i] - coast.start_s, coast.speed_m_s[i]);
  }
  CoastCurve curve;
  curve.run = analysis.run;
  for (const SlopeSums& bin : sums) curve.value_m_s2.push_back(bin.deceleration_m_s2());
  return curve;
}

}  // namespace

std::vector<CoastCurve> make_coast_curves(const std::vector<CoastAnalysis>& analyses) {
  std::vector<CoastCurve> curves;
  for (const CoastAnalysis& analysis : analyses) {
    if (analysis.body == CoastBody::kDrum) curves.push_back(make_coast_curve(analysis));
  }
  return curves;
}

CoastCurve calc_median_curve(const std::vector<const CoastCurve*>& curves) {
  std::size_t bins = 0;
  for (const CoastCurve* curve : curves) bins = std::max(bins, curve->value_m_s2.size());
  CoastCurve median;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    std::vector<double> values;
    for (const CoastCurve* curve : curves) {
      if (!std::isnan(curve->at(bin))) values.push_back(curve->at(bin));
    }
    median.value_m_s2.push_back(values.empty() ? std::numeric_limits<double>::quiet_NaN() : calc_median(values));
  }
  return median;
}

CurveRatio compare_curves(const CoastCurve& a, const CoastCurve& b) {
  CurveRatio ratio;
  for (std::size_t bin = 0; bin < a.value_m_s2.size(); ++bin) {
    if (std::isnan(a.at(bin)) || std::isnan(b.at(bin))) continue;
    ratio.log += std::log(a.at(bin) / b.at(bin));
    ++ratio.bins;
  }
  if (ratio.bins > 0) ratio.log /= ratio.bins;
  return ratio;
}

}  // namespace rollrig::estimation
