#pragma once
/// Means of a channel's samples over 10 s, whitened by what its sensor does to them.

#include <cstddef>
#include <vector>

#include "validation/generator/sensors.h"

namespace rollrig::generator {

/// Blocks of 10 rows at 1 Hz of one channel of one run. Their errors are uncorrelated and of unit variance after a
/// Kalman filter on the drift, which goes on through rows without a sample.
/// Equation  y_k = mean of n samples of x + d + w,  d_i+1 = a d_i + sqrt(1 - a^2) sd_drift N(0, 1),  a = exp(-dt/tau),
///           var w = sd_noise^2 + q^2/12
///           e_k = (y_k - c_k d_k|k-1)/sqrt(S_k),  d_k+1|k = a^10 d_k|k-1 + K_k (y_k - c_k d_k|k-1)
/// Symbols   d drift, q resolution, c_k mean of a^i over the block's samples, S_k variance of what is new in y_k,
///           K_k = cov(d at the end of the block, what is new)/S_k
/// Checked   tests/validation/generator/observer_test.cpp
class SampleBlocks {
 public:
  /// `has_sample` by row.
  SampleBlocks(const Sensor& sensor, const std::vector<bool>& has_sample);

  /// Blocks that have samples.
  std::size_t size() const { return blocks_.size(); }
  /// Whitened means of `values`, by row, into `whitened`; NaN among values counts as no change, 0.
  void whiten(const std::vector<double>& values, double* whitened) const;

 private:
  struct Block {
    std::vector<std::size_t> rows;  // that have a sample
    double skipped = 1.0;           // what is left of the drift over blocks without samples before
    double kept = 1.0;              // over this one
    double seen = 0.0;              // c
    double gain = 0.0;              // K
    double scale = 1.0;             // 1/sqrt(S)
  };
  struct Spreading;

  static Block filter_block(const Sensor& sensor, const std::vector<bool>& has_sample, std::size_t first,
                            std::size_t end, Spreading& spreading);

  std::vector<Block> blocks_;
};

}  // namespace rollrig::generator
