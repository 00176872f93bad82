// 95 % intervals of `fit road-load` on simulated sets of coastdowns: how often do they hold the truth?
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <iostream>

#include "sim/core/parallel.h"
#include "tests/support/coastdown_study.h"
#include "tests/support/fit_study.h"

using namespace rollrig;

namespace {

void check_road_load_coverage(const char* name, const tests::CoastdownStudy& study) {
  const int seeds = tests::count_seeds(500);
  estimation::RoadLoadFitOptions options;
  options.mass_kg = study.mass_kg;
  std::vector<estimation::RoadLoadFit> fits(static_cast<std::size_t>(seeds));
  parallel_for(fits.size(), 0, [&](std::size_t i) {
    fits[i] = estimation::fit_road_load(tests::simulate_coastdowns(study, i + 1), options);
  });
  const double truth[3] = {study.load.A_N, study.load.B_N_s_per_m, study.load.C_N_s2_per_m2};
  for (int p = 0; p < 3; ++p) {
    int covered = 0;
    double width = 0.0;
    for (const estimation::RoadLoadFit& fit : fits) {
      const auto [lower, upper] = fit.interval_95(p);
      if (lower <= truth[p] && truth[p] <= upper) ++covered;
      width += (upper - lower) / seeds;
    }
    std::cout << fmt::format("{:<28} {}  interval {:>5.2f} % wide  covered {} of {}\n", name, "ABC"[p],
                             100.0 * width / truth[p], covered, seeds);
    INFO(name << " "
              << "ABC"[p] << " covered " << covered << " of " << seeds);
    CHECK_FALSE(tests::is_rejected(covered, seeds, 0.95, 0.01));
  }
}

}  // namespace

TEST_CASE("95 % intervals of A, B, C cover at their rate: sensor noise, five pairs", "[slow]") {
  check_road_load_coverage("sensor noise, 5 pairs", {});
}

TEST_CASE("95 % intervals of A, B, C cover at their rate: to standstill", "[slow]") {
  tests::CoastdownStudy study;
  study.to_km_h = 0.0;
  check_road_load_coverage("to standstill, 5 pairs", study);
}

TEST_CASE("95 % intervals of A, B, C cover at their rate: gusts, runs that differ, wind, slope", "[slow]") {
  tests::CoastdownStudy study;
  study.gust_N_sqrt_s = 10.0;
  study.run_force_sd_N = 3.0;
  study.run_wind_sd_m_s = 0.3;
  study.wind_m_s = 1.5;
  study.slope = 0.001;
  check_road_load_coverage("gusts and run scatter", study);
}
