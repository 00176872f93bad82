// 95 % intervals of `fit tire` on 400 sets with noise: how often do they hold the truth?
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <functional>
#include <iostream>

#include "sim/core/parallel.h"
#include "sim/core/random.h"
#include "tests/support/fit_study.h"

using namespace rollrig;

namespace {

constexpr int kSeeds = 400;

/// Fits of 400 sets of one truth.
void check_fit_coverage(const measurements::MeasurementSet& truth_of,
                        const std::function<measurements::MeasurementSet(std::uint64_t seed)>& make_set) {
  std::vector<estimation::TireFit> fits(kSeeds);
  parallel_for(kSeeds, 0, [&](std::size_t i) {
    fits[i] = estimation::fit_tire(make_set(i + 1), {"", false, false, 1});
  });
  for (std::size_t p = 0; p < fits[0].estimates.size(); ++p) {
    const std::string& key = fits[0].estimates[p].key;
    const double truth = tests::find_truth(truth_of, key);
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

}  // namespace

TEST_CASE("95 % intervals cover at their rate, for each parameter", "[slow]") {
  const auto set = tests::make_warm_up_set("a50", "source_with_gas");
  check_fit_coverage(set, [&](std::uint64_t seed) { return tests::add_noise(set, seed); });
}

TEST_CASE("95 % intervals cover where the files' own numbers are off by their uncertainty", "[slow]") {
  const auto set = tests::make_warm_up_set("a50", "source_with_gas", "quasi_static");
  check_fit_coverage(set, [&](std::uint64_t seed) {
    measurements::MeasurementSet measured = tests::add_noise(set, seed);
    RandomStream random(seed, "files");
    const auto put_off = [&](double& value, double& standard_uncertainty, double share) {
      standard_uncertainty = share * value;
      value += standard_uncertainty * random.normal();
    };
    auto& sd = measured.tire.standard_uncertainties.thermal;
    auto& thermal = measured.tire.values.thermal;
    put_off(thermal.heat_capacity_J_per_K, sd.heat_capacity_J_per_K, 0.05);
    put_off(thermal.gas_heat_capacity_J_per_K, sd.gas_heat_capacity_J_per_K, 0.1);
    put_off(measured.rig->parasitic.c0_N, measured.rig->parasitic_uncertainties.c0_N, 0.07);
    put_off(measured.rig->parasitic.c1_N_s_per_m, measured.rig->parasitic_uncertainties.c1_N_s_per_m, 0.07);
    return measured;
  });
}

TEST_CASE("95 % intervals cover for each number of a bounded law", "[slow]") {
  models::TireFile tire = tests::read_asset_tire("c1_205_55r16");
  auto& sd = tire.standard_uncertainties;
  sd.own.values.assign(sd.own.values.size(), 0.0);
  sd.rolling_resistance = {};
  tests::put_own(tire, "speed_rise_of_fall", 0.3);
  const auto set = tests::make_warm_up_set(
      tire, {{60.0, 4100.0, 230.0, "slow"}, {100.0, 4100.0, 230.0, "fast"}, {100.0, 5600.0, 230.0, "loaded"}},
      "source_with_gas", "quasi_static");
  check_fit_coverage(set, [&](std::uint64_t seed) { return tests::add_noise(set, seed); });
}
