// 95 % intervals of `fit tire` on 400 sets with noise: how often do they hold the truth?
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <iostream>
#include <map>

#include "sim/core/parallel.h"
#include "tests/support/fit_study.h"

using namespace rollrig;

TEST_CASE("95 % intervals cover at their rate, for each parameter", "[slow]") {
  constexpr int kSeeds = 400;
  const auto set = tests::make_warm_up_set("a50", "source_with_gas");
  std::vector<identification::TireFit> fits(kSeeds);
  parallel_for(kSeeds, 0, [&](std::size_t i) {
    fits[i] = identification::fit_tire(tests::add_noise(set, i + 1), {false, {}, 1});
  });
  for (std::size_t p = 0; p < fits[0].estimates.size(); ++p) {
    const std::string& key = fits[0].estimates[p].key;
    const double truth = tests::find_truth(set, key);
    int covered = 0;
    double width = 0.0;
    for (const auto& fit : fits) {
      const auto& estimate = fit.estimates[p];
      if (estimate.lower_95() <= truth && truth <= estimate.upper_95()) ++covered;
      width += (estimate.upper_95() - estimate.lower_95()) / kSeeds;
    }
    std::cout << fmt::format("{:<42} truth {:>10.5g}  interval {:>10.4g} wide ({:.1f} %)  covered {} of {}\n", key,
                             truth, width, 100.0 * width / truth, covered, kSeeds);
    INFO(key << " covered " << covered << " of " << kSeeds);
    CHECK_FALSE(tests::is_rejected(covered, kSeeds, 0.95, 0.01));
  }
}
