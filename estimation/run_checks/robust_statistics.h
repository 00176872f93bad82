#pragma once
/// Median and robust standard deviation.

#include <vector>

namespace rollrig::estimation {

/// Median; 0 of no values.
double calc_median(std::vector<double> values);

/// Median of the distances from the median, scaled to the standard deviation of the normal distribution.
double calc_mad_sd(const std::vector<double>& values);

}  // namespace rollrig::estimation
