#include "estimation/tire_fit/fit_tire.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "models/tire/tire_model.h"
#include "sim/core/error.h"
#include "tests/estimation/estimates.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using estimation::fit_tire;
using estimation::TireFit;
using tests::count_asked_for;
using tests::estimate_of;
using tests::find_truth;

TEST_CASE("without noise the fit finds the truth, H as well, from multibody data", "[fast]") {
  for (const char* tire : {"a40", "a60"}) {
    const auto set = tests::make_warm_up_set(tire, "source_with_gas");
    const TireFit fit = fit_tire(set, {});
    REQUIRE(count_asked_for(fit) == 7);
    for (const auto& estimate : fit.estimates) {
      INFO(tire << " " << estimate.key);
      // The load cylinder takes 0.06 s that the fit's model does not have; it shows in H.
      CHECK(std::abs(estimate.value - find_truth(set, estimate.key)) < 0.15 * estimate.sd);
    }
    CHECK(fit.chi2_per_sample < 1e-5);
  }
}

TEST_CASE("the two-step regression starts near", "[fast]") {
  const auto set = tests::make_warm_up_set("a50", "source_with_gas");
  const auto start = estimation::estimate_in_two_steps(set);
  REQUIRE(start.speeds.size() == 2);
  CHECK(start.speeds[0].speed_m_s == Approx(80.0 / 3.6));
  CHECK(start.A0_N == Approx(find_truth(set, "tire.rolling_resistance.A0_N")).epsilon(0.03));
  CHECK(start.speed_conductance_W_s_per_m_K == Approx(1.4).epsilon(0.05));
  REQUIRE(start.H_gas_W_per_K.has_value());
  CHECK(*start.H_gas_W_per_K == Approx(4.0).epsilon(0.1));
}

TEST_CASE("the fitted tire file holds the estimates with their uncertainties, z and f under the rig", "[fast]") {
  const auto set = tests::add_noise(tests::make_warm_up_set("a50", "source"), 11);
  const TireFit fit = fit_tire(set, {});
  const auto back = models::read_tire(parse_config(models::write_tire(fit.tire, fit.notes), "fitted"));
  CHECK(back.values.rolling_resistance.A0_N == Approx(fit.estimates[0].value));
  CHECK(back.standard_uncertainties.rolling_resistance.A0_N == Approx(fit.estimates[0].sd));
  CHECK(*back.rig_thermal.at("drum_2m").rest_conductance_W_per_K == Approx(fit.estimates[4].value));
  CHECK(*back.rig_thermal.at("drum_2m").speed_conductance_sd_W_s_per_m_K == Approx(fit.estimates[5].sd));
  CHECK(back.values.thermal.rest_conductance_W_per_K ==
        set.tire.values.thermal.rest_conductance_W_per_K);  // other rigs keep theirs
}

TEST_CASE("the fitted tire file holds the correlations of the estimates", "[fast]") {
  const auto set = tests::add_noise(tests::make_warm_up_set("a50", "source"), 11);
  const TireFit fit = fit_tire(set, {});
  const auto back = models::read_tire(parse_config(models::write_tire(fit.tire, fit.notes), "fitted"));
  const models::TireCorrelation& written = back.correlation;
  REQUIRE(written.numbers.size() == fit.estimates.size());
  REQUIRE(count_asked_for(fit) == 6);
  CHECK(written.numbers[0] == "rolling_resistance.A0_N");
  CHECK(written.numbers[5] == "thermal.rig.drum_2m.conductance_per_speed_W_s_per_m_K");
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) CHECK(written.matrix[i][j] == Approx(fit.correlation[i][j]));
  }
  CHECK(written.matrix[0][1] < -0.5);  // A0 + A1 v is known better than either
  // A fit that starts from this file does not take its own result for prior knowledge of what it asks for.
  auto again = set;
  again.tire = back;
  CHECK(fit_tire(again, {}).estimates[0].sd == Approx(fit.estimates[0].sd).epsilon(1e-3));
}

