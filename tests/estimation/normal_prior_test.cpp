// Against the closed form of two numbers that are jointly normal.
#include "estimation/normal_prior.h"

#include <Eigen/QR>
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/tire_fit/drum_residuals.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using estimation::FreeParameter;

namespace {

constexpr double kCorrelation = -0.6;
constexpr double kSd1 = 700.0;
constexpr double kSd2 = 0.25;
const char* const kFirst = "tire.thermal.heat_capacity_J_per_K";
const char* const kSecond = "tire.thermal.H_gas_W_per_K";

/// Two numbers with a prior and, between them, one without.
std::vector<FreeParameter> make_parameters() {
  std::vector<FreeParameter> parameters{
      {kFirst, 17000.0, kSd1}, {"tire.thermal.z_W_per_K", 12.0}, {kSecond, 4.0, kSd2}};
  estimation::put_correlations({{kFirst, kSecond, kCorrelation},
                                {kFirst, "tire.thermal.z_W_per_K", 0.9},
                                {kFirst, "tire.thermal.road_share_of_z", 0.9}},
                               parameters);
  return parameters;
}

}  // namespace

TEST_CASE("data that fix one number move the other by rho s2/s1 of its way", "[fast]") {
  const Eigen::MatrixXd factor = estimation::calc_prior_factor(make_parameters());
  REQUIRE(factor.rows() == 2);
  const double delta = 2.0 * kSd1;
  // Of all independent unknowns that put the first number there, the likeliest are the shortest.
  const Eigen::MatrixXd first = kSd1 * factor.row(0);
  const Eigen::VectorXd right = Eigen::VectorXd::Constant(1, delta);
  const Eigen::VectorXd unknowns = first.completeOrthogonalDecomposition().solve(right);
  CHECK(kSd2 * factor.row(1).dot(unknowns) == Approx(kCorrelation * kSd2 / kSd1 * delta));
}

TEST_CASE("the residuals of a prior are least where the second number follows the first", "[fast]") {
  measurements::MeasurementSet set = tests::make_warm_up_set("a50", "source", "quasi_static");
  set.runs.clear();
  const estimation::DrumResiduals residuals(set, measurements::make_context(set), make_parameters(), 1);
  REQUIRE(residuals.residual_count() == 2);
  REQUIRE(residuals.unknown_count() == 3);
  const double delta = 1.5 * kSd1;
  std::vector<double> unknowns = residuals.start();
  unknowns[0] += delta;
  Eigen::Vector2d at;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> jacobian;
  residuals.evaluate(unknowns.data(), at.data(), jacobian.data());
  CHECK(jacobian.col(1).norm() == 0.0);  // has no prior
  const Eigen::Vector2d by_second = jacobian.col(2);
  const double step = -by_second.dot(at) / by_second.squaredNorm();
  CHECK(step == Approx(kCorrelation * kSd2 / kSd1 * delta));
  // What is left is the first number's own distance; the second is then known within s2 sqrt(1 - rho^2).
  CHECK((at + step * by_second).norm() == Approx(delta / kSd1));
  CHECK(1.0 / by_second.norm() == Approx(kSd2 * std::sqrt(1.0 - kCorrelation * kCorrelation)));
}

TEST_CASE("without correlations the factor is exactly the identity", "[fast]") {
  const std::vector<FreeParameter> parameters{{kFirst, 17000.0, kSd1}, {kSecond, 4.0, kSd2}};
  CHECK((estimation::calc_prior_factor(parameters) == Eigen::MatrixXd::Identity(2, 2)));
  CHECK(estimation::calc_prior_factor({}).size() == 0);
}
