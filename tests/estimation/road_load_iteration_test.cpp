// Where the iteration of a road-load fit ends.
#include "estimation/road_load/road_load_iteration.h"

#include <catch2/catch.hpp>

#include "tests/support/coastdown_study.h"

using namespace rollrig;
using namespace rollrig::estimation;

TEST_CASE("an iteration ends where its scatter stays as well: from there another one goes nowhere", "[fast]") {
  tests::CoastdownStudy study;
  study.pairs = 8;
  study.run_force_sd_N = 4.0;
  study.gust_N_sqrt_s = 20.0;
  RoadLoadFitOptions options;
  options.mass_kg = 2100.0;
  const double mass_kg = 2160.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const CoastdownProblem problem = make_problem(tests::simulate_coastdowns(study, seed), options, mass_kg);
    IterationStart start{start_coefficients(problem), Eigen::VectorXd::Zero(kComponents)};
    start.components(kPassing) = 1e-4;
    const IteratedFit first = iterate_road_load(problem, std::nullopt, start, Components::kEstimated);
    CHECK(first.iterations > 1);
    const IteratedFit again =
        iterate_road_load(problem, std::nullopt, {first.coefficients, first.components}, Components::kEstimated);
    for (Eigen::Index i = 0; i < kComponents; ++i) {
      INFO("component " << i << ": " << first.components(i) << " " << again.components(i));
      CHECK(std::abs(again.components(i) - first.components(i)) <=
            2e-3 * first.components(i) + 1e-9 * first.components.maxCoeff());
    }
  }
}
