#include "measurements/whitener.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "models/quantities.h"

using namespace rollrig;
using measurements::Block;
using measurements::Whitener;
using models::SensorParameters;

namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Samples {
  std::vector<double> time_s;
  std::vector<Block> blocks;
};

/// Samples at 1 Hz with jitter, some missing, with gaps of minutes; blocks of one to ten of them.
Samples make_irregular(int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  Samples made;
  double time_s = 3.0;
  for (int i = 0; i < count; ++i) {
    time_s += 0.5 + uniform(random);
    if (uniform(random) < 0.1) time_s += 5.0;
    if (uniform(random) < 0.02) time_s += 400.0;
    made.time_s.push_back(time_s);
  }
  for (std::size_t first = 0; first < made.time_s.size();) {
    const std::size_t last = std::min(made.time_s.size(), first + 1 + static_cast<std::size_t>(10.0 * uniform(random)));
    made.blocks.push_back({first, last});
    first = last;
  }
  return made;
}

/// Covariance of block means, from the drift's autocorrelation; `white` of a sample, `lasting` of a block.
Eigen::MatrixXd make_covariance(const SensorParameters& sensor, const Samples& samples, double white, double lasting) {
  const auto size = static_cast<Eigen::Index>(samples.blocks.size());
  Eigen::MatrixXd covariance(size, size);
  for (Eigen::Index a = 0; a < size; ++a) {
    for (Eigen::Index b = 0; b < size; ++b) {
      const Block& x = samples.blocks[static_cast<std::size_t>(a)];
      const Block& y = samples.blocks[static_cast<std::size_t>(b)];
      double sum = 0.0;
      for (std::size_t i = x.first; i < x.last; ++i) {
        for (std::size_t j = y.first; j < y.last; ++j) {
          const double apart_s = std::abs(samples.time_s[i] - samples.time_s[j]);
          sum += sensor.drift_sd * sensor.drift_sd * std::exp(-apart_s / sensor.drift_time_s);
          if (i == j) sum += white;
        }
      }
      covariance(a, b) = sum / static_cast<double>((x.last - x.first) * (y.last - y.first));
      if (a == b) covariance(a, b) += lasting;
    }
  }
  return covariance;
}

void check_against(const SensorParameters& sensor, double white, double lasting) {
  const Samples samples = make_irregular(300);
  const Eigen::MatrixXd covariance = make_covariance(sensor, samples, white, lasting);
  const Whitener whitener(sensor, samples.time_s, samples.blocks);
  REQUIRE(whitener.size() == samples.blocks.size());
  const Eigen::Index n = covariance.rows();
  RowMatrix w = RowMatrix::Identity(n, n);
  whitener.apply(w.data(), static_cast<std::size_t>(n));
  const Eigen::MatrixXd left = w * covariance * w.transpose() - Eigen::MatrixXd::Identity(n, n);
  CHECK(left.cwiseAbs().maxCoeff() < 1e-9);
  for (Eigen::Index k = 0; k < n; ++k) {
    CHECK(whitener.standard_deviation(static_cast<std::size_t>(k)) == Approx(std::sqrt(covariance(k, k))));
  }
}

/// Sensors' own errors of a block's mean, over true values anywhere between two steps of the resolution.
struct Drawn {
  double variance = 0.0;  // of the whitened means
  double lagged = 0.0;    // mean product of neighbors
  double whitened = 0.0;  // how many
};

Drawn draw_whitened(const SensorParameters& sensor, int draws) {
  const Samples samples = make_irregular(60);
  const Whitener whitener(sensor, samples.time_s, samples.blocks);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, std::max(sensor.resolution, 1e-3));
  Drawn drawn;
  for (int draw = 0; draw < draws; ++draw) {
    // A true value of its own in each block, as where it moves by more than a step.
    std::vector<double> truth(samples.time_s.size());
    for (const Block& block : samples.blocks) {
      std::fill(truth.begin() + static_cast<std::ptrdiff_t>(block.first),
                truth.begin() + static_cast<std::ptrdiff_t>(block.last), uniform(random));
    }
    std::vector<double> values = truth;
    models::apply_sensor(sensor, models::quantities::kDrumTorque, {static_cast<std::uint64_t>(draw), "s", "r"},
                         samples.time_s, values);
    std::vector<double> means;
    for (const Block& block : samples.blocks) {
      double sum = 0.0;
      for (std::size_t i = block.first; i < block.last; ++i) sum += values[i] - truth[i];
      means.push_back(sum / static_cast<double>(block.last - block.first));
    }
    whitener.apply(means.data(), 1);
    for (std::size_t k = 0; k < means.size(); ++k) {
      drawn.variance += means[k] * means[k];
      if (k > 0) drawn.lagged += means[k] * means[k - 1];
      drawn.whitened += 1.0;
    }
  }
  drawn.variance /= drawn.whitened;
  drawn.lagged /= drawn.whitened;
  return drawn;
}

}  // namespace

