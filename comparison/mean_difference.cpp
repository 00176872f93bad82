#include "comparison/mean_difference.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "estimation/uncertainty/budget.h"

namespace rollrig::comparison {
namespace {

/// Means of the blocks; samples that are left over at the end are in none.
std::vector<double> calc_block_means(const std::vector<double>& samples) {
  const std::size_t length = samples.size() / kBlocks;
  std::vector<double> means;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const auto first = samples.begin() + static_cast<std::ptrdiff_t>(block * length);
    means.push_back(std::accumulate(first, first + static_cast<std::ptrdiff_t>(length), 0.0) /
                    static_cast<double>(length));
  }
  return means;
}

/// Sum of squares about the line that fits best.
double sum_squares_about_line(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double product = 0.0, places = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double place = static_cast<double>(i) - 0.5 * (count - 1.0);
    product += place * (values[i] - mean);
    places += place * place;
    squares += (values[i] - mean) * (values[i] - mean);
  }
  return std::max(0.0, squares - product * product / places);
}

}  // namespace

UncertainMean calc_block_mean(const std::vector<double>& samples) {
  UncertainMean found;
  found.mean = std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
  if (samples.size() < kBlocks * kFewestPerBlock) return found;
  constexpr double kFreedom = kBlocks - 2;
  found.sd = std::sqrt(sum_squares_about_line(calc_block_means(samples)) / (kFreedom * kBlocks));
  found.coverage_factor = estimation::calc_coverage_factor(kFreedom);
  return found;
}

double calc_sensor_mean_sd(const models::SensorParameters& sensor, std::size_t count, double interval_s) {
  constexpr double kFar_s = 1e9;  // the drifts of two means so far apart have nothing in common
  return std::sqrt(0.5 * models::calc_difference_variance(sensor, static_cast<int>(count), interval_s, kFar_s));
}

UncertainMean add_zeros(const UncertainMean& mean, double zeros_sd) {
  if (!mean.sd.has_value() || zeros_sd <= 0.0) return mean;
  const double of_zeros = zeros_sd * estimation::calc_coverage_factor(std::numeric_limits<double>::infinity());
  UncertainMean both = mean;
  both.sd = std::hypot(*mean.sd, zeros_sd);
  both.coverage_factor = std::hypot(*mean.sd * mean.coverage_factor, of_zeros) / *both.sd;
  return both;
}

UncertainMean calc_mean(const std::vector<double>& samples, double sensors_sd) {
  UncertainMean found = calc_block_mean(samples);
  const double of_sensors = sensors_sd * estimation::calc_coverage_factor(std::numeric_limits<double>::infinity());
  if (!found.sd.has_value() || of_sensors <= *found.sd * found.coverage_factor) return found;
  found.sd = sensors_sd;
  found.coverage_factor = of_sensors / sensors_sd;
  return found;
}

}  // namespace rollrig::comparison
