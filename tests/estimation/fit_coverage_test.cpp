// 95 % intervals of `fit tire` on hundreds of sets with noise, whose tire files are guesses: how often do they hold the
// truth? ROLLRIG_FIT_SETS sets the number of sets. A study of minutes, which runs by name alone: from one warm-up, two
// numbers do not reach their rate yet (docs/fit_tire.md).
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <cstdlib>
#include <iostream>

#include "sim/core/parallel.h"
#include "tests/support/fit_study.h"
#include "tests/support/fit_study_guesses.h"

using namespace rollrig;
using measurements::MeasurementSet;

namespace {

int count_sets() {
  const char* wanted = std::getenv("ROLLRIG_FIT_SETS");
  return wanted != nullptr ? std::stoi(wanted) : 300;
}

/// Sets whose noise and guesses differ.
std::vector<estimation::TireFit> fit_sets(const MeasurementSet& truth) {
  std::vector<estimation::TireFit> fits(static_cast<std::size_t>(count_sets()));
  parallel_for(fits.size(), 0, [&](std::size_t i) {
    MeasurementSet measured = tests::guess_numbers(truth, i + 1);
    measured.runs = tests::add_noise(truth, i + 1).runs;
    fits[i] = estimation::fit_tire(measured, {"", false, false, 1});
  });
  return fits;
}

const estimation::Estimate* find_if_fitted(const estimation::TireFit& fit, const std::string& key) {
  for (const estimation::Estimate& estimate : fit.estimates) {
    if (estimate.key == key) return &estimate;
  }
  return nullptr;
}

/// How often the intervals of one number hold its truth; of those sets that have the number.
struct Coverage {
  int held = 0;
  int sets = 0;
  double width = 0.0;
};

Coverage count_held(const std::vector<estimation::TireFit>& fits, const std::string& key, double truth) {
  Coverage coverage;
  for (const auto& fit : fits) {
    const estimation::Estimate* estimate = find_if_fitted(fit, key);
    if (estimate == nullptr) continue;
    ++coverage.sets;
    if (estimate->lower_95() <= truth && truth <= estimate->upper_95()) ++coverage.held;
    coverage.width += estimate->upper_95() - estimate->lower_95();
  }
  coverage.width /= coverage.sets;
  return coverage;
}

/// Of all intervals 93 to 97 % hold the truth, and no number's are rejected by a binomial test.
void check_fit_coverage(const MeasurementSet& truth_of) {
  const std::vector<estimation::TireFit> fits = fit_sets(truth_of);
  Coverage all;
  for (const estimation::Estimate& estimate : fits[0].estimates) {
    const double truth = tests::find_truth(truth_of, estimate.key);
    const Coverage one = count_held(fits, estimate.key, truth);
    std::cout << fmt::format("{:<42}{} truth {:>10.5g}  interval {:>10.4g} wide ({:.1f} %)  covered {} of {}\n",
                             estimate.key, estimate.nuisance ? " *" : "  ", truth, one.width,
                             100.0 * one.width / std::abs(truth), one.held, one.sets);
    INFO(estimate.key << " covered " << one.held << " of " << one.sets);
    CHECK_FALSE(tests::is_rejected(one.held, one.sets, 0.95, 0.01));
    all.held += one.held;
    all.sets += one.sets;
  }
  const double share = static_cast<double>(all.held) / all.sets;
  std::cout << fmt::format("all: {} of {}, {:.1f} %\n", all.held, all.sets, 100.0 * share);
  CHECK(share > 0.93);
  CHECK(share < 0.97);
}

}  // namespace

TEST_CASE("95 % intervals cover at their rate, for each parameter", "[.study]") {
  MeasurementSet truth = tests::make_warm_up_set("a50", "source_with_gas");
  tests::forget_uncertainties(truth);
  check_fit_coverage(truth);
}

TEST_CASE("95 % intervals cover where the files' own numbers are off by their uncertainty", "[.study]") {
  MeasurementSet truth = tests::make_warm_up_set("a50", "source_with_gas", "quasi_static");
  tests::forget_uncertainties(truth);
  tests::thin(truth, 4);
  auto& sd = truth.tire.standard_uncertainties.thermal;
  sd.heat_capacity_J_per_K = 0.05 * truth.tire.values.thermal.heat_capacity_J_per_K;
  sd.gas_heat_capacity_J_per_K = 0.1 * truth.tire.values.thermal.gas_heat_capacity_J_per_K;
  truth.rig->parasitic_uncertainties.c0_N = 0.07 * truth.rig->parasitic.c0_N;
  truth.rig->parasitic_uncertainties.c1_N_s_per_m = 0.07 * truth.rig->parasitic.c1_N_s_per_m;
  check_fit_coverage(truth);
}

TEST_CASE("95 % intervals cover for each number of a bounded law", "[.study]") {
  models::TireFile tire = tests::read_asset_tire("c1_205_55r16");
  tests::put_own(tire, "speed_rise_of_fall", 0.3);
  MeasurementSet truth = tests::make_warm_up_set(
      tire, {{60.0, 4100.0, 230.0, "slow"}, {100.0, 4100.0, 230.0, "fast"}, {100.0, 5600.0, 230.0, "loaded"}},
      "source_with_gas", "quasi_static");
  tests::forget_uncertainties(truth);
  check_fit_coverage(truth);
}

TEST_CASE("95 % intervals cover from one warm-up of a tire with the combined law", "[.study]") {
  MeasurementSet truth = tests::make_warm_up_set(tests::read_combined_tire(), {{100.0}}, "source", "quasi_static");
  tests::forget_uncertainties(truth);
  tests::thin(truth, 4);
  check_fit_coverage(truth);
}

TEST_CASE("95 % intervals cover from one warm-up of a bounded tire without uncertainties", "[.study]") {
  MeasurementSet truth = tests::make_warm_up_set(tests::read_asset_tire("c1_205_55r16"), {{100.0, 4100.0, 230.0}},
                                                 "source", "quasi_static");
  tests::forget_uncertainties(truth);
  tests::thin(truth, 4);
  check_fit_coverage(truth);
}

TEST_CASE("95 % intervals cover from one warm-up of a shipped tire, within what its file says", "[.study]") {
  MeasurementSet truth =
      tests::make_warm_up_set(tests::read_asset_tire("a50"), {{100.0, 5000.0, 250.0}}, "source", "quasi_static");
  REQUIRE_FALSE(truth.tire.correlation.numbers.empty());
  tests::thin(truth, 4);
  check_fit_coverage(truth);
}
