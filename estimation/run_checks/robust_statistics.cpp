#include "estimation/run_checks/robust_statistics.h"

#include <algorithm>
#include <cmath>

namespace rollrig::estimation {

double calc_median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double calc_mad_sd(const std::vector<double>& values) {
  constexpr double kNormal = 1.4826;  // standard deviation over this median, of the normal distribution
  const double median = calc_median(values);
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - median));
  return kNormal * calc_median(distances);
}

}  // namespace rollrig::estimation