TEST_CASE("whitening takes the covariance of block means to one, for any times and gaps", "[fast]") {
  check_against({0.0, 0.3, 60.0, 0.2, 0.0}, 0.04, 0.0);
  check_against({0.0, 0.3, 2.0, 0.2, 0.0}, 0.04, 0.0);
  check_against({0.0, 2.0, 5000.0, 0.01, 0.0}, 1e-4, 0.0);
}

TEST_CASE("without drift blocks are independent, and the more samples the surer", "[fast]") {
  check_against({0.0, 0.0, 60.0, 0.2, 0.0}, 0.04, 0.0);
}

TEST_CASE("without noise the drift alone is whitened", "[fast]") {
  check_against({0.0, 0.3, 60.0, 0.0, 0.0}, 0.0, 0.0);
}

TEST_CASE("an offset of the session is not the whitener's", "[fast]") {
  check_against({5.0, 0.3, 60.0, 0.2, 0.0}, 0.04, 0.0);
}

TEST_CASE("rounding lasts through a block where there is no noise, and is noise where there is much", "[fast]") {
  const double rounding = 0.1 * 0.1 / 12.0;
  check_against({0.0, 0.3, 60.0, 0.0, 0.1}, 0.0, rounding);
  check_against({0.0, 0.3, 60.0, 0.2, 0.1}, 0.04 + rounding, 0.0);
}

TEST_CASE("errors of a sensor come out white with unit variance", "[fast]") {
  const SensorParameters sensors[] = {{0.0, 0.3, 60.0, 0.2, 0.0},
                                      {0.0, 0.0, 60.0, 0.3, 1.0},  // rounding that noise does not wash out
                                      {0.0, 0.0, 60.0, 0.0, 1.0},  // nothing but rounding
                                      {0.0, 0.3, 20.0, 0.2, 0.1}};
  for (const SensorParameters& sensor : sensors) {
    INFO("drift " << sensor.drift_sd << ", noise " << sensor.noise_sd << ", resolution " << sensor.resolution);
    const Drawn drawn = draw_whitened(sensor, 1500);
    CHECK(drawn.variance == Approx(1.0).margin(5.0 * std::sqrt(2.0 / drawn.whitened)));
    CHECK(std::abs(drawn.lagged) < 5.0 / std::sqrt(drawn.whitened));
  }
}

TEST_CASE("the rounding error that lasts is what two readings of one value share", "[fast]") {
  constexpr int kDraws = 400000;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  const double resolution = 0.5;
  for (const double noise_sd : {0.05, 0.15, 0.25}) {
    const auto read = [&](double truth) {
      return resolution * std::round((truth + noise_sd * normal(random)) / resolution) - truth;
    };
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const double truth = resolution * uniform(random);
      const double product = read(truth) * read(truth);
      sum += product;
      squares += product * product;
    }
    const double mean = sum / kDraws;
    const double error = std::sqrt((squares / kDraws - mean * mean) / kDraws);
    INFO("noise " << noise_sd);
    CHECK(std::abs(measurements::calc_lasting_rounding_variance(resolution, noise_sd) - mean) < 4.0 * error);
  }
}

TEST_CASE("the rounding error that lasts has its limits", "[fast]") {
  CHECK(measurements::calc_lasting_rounding_variance(0.0, 0.2) == 0.0);
  CHECK(measurements::calc_lasting_rounding_variance(0.6, 0.0) == Approx(0.03));
  CHECK(measurements::calc_lasting_rounding_variance(0.6, 1e-6) == Approx(0.03).epsilon(1e-3));  // goes over smoothly
  CHECK(measurements::calc_lasting_rounding_variance(0.1, 0.2) < 1e-12);
  double before = 1.0;
  for (double noise_sd = 0.0; noise_sd < 0.5; noise_sd += 0.05) {
    const double now = measurements::calc_lasting_rounding_variance(0.6, noise_sd);
    CHECK(now < before);
    before = now;
  }
}

TEST_CASE("whitening is linear, column by column, and can be taken back", "[fast]") {
  const Samples samples = make_irregular(100);
  const Whitener whitener({0.0, 0.3, 60.0, 0.2, 0.1}, samples.time_s, samples.blocks);
  const auto n = static_cast<Eigen::Index>(whitener.size());
  const RowMatrix columns = RowMatrix::Random(n, 3);
  RowMatrix all = columns;
  whitener.apply(all.data(), 3);
  for (Eigen::Index c = 0; c < 3; ++c) {
    Eigen::VectorXd one = columns.col(c);
    whitener.apply(one.data(), 1);
    CHECK(one == all.col(c));
  }
  Eigen::VectorXd sum = 2.0 * columns.col(0) - 3.0 * columns.col(1);
  whitener.apply(sum.data(), 1);
  CHECK((sum - 2.0 * all.col(0) + 3.0 * all.col(1)).norm() < 1e-12 * sum.norm());
  whitener.undo(all.data(), 3);
  CHECK((all - columns).norm() < 1e-12 * columns.norm());
}
