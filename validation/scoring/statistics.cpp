#include "validation/scoring/statistics.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "sim/core/random.h"

namespace rollrig::validation {

Interval calc_wilson_95(std::size_t k, std::size_t n) {
  if (n == 0) return {};
  static const double z = boost::math::quantile(boost::math::normal(), 0.975);
  const auto count = static_cast<double>(n);
  const double p = static_cast<double>(k) / count;
  const double middle = p + z * z / (2.0 * count);
  const double half = z * std::sqrt(p * (1.0 - p) / count + z * z / (4.0 * count * count));
  const double scale = 1.0 + z * z / count;
  return {k == 0 ? 0.0 : (middle - half) / scale, k == n ? 1.0 : (middle + half) / scale};
}

void ReliabilityBin::add(const Stated& one) {
  ++cases;
  right += one.right ? 1 : 0;
  mean_probability += (one.probability - mean_probability) / static_cast<double>(cases);
}

Reliability find_reliability(const std::vector<Stated>& stated) {
  Reliability bins{};
  for (const Stated& one : stated) {
    const auto at = static_cast<std::size_t>(std::max(0.0, one.probability) * kReliabilityBins);
    bins[std::min(at, kReliabilityBins - 1)].add(one);
  }
  return bins;
}

double calc_ece(const Reliability& reliability) {
  double sum = 0.0;
  double cases = 0.0;
  for (const ReliabilityBin& bin : reliability) {
    const auto in_bin = static_cast<double>(bin.cases);
    sum += std::abs(static_cast<double>(bin.right) - in_bin * bin.mean_probability);
    cases += in_bin;
  }
  return cases > 0.0 ? sum / cases : 0.0;
}

double calc_ece_noise_floor(const std::vector<Stated>& stated) {
  constexpr int kDraws = 400;
  RandomStream draws(1, "ece noise floor");
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Stated> drawn = stated;
    for (Stated& one : drawn) one.right = draws.uniform() < one.probability;
    sum += calc_ece(find_reliability(drawn));
  }
  return sum / kDraws;
}

double calc_brier(const std::vector<Stated>& stated) {
  double sum = 0.0;
  for (const Stated& one : stated) {
    const double miss = one.probability - (one.right ? 1.0 : 0.0);
    sum += miss * miss;
  }
  return stated.empty() ? 0.0 : sum / static_cast<double>(stated.size());
}

double calc_quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace rollrig::validation
