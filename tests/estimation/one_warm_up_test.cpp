// Fits of a tire from one warm-up, and from a tire file whose numbers are guesses.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/tire_fit/fit_tire.h"
#include "models/tire/tire_model.h"
#include "sim/core/error.h"
#include "tests/estimation/estimates.h"
#include "tests/support/fit_study.h"
#include "tests/support/fit_study_guesses.h"

using namespace rollrig;
using estimation::Estimate;
using estimation::fit_tire;
using estimation::TireFit;
using measurements::MeasurementSet;
using tests::estimate_of;

namespace {

const char* const kA1 = "tire.rolling_resistance.A1_N_s_per_m";
const char* const kB1 = "tire.rolling_resistance.B1_s_per_m_degC";
const char* const kF = "tire.thermal.f_W_s_per_m_K";
const char* const kHeatCapacityOfTire = "tire.thermal.heat_capacity_J_per_K";

/// One warm-up with noise of a tire without uncertainties.
MeasurementSet make_one_warm_up(const models::TireFile& tire, std::uint64_t seed = 3) {
  MeasurementSet set = tests::make_warm_up_set(tire, {{100.0, 5000.0, 260.0}}, "source", "quasi_static");
  tests::forget_uncertainties(set);
  return tests::add_noise(set, seed);
}

/// Two warm-ups with noise of a tire with the combined law.
MeasurementSet make_two_warm_ups(std::uint64_t seed) {
  MeasurementSet set = tests::make_warm_up_set("a50", "source", "quasi_static");
  tests::forget_uncertainties(set);
  return tests::add_noise(set, seed);
}

std::size_t index_of_key(const TireFit& fit, const std::string& key) {
  for (std::size_t i = 0; i < fit.estimates.size(); ++i) {
    if (fit.estimates[i].key == key) return i;
  }
  throw std::invalid_argument(key);
}

void check_stays_at_prior(const TireFit& fit, const std::string& key) {
  INFO(key);
  const Estimate& estimate = estimate_of(fit, key);
  REQUIRE(estimate.prior.has_value());
  CHECK(estimate.nuisance);
  // Data that narrow a prior by 1 % move it by 0.14 standard uncertainties as a rule.
  CHECK(std::abs(estimate.value - estimate.prior->value) < 2.0 * 0.14 * estimate.prior->sd);
  CHECK(estimate.sd == Approx(estimate.prior->sd).epsilon(0.01));
}

int count_two_step_warnings(const TireFit& fit) {
  int count = 0;
  for (const std::string& warning : fit.warnings) {
    if (warning.find("two-step") != std::string::npos) ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("from one warm-up the slopes over speed stay at their priors", "[fast]") {
  const TireFit combined = fit_tire(make_one_warm_up(tests::read_combined_tire()), {});
  for (const char* key : {kA1, kB1, kF}) check_stays_at_prior(combined, key);
  const TireFit bounded = fit_tire(make_one_warm_up(tests::read_asset_tire("c1_205_55r16")), {});
  for (const char* key : {"tire.bounded.speed_rise", "tire.bounded.speed_rise_of_fall"}) {
    check_stays_at_prior(bounded, key);
  }
  check_stays_at_prior(bounded, kF);
}

TEST_CASE("the prior of a slope is that of the tire's file, with its correlation", "[fast]") {
  MeasurementSet set = make_one_warm_up(tests::read_combined_tire());
  auto& sd = set.tire.standard_uncertainties.rolling_resistance;
  sd.A1_N_s_per_m = 0.12;
  sd.B1_s_per_m_K = 4e-5;
  set.tire.correlation = {{"rolling_resistance.A1_N_s_per_m", "rolling_resistance.B1_s_per_m_degC"},
                          {{1.0, 0.8}, {0.8, 1.0}}};
  const TireFit fit = fit_tire(set, {});
  CHECK(estimate_of(fit, kA1).sd == Approx(0.12).epsilon(0.01));
  CHECK(estimate_of(fit, kB1).sd == Approx(4e-5).epsilon(0.01));
  CHECK_FALSE(estimate_of(fit, kA1).prior->of_class);
  CHECK(fit.correlation[index_of_key(fit, kA1)][index_of_key(fit, kB1)] == Approx(0.8).margin(0.02));
}

TEST_CASE("one warm-up decides loss, fall, conductance and time constant at its speed", "[fast]") {
  for (const auto& tire : {tests::read_combined_tire(), tests::read_asset_tire("c1_205_55r16")}) {
    INFO(tire.name);
    MeasurementSet set = make_one_warm_up(tire);
    const auto& truth = measurements::make_context(set).tire;
    // The slopes of the file are wrong, by their uncertainty: what the data say at their speed is the same.
    if (tire.values.model().info.follows_speed_lines()) {
      set.tire.values.rolling_resistance.A1_N_s_per_m -= 0.6;
      set.tire.values.rolling_resistance.B1_s_per_m_K += 1e-4;
    } else {
      tests::put_own(set.tire, "speed_rise", 0.25);
    }
    *set.tire.rig_thermal.at("drum_2m").speed_conductance_W_s_per_m_K *= 0.8;
    const TireFit fit = fit_tire(set, {});
    REQUIRE(fit.at_speeds.size() == 1);
    const estimation::AtSpeed& at = fit.at_speeds[0];
    CHECK(3.6 * at.at.speed_m_s == Approx(100.0).epsilon(0.01));
    const double conductance_W_per_K = models::calc_cooling_W_per_K(truth.thermal, at.at.speed_m_s);
    CHECK(std::abs(at.conductance_W_per_K.value - conductance_W_per_K) < 3.5 * at.conductance_W_per_K.sd);
    const double tau_s = truth.thermal.heat_capacity_J_per_K / conductance_W_per_K;
    CHECK(std::abs(at.time_constant_s.value - tau_s) < 3.5 * at.time_constant_s.sd);
    CHECK(at.loss_N.sd < 0.02 * at.loss_N.value);
    CHECK(at.fall_per_K.sd < 0.15 * at.fall_per_K.value);
    CHECK(at.time_constant_s.sd < 0.1 * at.time_constant_s.value);
  }
}

TEST_CASE("how well a slope is known changes nothing of what one warm-up decides", "[fast]") {
  MeasurementSet set = make_one_warm_up(tests::read_combined_tire());
  set.tire.standard_uncertainties.rolling_resistance.A1_N_s_per_m = 0.01;
  const TireFit known = fit_tire(set, {});
  set.tire.standard_uncertainties.rolling_resistance.A1_N_s_per_m = 0.5;
  const TireFit unknown = fit_tire(set, {});
  const std::string A0 = "tire.rolling_resistance.A0_N";
  CHECK(estimate_of(unknown, A0).sd > 4.0 * estimate_of(known, A0).sd);
  CHECK(unknown.at_speeds[0].loss_N.sd == Approx(known.at_speeds[0].loss_N.sd).epsilon(0.01));
  CHECK(unknown.at_speeds[0].loss_N.value == Approx(known.at_speeds[0].loss_N.value).epsilon(1e-3));
}

TEST_CASE("the guess of a heat capacity does not decide what a fit says", "[fast]") {
  MeasurementSet set = make_two_warm_ups(5);
  const double truth = set.tire.values.thermal.heat_capacity_J_per_K;
  const TireFit right = fit_tire(set, {});
  for (const double guess : {14300.0, 30000.0}) {
    set.tire.values.thermal.heat_capacity_J_per_K = guess;
    const TireFit fit = fit_tire(set, {});
    INFO(guess);
    CHECK(estimate_of(fit, kHeatCapacityOfTire).prior->of_class);
    CHECK(std::abs(estimate_of(fit, kHeatCapacityOfTire).value - truth) <
          4.0 * estimate_of(fit, kHeatCapacityOfTire).sd);
    const Estimate& B0 = estimate_of(fit, "tire.rolling_resistance.B0_per_degC");
    CHECK(std::abs(B0.value - estimate_of(right, B0.key).value) < 0.3 * B0.sd);
  }
}

TEST_CASE("a fit finds its way from a heat capacity that is guessed far off", "[fast]") {
  MeasurementSet set = make_one_warm_up(tests::read_asset_tire("c1_205_55r16"));
  const double truth = set.tire.values.thermal.heat_capacity_J_per_K;
  for (const double share : {0.03, 3.0}) {
    set.tire.values.thermal.heat_capacity_J_per_K = share * truth;
    INFO(share);
    const Estimate found = estimate_of(fit_tire(set, {}), kHeatCapacityOfTire);
    CHECK(std::abs(found.value - truth) < 4.0 * found.sd);
    CHECK(found.sd < 0.1 * truth);
  }
}

TEST_CASE("a fit that holds a wrong heat capacity is contradicted by the two-step regression", "[fast]") {
  MeasurementSet set = make_two_warm_ups(5);
  CHECK(count_two_step_warnings(fit_tire(set, {})) == 0);
  set.tire.values.thermal.heat_capacity_J_per_K = 14300.0;
  set.tire.standard_uncertainties.thermal.heat_capacity_J_per_K = 100.0;
  const TireFit held = fit_tire(set, {});
  CHECK(count_two_step_warnings(held) > 0);
  CHECK_THAT(held.warnings[0], Catch::Contains("two-step regression and the fit differ"));
}

TEST_CASE("the two-step regression does not contradict fits without a mistake", "[slow]") {
  int warnings = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    MeasurementSet set = make_two_warm_ups(seed);
    tests::thin(set, 4);
    warnings += count_two_step_warnings(fit_tire(set, {}));
  }
  CHECK(warnings <= 1);
}

TEST_CASE("a number that the data push over its range is warned of, and its interval ends there", "[fast]") {
  MeasurementSet set = make_one_warm_up(tests::read_combined_tire());
  *set.tire.rig_thermal.at("drum_2m").speed_conductance_W_s_per_m_K = 3.0;  // alone more than all of the cooling
  set.tire.rig_thermal.at("drum_2m").speed_conductance_sd_W_s_per_m_K = 0.2;
  const TireFit fit = fit_tire(set, {});
  const Estimate& rest = estimate_of(fit, "tire.thermal.z_W_per_K");
  CHECK(rest.value == Approx(0.0).margin(1e-3));
  CHECK(rest.lower_95() == 0.0);
  REQUIRE_FALSE(fit.warnings.empty());
  CHECK_THAT(fit.warnings[0], Catch::Contains("conductance_at_rest") && Catch::Contains("limit of its range"));
}

TEST_CASE("a map over load is refused of one speed", "[fast]") {
  CHECK_THROWS_WITH(fit_tire(make_one_warm_up(tests::read_combined_tire()), {"", true, false, 1}),
                    Catch::Contains("--load-map") && Catch::Contains("two speeds"));
}
