#include "diagnosis/comparison/bounded_step.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <limits>

using rollrig::diagnosis::solve_within;

namespace {

const double kNone = std::numeric_limits<double>::infinity();

Eigen::MatrixXd make_curvature() {
  Eigen::MatrixXd curvature(3, 3);
  curvature << 4.0, 1.9, 0.3, 1.9, 2.0, -0.5, 0.3, -0.5, 3.0;
  return curvature;
}

const Eigen::Vector3d kGradient(3.0, -2.0, 1.0);

double cost(const Eigen::VectorXd& x) { return 0.5 * x.dot(make_curvature() * x) - kGradient.dot(x); }

}  // namespace

TEST_CASE("without bounds it is the solution of the equations", "[fast]") {
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(kNone);
  const Eigen::VectorXd x = solve_within(make_curvature(), kGradient, -none, none);
  CHECK((make_curvature() * x - kGradient).norm() < 1e-12);
}

TEST_CASE("an unknown on its bound moves the others to where they are best beside it", "[fast]") {
  const Eigen::Vector3d upper(0.5, kNone, kNone);
  const Eigen::VectorXd x = solve_within(make_curvature(), kGradient, Eigen::Vector3d::Constant(-kNone), upper);
  CHECK(x[0] == 0.5);
  const Eigen::VectorXd slope = make_curvature() * x - kGradient;
  CHECK(slope[0] < 0.0);  // it would go on, were it let
  CHECK(std::abs(slope[1]) < 1e-12);
  CHECK(std::abs(slope[2]) < 1e-12);
  SECTION("which is better than to cut it off alone") {
    const Eigen::Vector3d none = Eigen::Vector3d::Constant(kNone);
    Eigen::VectorXd cut = solve_within(make_curvature(), kGradient, -none, none);
    REQUIRE(cut[0] > 0.5);
    cut[0] = 0.5;
    CHECK(cost(x) < cost(cut));
  }
}

TEST_CASE("what lies between all bounds does not know of them, and all may be on one", "[fast]") {
  const Eigen::Vector3d wide = Eigen::Vector3d::Constant(10.0);
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(kNone);
  CHECK(solve_within(make_curvature(), kGradient, -wide, wide) ==
        solve_within(make_curvature(), kGradient, -none, none));
  const Eigen::Vector3d point(0.1, 0.2, 0.3);
  CHECK(solve_within(make_curvature(), kGradient, point, point) == point);
}
