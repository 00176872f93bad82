// What is driven on each machine.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/validation/generator/generated_set.h"

using namespace rollrig;
using namespace rollrig::tests;

TEST_CASE("dyno campaigns: three to five runs of one to two hours, cycles and constant speeds, rests", "[slow]") {
  std::set<std::string> kinds;
  bool rests = false;
  bool brakes = false;
  bool drives = false;
  for (int seed = 1; seed <= 8; ++seed) {
    const GeneratedSet made = make_generated_set(fmt::format("--kind dyno --effect none --seed {}", seed));
    kinds.insert(made.truth.at("campaign").get<std::string>());
    CHECK(made.set.runs.size() >= 3);
    CHECK(made.set.runs.size() <= 5);
    for (const measurements::MeasuredRun& run : made.set.runs) {
      INFO("seed " << seed << ", " << run.id);
      rests = rests || run.rest_before_s.has_value();
      CHECK(run.time_s.back() >= 3600.0);
      CHECK(run.time_s.back() <= 7300.0);
      const auto& v = run.columns.at("speed_km_h");
      const auto& loss_N = run.columns.at("loss_force_N");
      for (std::size_t row = 0; row < v.size(); ++row) {
        if (v[row] < 20.0 / 3.6 - 1e-9 && !std::isnan(loss_N[row])) FAIL_CHECK("a loss at " << v[row] << " m/s");
      }
      const auto& force_N = run.columns.at("longitudinal_force_N");
      brakes = brakes || *std::min_element(force_N.begin(), force_N.end()) < -300.0;
      drives = drives || *std::max_element(force_N.begin(), force_N.end()) > 500.0;
    }
  }
  CHECK(kinds.size() >= 3);
  CHECK(rests);
  CHECK(brakes);
  CHECK(drives);
}

namespace {

/// Six runs in sessions, with skims, fast running, rests and another pressure, of that many laboratories or more.
void check_tire_campaigns(const std::string& kind, std::size_t laboratories) {
  std::set<std::string> kinds;
  bool rests = false;
  for (int seed = 1; seed <= 12; ++seed) {
    const GeneratedSet made = make_generated_set(fmt::format("--kind {} --effect none --seed {}", kind, seed));
    kinds.insert(made.truth.at("campaign").get<std::string>());
    REQUIRE(made.set.runs.size() == 6);
    std::set<std::string> sessions;
    std::set<double> pressures_Pa;
    double fastest_m_s = 0.0;
    int skims = 0;
    for (const measurements::MeasuredRun& run : made.set.runs) {
      INFO("seed " << seed << ", " << run.id);
      sessions.insert(run.session);
      pressures_Pa.insert(run.cold_pressure_Pa);
      rests = rests || run.rest_before_s.has_value();
      CHECK(run.time_s.back() >= 2000.0);
      CHECK(run.time_s.back() <= 3500.0);
      CHECK(run.time_s.size() == static_cast<std::size_t>(run.time_s.back()) + 1);
      const auto& speed_m_s = run.columns.at("speed_km_h");
      const auto& load_N = run.columns.at("load_N");
      fastest_m_s = std::max(fastest_m_s, *std::max_element(speed_m_s.begin(), speed_m_s.end()));
      for (std::size_t row = 1; row < load_N.size(); ++row) skims += load_N[row] < 300.0 && load_N[row - 1] > 300.0;
    }
    CHECK(sessions.size() >= 2);
    CHECK(sessions.size() <= 3);
    CHECK(pressures_Pa.size() >= 2);
    CHECK(skims >= 3);
    CHECK(fastest_m_s > 33.5);
  }
  CHECK(kinds.size() >= laboratories);
  CHECK(rests);
}

}  // namespace

TEST_CASE("campaigns on drum and belt have six runs in sessions, skims, fast running, another pressure", "[slow]") {
  check_tire_campaigns("drum", 4);
  check_tire_campaigns("flat_belt", 2);
}

TEST_CASE("road trips: cold and warm starts, hills, traction empty where friction brakes act", "[slow]") {
  bool warm = false;
  std::set<models::Baseline> baselines;
  double coldest_K = 400.0;
  double hottest_K = 0.0;
  for (int seed = 1; seed <= 8; ++seed) {
    const GeneratedSet made = make_generated_set(fmt::format("--kind road --effect none --seed {} --noise-free", seed));
    baselines.insert(made.set.baseline);
    REQUIRE(made.set.vehicle.has_value());
    CHECK(made.set.vehicle->uncertainties.mass_kg > 0.0);
    const double mass_kg = made.set.vehicle->body.mass_kg;
    for (const measurements::MeasuredRun& run : made.set.runs) {
      INFO("seed " << seed << ", " << run.id);
      warm = warm || run.started_warm;
      coldest_K = std::min(coldest_K, run.initial_tire_temperature_K);
      hottest_K = std::max(hottest_K, run.initial_tire_temperature_K);
      CHECK(run.time_s.back() > 900.0);
      CHECK(run.time_s.back() < 5400.0);
      int empty = 0;
      const auto& v = run.columns.at("speed_km_h");
      const auto& force_N = run.columns.at("traction_force_N");
      for (std::size_t row = 0; row < v.size(); ++row) {
        empty += std::isnan(force_N[row]) && v[row] > 6.0 ? 1 : 0;
        if (force_N[row] < -1.1 * mass_kg * made.set.vehicle->powertrain.regeneration_limit_m_s2) {
          FAIL_CHECK(force_N[row] << " N is more than the motor brakes");
        }
      }
      CHECK(empty < static_cast<int>(v.size()) / 4);
    }
  }
  CHECK(warm);
  CHECK(baselines.size() == 2);
  CHECK(coldest_K < 283.0);
  CHECK(hottest_K > 293.0);
}
