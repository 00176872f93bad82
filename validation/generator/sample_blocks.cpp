#include "validation/generator/sample_blocks.h"

#include <algorithm>
#include <cmath>

namespace rollrig::generator {
namespace {

constexpr std::size_t kBlockRows = 10;

}  // namespace

/// Covariance of the drift and of its mean over the samples of a block so far.
struct SampleBlocks::Spreading {
  double drift = 0.0;
  double both = 0.0;
  double mean = 0.0;

  void go_on(double kept, double drift_variance) {
    drift = kept * kept * drift + (1.0 - kept * kept) * drift_variance;
    both *= kept;
  }
  void take_sample(double share) {
    mean += share * (2.0 * both + share * drift);
    both += share * drift;
  }
};

/// `spreading` holds what is not known of the drift before the block, then after it.
SampleBlocks::Block SampleBlocks::filter_block(const Sensor& sensor, const std::vector<bool>& has_sample,
                                               std::size_t first, std::size_t end, Spreading& spreading) {
  Block block;
  for (std::size_t row = first; row < end; ++row) {
    if (has_sample[row]) block.rows.push_back(row);
  }
  const double kept = std::exp(-1.0 / sensor.drift_time_s);
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(1, block.rows.size()));
  spreading.both = spreading.mean = 0.0;
  for (std::size_t row = first; row < end; ++row) {
    spreading.go_on(kept, sensor.drift_sd * sensor.drift_sd);
    block.kept *= kept;
    if (!has_sample[row]) continue;
    spreading.take_sample(share);
    block.seen += share * block.kept;
  }
  if (block.rows.empty()) return block;
  const double white = sensor.noise_sd * sensor.noise_sd + sensor.resolution * sensor.resolution / 12.0;
  const double variance = spreading.mean + white * share;
  block.gain = spreading.both / variance;
  block.scale = 1.0 / std::sqrt(variance);
  spreading.drift -= block.gain * spreading.both;
  return block;
}

SampleBlocks::SampleBlocks(const Sensor& sensor, const std::vector<bool>& has_sample) {
  Spreading spreading{sensor.drift_sd * sensor.drift_sd};
  double skipped = 1.0;
  for (std::size_t first = 0; first < has_sample.size(); first += kBlockRows) {
    const std::size_t end = std::min(first + kBlockRows, has_sample.size());
    Block block = filter_block(sensor, has_sample, first, end, spreading);
    if (block.rows.empty()) {
      skipped *= block.kept;
      continue;
    }
    block.skipped = skipped;
    skipped = 1.0;
    blocks_.push_back(std::move(block));
  }
}

void SampleBlocks::whiten(const std::vector<double>& values, double* whitened) const {
  double drift = 0.0;
  for (const Block& block : blocks_) {
    double mean = 0.0;
    for (const std::size_t row : block.rows) mean += std::isnan(values[row]) ? 0.0 : values[row];
    mean /= static_cast<double>(block.rows.size());
    drift *= block.skipped;
    const double news = mean - block.seen * drift;
    *whitened++ = block.scale * news;
    drift = block.kept * drift + block.gain * news;
  }
}

}  // namespace rollrig::generator
