#include "estimation/drum_deceleration/rig_resonance.h"

#include <Eigen/Dense>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rollrig::estimation {
namespace {

constexpr double kBin_m_s = 1.0;
constexpr double kNearest_m_s = 1.5;
constexpr double kFarthest_m_s = 5.0;
constexpr double kLeastExcess = 0.01;
constexpr double kLevel = 0.001;
constexpr double kWidest_m_s = 4.0;
constexpr std::size_t kFewestRowsInBin = 5;

double bin_middle_m_s(std::size_t bin) { return (static_cast<double>(bin) + 0.5) * kBin_m_s; }

/// A deceleration with its variance; NaN where there are too few rows.
struct BinValue {
  double value = std::numeric_limits<double>::quiet_NaN();
  double variance = 0.0;
  bool is_there() const { return !std::isnan(value); }
};

/// Slope of a line through the rows of one bin.
BinValue fit_bin(const std::vector<double>& time_s, const std::vector<double>& speed_m_s) {
  if (time_s.size() < kFewestRowsInBin) return {};
  const auto n = static_cast<Eigen::Index>(time_s.size());
  const Eigen::ArrayXd t = Eigen::Map<const Eigen::ArrayXd>(time_s.data(), n);
  const Eigen::ArrayXd v = Eigen::Map<const Eigen::ArrayXd>(speed_m_s.data(), n);
  const Eigen::ArrayXd dt = t - t.mean();
  const double spread = dt.square().sum();
  const double slope = (dt * (v - v.mean())).sum() / spread;
  const double squares = (v - v.mean() - slope * dt).square().sum();
  return {-slope, squares / static_cast<double>(n - 2) / spread};
}

/// Deceleration of a run in each bin.
std::vector<BinValue> calc_bin_decelerations(const Coast& coast, std::size_t bins) {
  constexpr double kWrongRow = 0.05;  // of the smooth speed
  std::vector<std::vector<double>> time_s(bins), speed_m_s(bins);
  for (std::size_t i = 0; i < coast.time_s.size(); ++i) {
    const auto bin = static_cast<std::size_t>(coast.smooth_m_s[i] / kBin_m_s);
    if (bin >= bins || std::abs(coast.speed_m_s[i] / coast.smooth_m_s[i] - 1.0) > kWrongRow) continue;
    time_s[bin].push_back(coast.time_s[i]);
    speed_m_s[bin].push_back(coast.speed_m_s[i]);
  }
  std::vector<BinValue> values;
  for (std::size_t bin = 0; bin < bins; ++bin) values.push_back(fit_bin(time_s[bin], speed_m_s[bin]));
  return values;
}

/// Deceleration of a bin over what its neighbors say, less one.
BinValue calc_excess(const std::vector<BinValue>& decelerations, std::size_t bin) {
  constexpr int kFewestSide = 2;
  constexpr int kFewestNeighbors = 5;
  if (!decelerations[bin].is_there()) return {};
  std::vector<double> offset, value, variance;
  int below = 0, above = 0;
  for (std::size_t other = 0; other < decelerations.size(); ++other) {
    const double x = bin_middle_m_s(other) - bin_middle_m_s(bin);
    if (std::abs(x) < kNearest_m_s || std::abs(x) > kFarthest_m_s || !decelerations[other].is_there()) continue;
    offset.push_back(x);
    value.push_back(decelerations[other].value);
    variance.push_back(decelerations[other].variance);
    ++(x < 0.0 ? below : above);
  }
  if (below < kFewestSide || above < kFewestSide || below + above < kFewestNeighbors) return {};
  const auto n = static_cast<Eigen::Index>(offset.size());
  Eigen::MatrixXd terms(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = offset[static_cast<std::size_t>(i)];
    terms.row(i) << 1.0, x, x * x;
  }
  const Eigen::RowVectorXd weights = terms.completeOrthogonalDecomposition().pseudoInverse().row(0);
  const double expected = weights * Eigen::Map<const Eigen::VectorXd>(value.data(), n);
  if (expected <= 0.0) return {};
  const double of_expected = weights.cwiseAbs2() * Eigen::Map<const Eigen::VectorXd>(variance.data(), n);
  return {decelerations[bin].value / expected - 1.0,
          (decelerations[bin].variance + of_expected) / (expected * expected)};
}

/// Mean excess of a bin over the runs, where it stands out.
std::optional<Resonance> judge_bin(const std::vector<std::vector<BinValue>>& runs, std::size_t bin) {
  constexpr std::size_t kFewestForScatter = 3;
  double mean = 0.0, variance = 0.0, squares = 0.0, least = std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(runs.size());
  for (const std::vector<BinValue>& run : runs) {
    const BinValue excess = calc_excess(run, bin);
    if (!excess.is_there()) return std::nullopt;
    mean += excess.value / n;
    variance += excess.variance / (n * n);
    squares += excess.value * excess.value;
    least = std::min(least, excess.value);
  }
  const bool scatter_known = runs.size() >= kFewestForScatter;
  if (scatter_known) variance = std::max(variance, (squares / n - mean * mean) / (n - 1.0));
  const boost::math::normal_distribution<double> normal;
  const double level = kLevel / static_cast<double>(runs.front().size());
  const double limit = boost::math::quantile(boost::math::complement(normal, level / 2.0));
  if (mean < kLeastExcess || mean < limit * std::sqrt(variance) || (!scatter_known && least < 0.5 * mean))
    return std::nullopt;
  const double middle = bin_middle_m_s(bin);
  return Resonance{{middle - 1.5 * kBin_m_s, middle + 1.5 * kBin_m_s}, middle, mean, std::sqrt(variance)};
}

}  // namespace

std::vector<Resonance> find_resonances(const std::vector<Coast>& coasts) {
  if (coasts.empty()) return {};
  double top_m_s = 0.0;
  for (const Coast& coast : coasts) top_m_s = std::max(top_m_s, coast.smooth_m_s.front());
  const auto bins = static_cast<std::size_t>(top_m_s / kBin_m_s) + 1;
  std::vector<std::vector<BinValue>> runs;
  for (const Coast& coast : coasts) runs.push_back(calc_bin_decelerations(coast, bins));
  std::vector<Resonance> found;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const std::optional<Resonance> at = judge_bin(runs, bin);
    if (!at.has_value()) continue;
    if (found.empty() || at->range.from_m_s > found.back().range.to_m_s) {
      found.push_back(*at);
      continue;
    }
    found.back().range.to_m_s = at->range.to_m_s;
    if (at->excess > found.back().excess) {
      found.back().peak_m_s = at->peak_m_s;
      found.back().excess = at->excess;
      found.back().sd = at->sd;
    }
  }
  const auto is_too_wide = [](const Resonance& r) {
    return r.range.to_m_s - r.range.from_m_s > kWidest_m_s + 2.0 * kBin_m_s;
  };
  found.erase(std::remove_if(found.begin(), found.end(), is_too_wide), found.end());
  return found;
}

}  // namespace rollrig::estimation