TEST_CASE("what the files give with an uncertainty moves within it and widens the intervals", "[fast]") {
  auto set = tests::add_noise(tests::make_warm_up_set("a50", "source"), 11);
  set.tire.standard_uncertainties.thermal.heat_capacity_J_per_K = 1.0;
  const TireFit exact = fit_tire(set, {});
  set.tire.standard_uncertainties.thermal.heat_capacity_J_per_K = 900.0;
  set.rig->parasitic_uncertainties.c0_N = 0.3;
  const TireFit loose = fit_tire(set, {});
  REQUIRE(loose.estimates.size() == exact.estimates.size() + 1);
  CHECK(loose.estimates.back().nuisance);
  for (std::size_t i = 0; i < exact.estimates.size(); ++i) {
    INFO(exact.estimates[i].key);
    CHECK(loose.estimates[i].sd > 0.999 * exact.estimates[i].sd);
  }
}

namespace {

/// A set free of noise whose sensors are said to be `factor` times as noisy as they are, with uncertain heat
/// capacities.
measurements::MeasurementSet make_uncertain_set(double factor, double heat_capacity_sd, double gas_heat_capacity_sd) {
  auto set = tests::make_warm_up_set("a50", "source", "quasi_static");
  for (auto& [channel, sensor] : set.sensors) {
    sensor.drift_sd *= factor;
    sensor.noise_sd *= factor;
  }
  set.tire.standard_uncertainties.thermal.heat_capacity_J_per_K = heat_capacity_sd;
  set.tire.standard_uncertainties.thermal.gas_heat_capacity_J_per_K = gas_heat_capacity_sd;
  return set;
}

void add_other_uncertainties(measurements::MeasurementSet& set) {
  set.tire.standard_uncertainties.thermal.H_gas_W_per_K = 0.6;
  set.tire.standard_uncertainties.rolling_resistance.pressure_exponent = 0.02;
  set.rig->parasitic_uncertainties.c0_N = 0.4;
  set.rig->parasitic_uncertainties.c1_N_s_per_m = 0.01;
  set.rig->parasitic_uncertainties.c2_N_s2_per_m2 = 0.0003;
}

double find_sd(const TireFit& fit, const std::string& key) { return estimate_of(fit, key).sd; }

const char* const kHeatCapacity = "tire.thermal.heat_capacity_J_per_K";
const char* const kGasHeatCapacity = "tire.thermal.gas_heat_capacity_J_per_K";

}  // namespace

TEST_CASE("where the data say little, the uncertainty of a heat capacity stays the file's", "[fast]") {
  const TireFit fit = fit_tire(make_uncertain_set(300.0, 1250.0, 9.5), {});
  CHECK(find_sd(fit, kHeatCapacity) == Approx(1250.0).epsilon(0.05));
  CHECK(find_sd(fit, kGasHeatCapacity) == Approx(9.5).epsilon(0.05));
  // Of the gas's they say little even as they are, however many other numbers are uncertain.
  auto set = make_uncertain_set(1.0, 1250.0, 9.5);
  add_other_uncertainties(set);
  const double sd = find_sd(fit_tire(set, {}), kGasHeatCapacity);
  CHECK(sd > 0.7 * 9.5);
  CHECK(sd < 9.5);
}

TEST_CASE("what the file and what the data say of a heat capacity add up", "[fast]") {
  // Independent information adds: 1/sd^2 less the prior's is what the data say, whatever the prior.
  const auto say = [](double prior_sd) {
    auto set = make_uncertain_set(1.0, prior_sd, 9.5);
    add_other_uncertainties(set);
    const double sd = find_sd(fit_tire(set, {}), kHeatCapacity);
    CHECK(sd < prior_sd);
    return 1.0 / (sd * sd) - 1.0 / (prior_sd * prior_sd);
  };
  const double of_data = say(100.0);
  CHECK(of_data > 0.0);
  CHECK(say(400.0) == Approx(of_data).epsilon(0.02));
}

