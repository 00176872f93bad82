// The shift of two clocks is found within its stated uncertainty, and not found where nothing tells it.
#include "measurements/logs/clock.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "sim/core/random.h"
#include "tests/measurements/logs/made_up_logs.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using namespace rollrig::tests;

namespace {

struct Study {
  int held = 0;  // by the 95 % interval of the shift
  int rates_held = 0;
  double mean_sd_s = 0.0;
  double worst_s = 0.0;
};

/// Clocks drawn anew for each seed.
Study study_clocks(LogsPlan plan, int seeds, double lag_sd_s) {
  Study study;
  for (int seed = 1; seed <= seeds; ++seed) {
    RandomStream random(static_cast<std::uint64_t>(seed), "clock");
    plan.shift_s = 50.0 * (2.0 * random.uniform() - 1.0);
    plan.rate = 100e-6 * random.normal();
    MadeUpLogs made = make_up_logs(plan, static_cast<std::uint64_t>(seed));
    made.mapping.clock.response_lag_sd_s = lag_sd_s;
    const measurements::ClockEstimate found = measurements::estimate_clock(made.torque, made.tire, made.mapping);
    const double error_s = found.clock.shift_s - true_shift_s(plan, found.clock.reference_s);
    study.held += std::abs(error_s) <= 1.959964 * found.calc_shift_sd_s() ? 1 : 0;
    study.rates_held += std::abs(found.clock.rate - plan.rate) <= 1.959964 * found.rate_sd ? 1 : 0;
    study.mean_sd_s += found.calc_shift_sd_s() / seeds;
    study.worst_s = std::max(study.worst_s, std::abs(error_s));
  }
  return study;
}

}  // namespace

TEST_CASE("a shift from the speed that both logs have is held by its interval", "[weekly]") {
  LogsPlan plan;
  plan.tire_has_speed = true;
  const int seeds = 200;
  const Study study = study_clocks(plan, seeds, 0.0);
  WARN("speed in both: shift held in " << study.held << ", rate in " << study.rates_held << " of " << seeds
                                       << ", mean sd " << study.mean_sd_s << " s, worst error " << study.worst_s);
  CHECK_FALSE(is_rejected(study.held, seeds, 0.95, 0.01));
  CHECK_FALSE(is_rejected(study.rates_held, seeds, 0.95, 0.01));
  CHECK(study.mean_sd_s < 0.5);  // half a row
}

TEST_CASE("a shift from the tire's response alone is held by its interval", "[slow]") {
  const int seeds = tests::count_seeds(100);
  const Study study = study_clocks({}, seeds, 0.0);
  WARN("response: shift held in " << study.held << ", rate in " << study.rates_held << " of " << seeds << ", mean sd "
                                  << study.mean_sd_s << " s, worst error " << study.worst_s);
  CHECK_FALSE(is_rejected(study.held, seeds, 0.95, 0.01));
  CHECK_FALSE(is_rejected(study.rates_held, seeds, 0.95, 0.01));
  CHECK(study.mean_sd_s < 3.0);
}

TEST_CASE("where only the pressure is logged, the shift has to be given", "[fast]") {
  LogsPlan plan;
  plan.shift_s = 17.0;
  MadeUpLogs made = make_up_logs(plan, 21);
  made.tire.columns.erase(models::quantities::kLinerTemperature);
  made.tire.columns.erase(models::quantities::kGasTemperature);
  CHECK_THROWS_AS(measurements::estimate_clock(made.torque, made.tire, made.mapping), InputError);
  made.mapping.clock.shift_s = 16.0;
  made.mapping.clock.shift_sd_s = 2.0;
  const measurements::ClockEstimate given = measurements::estimate_clock(made.torque, made.tire, made.mapping);
  CHECK(given.method == "given");
  CHECK(given.clock.shift_s == 16.0);
}

TEST_CASE("a response carries the uncertainty of its lag, a common channel does not", "[slow]") {
  LogsPlan plan;
  plan.shift_s = 20.0;
  const MadeUpLogs response = make_up_logs(plan, 7);
  const measurements::ClockEstimate by_response =
      measurements::estimate_clock(response.torque, response.tire, response.mapping);
  CHECK(by_response.method == "response");
  CHECK(by_response.calc_shift_sd_s() > response.mapping.clock.response_lag_sd_s);
  plan.tire_has_speed = true;
  const MadeUpLogs common = make_up_logs(plan, 7);
  const measurements::ClockEstimate by_speed = measurements::estimate_clock(common.torque, common.tire, common.mapping);
  CHECK(by_speed.method == "common");
  CHECK(by_speed.lag_sd_s == 0.0);
  CHECK(std::abs(by_speed.clock.shift_s - 20.0) < 0.5);
}

TEST_CASE("a clock that runs at a wrong rate is found where the logs show it", "[slow]") {
  LogsPlan plan;
  plan.tire_has_speed = true;
  plan.shift_s = -10.0;
  plan.rate = 2e-3;
  MadeUpLogs made = make_up_logs(plan, 3);
  made.mapping.clock.rate_sd = 1e-3;
  const measurements::ClockEstimate found = measurements::estimate_clock(made.torque, made.tire, made.mapping);
  CHECK(found.rate_is_decided);
  CHECK(std::abs(found.clock.rate - plan.rate) < 3.0 * found.rate_sd);
}

TEST_CASE("more noise, wider uncertainty", "[slow]") {
  LogsPlan plan;
  const auto find_sd = [&plan](double noise) {
    plan.noise = noise;
    const MadeUpLogs made = make_up_logs(plan, 5);
    return measurements::estimate_clock(made.torque, made.tire, made.mapping).statistical_sd_s;
  };
  CHECK(find_sd(2.0) > 1.3 * find_sd(0.5));
}

TEST_CASE("logs in which nothing happens do not tell their clocks", "[slow]") {
  LogsPlan plan;
  plan.changes = false;
  for (const bool speed : {false, true}) {
    plan.tire_has_speed = speed;
    MadeUpLogs made = make_up_logs(plan, 11);
    CHECK_THROWS_AS(measurements::estimate_clock(made.torque, made.tire, made.mapping), InputError);
    made.mapping.clock.shift_s = 4.0;
    made.mapping.clock.shift_sd_s = 2.0;
    const measurements::ClockEstimate found = measurements::estimate_clock(made.torque, made.tire, made.mapping);
    CHECK(found.method == "given");
    CHECK(found.clock.shift_s == 4.0);
    CHECK(found.calc_shift_sd_s() == 2.0);
  }
}

TEST_CASE("a shift outside the search is not forced into it", "[slow]") {
  LogsPlan plan;
  plan.tire_has_speed = true;
  plan.shift_s = 200.0;  // the search goes to 60 s
  const MadeUpLogs made = make_up_logs(plan, 2);
  CHECK_THROWS_AS(measurements::estimate_clock(made.torque, made.tire, made.mapping), InputError);
}
