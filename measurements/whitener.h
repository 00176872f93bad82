#pragma once
/// Whitening of samples, or of means over blocks of them, whose noise is first-order autoregressive drift and white.

#include <vector>

#include "models/sensor.h"

namespace rollrig::measurements {

/// Samples that are averaged: [first, last) of the samples that are there.
struct Block {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Turns means over blocks of samples with a sensor's drift, noise and rounding (not its offset) into independent ones
/// of unit variance. Exact for any times and any missing samples: the drift goes on from sample to sample, and a Kalman
/// filter carries it from block to block.
///
/// Equation  d_i = rho_i d_{i-1} + w_i, rho = exp(-dt/tau), var w = sd_drift^2 (1 - rho^2);
///           block mean y = a d_before + m + e, drift after it = phi d_before + n, m and n correlated;
///           out = (y - a d^) / sqrt(a^2 P + var m + R), R = (noise^2 + q^2/12 - s^2)/count + s^2
/// Symbols   d^, P the drift before the block as predicted, and its variance; q resolution; s^2 the part of the
///           rounding error that noise does not turn into noise, which a mean does not lessen:
///           s^2 = sum_k q^2/(2 pi^2 k^2) exp(-(2 pi k noise/q)^2), q^2/12 without noise
/// Source    (s) the Fourier series of the rounding error of a value with normal noise
/// Checked   tests/measurements/whitener_test.cpp, tests/measurements/whitener_of_blocks_test.cpp
class Whitener {
 public:
  /// `time_s` of the samples that are there, increasing; each is a block of its own.
  Whitener(const models::SensorParameters& sensor, const std::vector<double>& time_s);
  /// Blocks in order, each with a sample at least.
  Whitener(const models::SensorParameters& sensor, const std::vector<double>& time_s, const std::vector<Block>& blocks);

  std::size_t size() const { return steps_.size(); }
  /// Standard deviation of the mean over a block by itself, without offset.
  double standard_deviation(std::size_t block) const { return steps_[block].alone_sd; }

  /// Logarithm of the determinant of the covariance of the block means.
  double log_determinant() const;

  /// Whitens `count` columns of block means at once, in place; row k of column c is values[k * count + c].
  void apply(double* values, std::size_t count) const { apply_from(0, values, {size(), count}); }
  struct Shape {
    std::size_t rows;
    std::size_t columns;
  };
  /// The same of columns that are 0 above a row, from which on `values` has some rows.
  void apply_from(std::size_t first, double* values, Shape shape) const;
  /// One past the last row that matters in a whitened column which was 0 from `end` on: beyond, less than 1e-13 of a
  /// unit is left of it.
  std::size_t find_reach(std::size_t end) const;
  /// Takes `apply` back.
  void undo(double* values, std::size_t count) const;

 private:
  struct Step {
    double memory = 0.0;   // a
    double carry = 0.0;    // phi
    double gain = 0.0;     // of the innovation on the drift after the block
    double inverse = 0.0;  // 1/sqrt(variance of the innovation)
    double alone_sd = 0.0;
  };
  std::vector<Step> steps_;
};

/// Variance of the rounding error that stays in a mean over many samples.
double calc_lasting_rounding_variance(double resolution, double noise_sd);

/// Noise and rounding of a sensor in a mean over samples.
struct ReadingNoise {
  double white = 0.0;    // variance that falls with the number of samples
  double lasting = 0.0;  // variance that does not

  double calc_mean_variance(double samples) const { return white / samples + lasting; }
};
ReadingNoise find_reading_noise(const models::SensorParameters& sensor);

/// The sensor of means over `samples` each: its noise and rounding are smaller.
models::SensorParameters average_sensor(models::SensorParameters sensor, double samples);

}  // namespace rollrig::measurements