TEST_CASE("data that move one number move those that the tire's file correlates with it", "[fast]") {
  // The data see the tire's heat capacity, and hardly the gas's.
  constexpr double kSd = 1250.0, kGasSd = 9.5;
  auto set = make_uncertain_set(1.0, kSd, kGasSd);
  add_other_uncertainties(set);
  const double truth = set.tire.values.thermal.heat_capacity_J_per_K;
  const double gas_of_file = set.tire.values.thermal.gas_heat_capacity_J_per_K;
  set.tire.values.thermal.heat_capacity_J_per_K = truth - 2.0 * kSd;
  const auto fit = [&](double correlation) {
    set.tire.correlation = {{"thermal.heat_capacity_J_per_K", "thermal.gas_heat_capacity_J_per_K"},
                            {{1.0, correlation}, {correlation, 1.0}}};
    return fit_tire(set, {});
  };
  const TireFit apart = fit(0.0);
  const TireFit together = fit(0.9);
  const double moved = estimate_of(together, kHeatCapacity).value - (truth - 2.0 * kSd);
  CHECK(moved > 1.5 * kSd);
  CHECK(std::abs(estimate_of(apart, kGasHeatCapacity).value - gas_of_file) < 0.4 * kGasSd);
  CHECK(estimate_of(together, kGasHeatCapacity).value - gas_of_file ==
        Approx(0.9 * moved * kGasSd / kSd).margin(0.4 * kGasSd));
  CHECK(find_sd(together, kGasHeatCapacity) < 0.8 * find_sd(apart, kGasHeatCapacity));
  const std::vector<std::string>& numbers = together.tire.correlation.numbers;
  CHECK(std::count(numbers.begin(), numbers.end(), "thermal.gas_heat_capacity_J_per_K") == 1);
}

TEST_CASE("the more is uncertain, the less is known of everything", "[fast]") {
  auto set = make_uncertain_set(1.0, 1250.0, 9.5);
  set.tire.standard_uncertainties.thermal.H_gas_W_per_K = 0.01;
  set.tire.standard_uncertainties.rolling_resistance.pressure_exponent = 1e-4;
  const TireFit few = fit_tire(set, {});
  add_other_uncertainties(set);
  const TireFit many = fit_tire(set, {});
  REQUIRE(many.estimates.size() == few.estimates.size() + 3);
  for (const auto& estimate : few.estimates) {
    INFO(estimate.key);
    CHECK(find_sd(many, estimate.key) > 0.9999 * estimate.sd);
  }
}

TEST_CASE("the answer is the same to the bit from one or two threads", "[fast]") {
  const auto set = tests::add_noise(tests::make_warm_up_set("a50", "source"), 3);
  const TireFit one = fit_tire(set, {"", false, false, 1});
  const TireFit two = fit_tire(set, {"", false, false, 2});
  for (std::size_t i = 0; i < one.estimates.size(); ++i) {
    CHECK(one.estimates[i].value == two.estimates[i].value);
    CHECK(one.estimates[i].sd == two.estimates[i].sd);
  }
}

TEST_CASE("missing samples are left out, and fewer samples widen the intervals", "[fast]") {
  const auto set = tests::add_noise(tests::make_warm_up_set("a50", "source"), 7);
  auto gappy = set;
  for (auto& run : gappy.runs) {
    for (std::size_t i = 0; i < run.time_s.size(); ++i) {
      if (i % 4 != 0) run.columns["liner_temperature_degC"][i] = std::nan("");
      if (i % 5 == 0) run.columns["drum_torque_Nm"][i] = std::nan("");
    }
  }
  const TireFit full = fit_tire(set, {});
  const TireFit fit = fit_tire(gappy, {});
  for (std::size_t i = 0; i < fit.estimates.size(); ++i) {
    INFO(fit.estimates[i].key);
    CHECK(std::abs(fit.estimates[i].value - full.estimates[i].value) < 3.0 * fit.estimates[i].sd);
    // A number that the data do not decide keeps its prior, but for where the fit is linearized.
    const auto& prior = full.estimates[i].prior;
    const bool is_decided = !prior.has_value() || full.estimates[i].sd < 0.5 * prior->sd;
    CHECK(fit.estimates[i].sd > (is_decided ? 1.0 : 0.999) * full.estimates[i].sd);
  }
}

