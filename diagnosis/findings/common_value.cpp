#include "diagnosis/findings/common_value.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace rollrig::diagnosis {

CommonValue find_common_value(const std::vector<Estimate>& estimates) {
  double sum = 0.0;
  double weight = 0.0;
  for (const Estimate& estimate : estimates) {
    sum += estimate.value / estimate.variance;
    weight += 1.0 / estimate.variance;
  }
  CommonValue common{sum / weight, 1.0 / std::sqrt(weight), 1.0};
  if (estimates.size() < 2) return common;
  double chi2 = 0.0;
  for (const Estimate& estimate : estimates) chi2 += std::pow(estimate.value - common.mean, 2) / estimate.variance;
  const boost::math::chi_squared distribution(static_cast<double>(estimates.size() - 1));
  common.chance = boost::math::cdf(boost::math::complement(distribution, chi2));
  return common;
}

}  // namespace rollrig::diagnosis
