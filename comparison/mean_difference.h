#pragma once
/// The mean of samples that are correlated from one to the next, with its uncertainty.

#include <optional>
#include <string>
#include <vector>

#include "models/sensor.h"

namespace rollrig::comparison {

constexpr std::size_t kBlocks = 8;          // Assumed: long blocks, and 6 degrees of freedom
constexpr std::size_t kFewestPerBlock = 4;  // Assumed: samples of a block, so that its mean says something

/// A mean with its standard uncertainty.
struct UncertainMean {
  double mean = 0.0;
  std::optional<double> sd;      // none where there are too few samples
  double coverage_factor = 0.0;  // of an interval of 95 %
};

/// Mean of samples at equal intervals, its uncertainty from the means of kBlocks blocks of equal length about a
/// straight line through them.
/// Equation  u^2 = sum (m_b - line(b))^2 / (B (B - 2)),  k = t_0.975(B - 2)
/// Symbols   m_b means of the B blocks, in order
/// Validity  blocks that are several times as long as the samples are correlated. The trend of a tire that warms up is
///           not counted as scatter as far as it is straight
/// Source    batch means: Law and Carson, Operations Research 27 (1979) 1011; not read. Assumed: eight blocks, the line
/// Checked   tests/comparison/mean_difference_test.cpp
UncertainMean calc_block_mean(const std::vector<double>& samples);

/// Standard uncertainty of the mean of `count` samples of a sensor from its noise, drift and resolution; without
/// offset.
/// Source   models::calc_difference_variance() of two means far apart, of which this is one
double calc_sensor_mean_sd(const models::SensorParameters& sensor, std::size_t count, double interval_s);

/// The same, whose uncertainty is not less than that of the sensors: a stretch that is short against their drift does
/// not show all of it.
UncertainMean calc_mean(const std::vector<double>& samples, double sensors_sd);

/// The same with the zeros of the sensors, which no scatter shows: an independent, normal error of the mean.
/// Equation  u^2 = u_mean^2 + u_zeros^2;  half the interval = sqrt((k u_mean)^2 + (1.96 u_zeros)^2)
UncertainMean add_zeros(const UncertainMean& mean, double zeros_sd);

}  // namespace rollrig::comparison