TEST_CASE("a map over load is fitted where there are several loads at two speeds", "[fast]") {
  measurements::MeasurementSet set = tests::make_warm_up_set("a50", "source", "quasi_static");
  const auto add_loads = [&](const char* speed) {
    const auto spec = tests::make_spec("load_sweep", tests::combined_tire_path(),
                                       {"loads_N=[7000, 4000]", "measurement_min=5", "settle_min=0",
                                        std::string("speed_km_h=") + speed, "effects.load_exponent.exponent=1.1"},
                                       "quasi_static");
    const auto outcome = scenarios::run_scenario(spec, {});
    measurements::MeasuredRun run = set.runs[0];
    run.id = std::string("loads-") + speed;
    run.time_s.clear();
    run.columns.clear();
    const double start_s = outcome.set_runs[0].start_s;
    for (std::size_t row = 0; row < outcome.recording.row_count(); ++row) {
      if (outcome.recording.time_s[row] < start_s - 1e-6) continue;
      run.time_s.push_back(outcome.recording.time_s[row] - start_s);
      for (const char* column : {"speed_km_h", "load_N", "ambient_degC", "drum_torque_Nm", "liner_temperature_degC",
                                 "cavity_pressure_kPa"}) {
        run.columns[column].push_back(outcome.recording.channel(column)[row]);
      }
    }
    set.runs.push_back(run);
  };
  set.runs.clear();
  measurements::MeasurementSet base = tests::make_warm_up_set("a50", "source", "quasi_static");
  set.runs.push_back(base.runs[0]);
  add_loads("80");
  add_loads("120");
  set.runs.erase(set.runs.begin());
  const TireFit fit = fit_tire(set, {"", true, false, 2});
  REQUIRE(fit.tire.values.load_map.size() == 2);
  const auto& low = fit.tire.values.load_map[0];
  const auto& high = fit.tire.values.load_map[1];
  CHECK(low.load_N == Approx(4000.0));
  CHECK(high.load_N == Approx(7000.0));
  // the data followed Fz^1.1
  const double v = 100.0 / 3.6;
  const double ratio = (high.A0_N + high.A1_N_s_per_m * v) / (low.A0_N + low.A1_N_s_per_m * v);
  CHECK(std::log(ratio) / std::log(7000.0 / 4000.0) == Approx(1.1).margin(0.01));
}

TEST_CASE("a tire whose law has none of the numbers that are fitted is refused", "[fast]") {
  auto set = tests::make_warm_up_set("a50", "source", "quasi_static");
  set.tire.values.own.model = &models::find_tire_model("constant_rrc");
  CHECK_THROWS_AS(fit_tire(set, {}), InputError);
}

TEST_CASE("no speed with loss and temperature is refused, and a model that lacks something is warned of", "[fast]") {
  auto set = tests::add_noise(tests::make_warm_up_set("a50", "source"), 5);
  auto no_speed = set;
  for (auto& run : no_speed.runs) run.columns.erase(models::quantities::kLinerTemperature);
  CHECK_THROWS_WITH(fit_tire(no_speed, {}), Catch::Contains("no speed with loss and temperature"));
  for (auto& run : set.runs) {
    for (std::size_t i = 0; i < run.time_s.size(); ++i) {
      run.columns["drum_torque_Nm"][i] += 5.0 * std::sin(run.time_s[i] / 100.0);  // nothing of a tire
    }
  }
  const std::vector<std::string> warnings = fit_tire(set, {}).warnings;
  REQUIRE_FALSE(warnings.empty());
  CHECK_THAT(warnings.back(), Catch::Contains("the model lacks something"));
}
