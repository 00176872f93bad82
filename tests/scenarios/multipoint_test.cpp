// Tests at several loads and pressures give back the law of a tire that has one, and agree with the other scenarios.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/rolling_law/j1269_fit.h"
#include "estimation/rolling_law/j2452_fit.h"
#include "sim/core/error.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using tests::number;
using tests::run;

namespace {

/// Points of a result, with the pressure of a key.
std::vector<estimation::RollingPoint> read_points(const scenarios::Outcome& outcome, const char* pressure_key) {
  std::vector<estimation::RollingPoint> points;
  for (const Json& step : outcome.result["steps"]) {
    points.push_back({step["speed_km_h"].get<double>() / 3.6, step["load_N"].get<double>(),
                      1e3 * step[pressure_key].get<double>(), step["rolling_resistance_N"].get<double>()});
  }
  return points;
}

/// A tire whose loss depends neither on temperature, so that the law of SAE J2452 is its own.
const std::vector<std::string> kIsothermal{"tire.rolling_resistance.B0_per_degC=0",
                                           "tire.rolling_resistance.B1_s_per_m_degC=0"};

}  // namespace

TEST_CASE("a tire with a power law of load and pressure gets its exponents from a stepwise coastdown", "[fast]") {
  std::vector<std::string> settings = kIsothermal;
  settings.insert(settings.end(), {"warm_up_min=5", "soak_h=0.1"});
  const auto outcome = run("sae_j2452", tests::combined_tire_path(), settings);
  REQUIRE(outcome.result["steps"].size() == 24);
  // The skim test takes away what the tire loses at 200 N, so that the force goes with the load above 200 N.
  std::vector<estimation::RollingPoint> points = read_points(outcome, "cavity_pressure_kPa");
  for (estimation::RollingPoint& point : points) point.load_N -= 200.0;
  const estimation::J2452Fit fit = estimation::fit_j2452(points);
  const auto tire = tests::read_combined_tire().values.rolling_resistance;
  CHECK(fit.law.alpha == Approx(-tire.pressure_exponent).margin(2e-3));
  CHECK(fit.law.beta == Approx(1.0).margin(2e-3));
  CHECK(fit.law.b / fit.law.a == Approx(tire.A1_N_s_per_m / tire.A0_N / 3.6).epsilon(0.01));
  // Its loss is linear in speed, but for the skim test's share of 3 to 8 %, at a pressure that has fallen by then.
  CHECK(std::abs(fit.law.c) * 100.0 * 100.0 < 2e-3 * fit.law.a);
  CHECK(fit.statistics.largest_residual < 1e-3);
  // The fit of the scenario is over the pressure that was set.
  const estimation::J2452Fit set = estimation::fit_j2452(read_points(outcome, "pressure_set_kPa"));
  CHECK(number(outcome, "pressure_exponent") == Approx(set.law.alpha).epsilon(1e-6));
  CHECK(number(outcome, "reference_load_N") == Approx(0.7 * number(outcome, "maximum_load_N")));
  CHECK(number(outcome, "reference_pressure_kPa") == Approx(number(outcome, "base_pressure_kPa") + 20.0));
  CHECK(number(outcome, "smerf_N") ==
        Approx(0.55 * number(outcome, "merf_urban_N") + 0.45 * number(outcome, "merf_highway_N")));
}

TEST_CASE("the steps fall from 115 to 15 km/h, each with a skim test at its speed", "[fast]") {
  const auto outcome = run("sae_j2452", "a50", {"warm_up_min=5", "soak_h=0.1"});
  const Json& steps = outcome.result["steps"];
  CHECK(steps[0]["speed_km_h"].get<double>() == Approx(115.0).epsilon(1e-4));
  CHECK(steps[5]["speed_km_h"].get<double>() == Approx(15.0).epsilon(1e-4));
  for (std::size_t i = 1; i < 6; ++i) {
    CHECK(steps[i]["parasitic_N"].get<double>() < steps[i - 1]["parasitic_N"].get<double>());  // falls with speed
    CHECK(steps[i]["skim_start_s"].get<double>() > steps[5]["end_s"].get<double>());
  }
  CHECK(number(outcome, "maximum_load_N") == Approx(6865.0 / 0.8));
  CHECK(number(outcome, "base_pressure_kPa") == Approx(280.0));
}

TEST_CASE("a point of SAE J1269 is a pressure sweep at its load and pressure", "[fast]") {
  const auto outcome = run("sae_j1269", "a50", {"ambient_degC=25"});
  const Json& steps = outcome.result["steps"];
  REQUIRE(steps.size() == 5);
  const double load_N = steps[4]["load_N"].get<double>();
  const auto sweep = run("pressure_sweep", "a50", {"load_N=" + std::to_string(load_N), "pressures_kPa=[300]"});
  CHECK(steps[4]["rolling_resistance_N"].get<double>() ==
        Approx(sweep.result["cycles"][0]["rolling_resistance_N"].get<double>()).epsilon(1e-3));
  // The fifth point is the reference condition itself; the law of four coefficients misses it by little.
  CHECK(number(outcome, "reference_rolling_resistance_N") ==
        Approx(steps[4]["rolling_resistance_N"].get<double>()).epsilon(0.02));
}

TEST_CASE("loads and pressures that are no pairs are refused", "[fast]") {
  const auto refused = [](const std::string& setting, const char* words) {
    CHECK_THROWS_WITH(run("sae_j2452", "a50", {setting}), Catch::Contains(words));
  };
  refused("loads_percent=[30,60]", "2 loads, but 4 pressures");
  refused("pressures_above_base_kPa=[-250,0,0,0]", "pressure of 30 kPa");
  refused("speeds_km_h=[15,115]", "fall from step to step");
  refused("maximum_load_N=900", "counts as skimming");
}
