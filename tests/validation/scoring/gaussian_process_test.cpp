// A Gaussian process follows what is smooth, and leaves noise alone.
#include "validation/scoring/baselines/gaussian_process.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/core/random.h"

using namespace rollrig;

namespace {

constexpr Eigen::Index kPoints = 150;

Eigen::MatrixXd spread_over(double length) { return Eigen::VectorXd::LinSpaced(kPoints, 0.0, length); }

Eigen::VectorXd draw_unit_noise(std::uint64_t seed) {
  RandomStream random(seed, "gaussian process");
  Eigen::VectorXd noise(kPoints);
  for (double& value : noise) value = random.normal();
  return noise;
}

const Eigen::MatrixXd kNoise = Eigen::MatrixXd::Identity(kPoints, kPoints);

double rms(const Eigen::VectorXd& values) { return std::sqrt(values.squaredNorm() / static_cast<double>(kPoints)); }

}  // namespace

TEST_CASE("a smooth function is predicted where it was not seen, through noise", "[fast]") {
  const Eigen::MatrixXd seen = spread_over(6.0);
  const Eigen::MatrixXd unseen = seen.array() + 0.02;
  const auto truth = [](const Eigen::MatrixXd& x) -> Eigen::VectorXd { return 10.0 * x.array().sin(); };
  const validation::GaussianProcess process(seen, truth(seen) + draw_unit_noise(1), kNoise);
  CHECK(rms(truth(unseen) - process.predict(unseen)) < 0.1 * rms(truth(unseen)));
}

TEST_CASE("of white noise next to nothing is predicted", "[fast]") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const validation::GaussianProcess process(spread_over(6.0), draw_unit_noise(seed), kNoise);
    CHECK(rms(process.predict(spread_over(6.0))) < 0.35);
  }
}

TEST_CASE("far from all that was seen, and where nothing was, nothing is predicted", "[fast]") {
  const validation::GaussianProcess process(spread_over(6.0), Eigen::VectorXd::Constant(kPoints, 3.0), kNoise);
  CHECK(process.predict(Eigen::MatrixXd::Constant(1, 1, 3.0))[0] == Approx(3.0).epsilon(0.05));
  CHECK(std::abs(process.predict(Eigen::MatrixXd::Constant(1, 1, 500.0))[0]) < 1e-6);
  const validation::GaussianProcess of_nothing(spread_over(6.0), Eigen::VectorXd::Zero(kPoints), kNoise);
  CHECK(of_nothing.predict(spread_over(6.0)).isZero());
}

TEST_CASE("what an offset of the sensor may be is not learned", "[fast]") {
  const Eigen::MatrixXd offset = kNoise + Eigen::MatrixXd::Constant(kPoints, kPoints, 100.0);
  const validation::GaussianProcess process(spread_over(6.0), Eigen::VectorXd::Constant(kPoints, 8.0), offset);
  CHECK(rms(process.predict(spread_over(6.0))) < 0.5);
}
