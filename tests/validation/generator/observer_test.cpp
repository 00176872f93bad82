// The ideal observer against dense algebra and closed forms.
#include "validation/generator/observer.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "validation/generator/draws.h"
#include "validation/generator/sample_blocks.h"

using rollrig::generator::SampleBlocks;
using rollrig::generator::Sensor;

namespace {

const Sensor kSensor{0.4, 0.1, 60.0, 0.25, 0.1};

/// A minute and a half with single samples missing, a whole block without, and one that is left with two.
std::vector<bool> leave_gaps(std::size_t rows) {
  std::vector<bool> has_sample(rows, true);
  has_sample[3] = has_sample[17] = false;
  for (std::size_t row = 28; row < 45; ++row) has_sample[row] = false;
  return has_sample;
}

std::vector<std::vector<std::size_t>> list_blocks(const std::vector<bool>& has_sample) {
  std::vector<std::vector<std::size_t>> blocks;
  for (std::size_t first = 0; first < has_sample.size(); first += 10) {
    std::vector<std::size_t> rows;
    for (std::size_t row = first; row < std::min(first + 10, has_sample.size()); ++row) {
      if (has_sample[row]) rows.push_back(row);
    }
    if (!rows.empty()) blocks.push_back(rows);
  }
  return blocks;
}

/// Covariance of block means, sum by sum.
Eigen::MatrixXd calc_covariance(const Sensor& sensor, const std::vector<std::vector<std::size_t>>& blocks) {
  const auto n = static_cast<Eigen::Index>(blocks.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  const double white = sensor.noise_sd * sensor.noise_sd + sensor.resolution * sensor.resolution / 12.0;
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b < n; ++b) {
      const auto& of_a = blocks[static_cast<std::size_t>(a)];
      const auto& of_b = blocks[static_cast<std::size_t>(b)];
      for (const std::size_t i : of_a) {
        for (const std::size_t j : of_b) {
          const double apart_s = std::abs(static_cast<double>(i) - static_cast<double>(j));
          const double drift = sensor.drift_sd * sensor.drift_sd * std::exp(-apart_s / sensor.drift_time_s);
          covariance(a, b) += (drift + (i == j ? white : 0.0)) / static_cast<double>(of_a.size() * of_b.size());
        }
      }
    }
  }
  return covariance;
}

Eigen::VectorXd whiten(const SampleBlocks& blocks, const std::vector<double>& values) {
  Eigen::VectorXd whitened(static_cast<Eigen::Index>(blocks.size()));
  blocks.whiten(values, whitened.data());
  return whitened;
}

Eigen::MatrixXd draw_matrix(Eigen::Index rows, Eigen::Index columns) {
  rollrig::generator::Draws draws(1, "observer test");
  Eigen::MatrixXd matrix(rows, columns);
  for (double& value : matrix.reshaped()) value = draws.normal();
  return matrix;
}

}  // namespace

TEST_CASE("unknowns are fitted under their prior", "[fast]") {
  // (1 + 1^2 + 1^2)^-1 (1 3 + 1 6) of one that moves both samples alike
  Eigen::MatrixXd one(2, 1);
  one << 1.0, 1.0;
  CHECK(rollrig::generator::Observer(one).fit(Eigen::Vector2d(3.0, 6.0))[0] == Approx(3.0));
  // two that each move a sample of their own: s u/(1 + u^2)
  Eigen::MatrixXd two(2, 2);
  two << 3.0, 0.0, 0.0, 1.0;
  const Eigen::VectorXd fitted = rollrig::generator::Observer(two).fit(Eigen::Vector2d(10.0, 10.0));
  CHECK(fitted[0] == Approx(3.0));
  CHECK(fitted[1] == Approx(5.0));
}

TEST_CASE("whitened blocks weigh a signal as the inverse of their covariance does", "[fast]") {
  const std::vector<bool> has_sample = leave_gaps(95);
  const auto lists = list_blocks(has_sample);
  std::vector<double> values;
  for (std::size_t row = 0; row < has_sample.size(); ++row) values.push_back(std::sin(0.1 * static_cast<double>(row)));
  Eigen::VectorXd means(static_cast<Eigen::Index>(lists.size()));
  for (std::size_t b = 0; b < lists.size(); ++b) {
    double sum = 0.0;
    for (const std::size_t row : lists[b]) sum += values[row];
    means[static_cast<Eigen::Index>(b)] = sum / static_cast<double>(lists[b].size());
  }
  const SampleBlocks blocks(kSensor, has_sample);
  REQUIRE(blocks.size() == lists.size());
  const double expected = means.dot(calc_covariance(kSensor, lists).llt().solve(means));
  CHECK(whiten(blocks, values).squaredNorm() == Approx(expected).epsilon(1e-9));
}

TEST_CASE("a constant shift is hidden by the session's offset, as the closed form says", "[fast]") {
  const double shift = 0.8;
  const std::size_t rows = 36000;  // long: what is left is the offset's own standard deviation
  const std::vector<bool> has_sample(rows, true);
  for (const double drift_sd : {0.0, 0.1}) {
    Sensor sensor = kSensor;
    sensor.drift_sd = drift_sd;
    const SampleBlocks blocks(sensor, has_sample);
    const Eigen::VectorXd ones = whiten(blocks, std::vector<double>(rows, 1.0));
    const rollrig::generator::Observer observer(sensor.offset_sd * ones);
    // d'^2 = shift^2 a/(1 + sd^2 a), a = 1^T N^-1 1; without drift a = rows/(noise^2 + q^2/12)
    const double a = ones.squaredNorm();
    const double d_prime = observer.reduce(shift * ones).norm();
    CHECK(d_prime == Approx(shift * std::sqrt(a / (1.0 + 0.16 * a))).epsilon(1e-9));
    CHECK(d_prime == Approx(shift / 0.4).epsilon(0.01));
    if (drift_sd == 0.0) CHECK(a == Approx(36000.0 / (0.0625 + 0.01 / 12.0)).epsilon(1e-9));
  }
}

TEST_CASE("what unknowns can do is taken out as the covariance with them says", "[fast]") {
  const Eigen::MatrixXd drawn = draw_matrix(40, 7);
  Eigen::MatrixXd unknowns = drawn.leftCols(5);
  unknowns.col(4) *= 1e5;  // hardly known at all
  const Eigen::MatrixXd signals = drawn.rightCols(2) + 50.0 * drawn.leftCols(2);
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(40, 40) + unknowns * unknowns.transpose();
  const Eigen::MatrixXd expected = signals.transpose() * covariance.fullPivLu().solve(signals);
  const Eigen::MatrixXd reduced = rollrig::generator::Observer(unknowns).reduce(signals);
  CHECK((reduced.transpose() * reduced - expected).norm() < 1e-6 * expected.norm());
}
