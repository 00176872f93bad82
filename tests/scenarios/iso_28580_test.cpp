#include <catch2/catch.hpp>
#include <cmath>

#include "models/tire/own_number.h"
#include "scenarios/common/iso_coefficient.h"
#include "scenarios/common/readings.h"
#include "sim/core/parallel.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using tests::make_spec;
using tests::number;
using tests::run;

TEST_CASE("torque method and force method of the standard agree to the last digit", "[fast]") {
  for (const char* fidelity : {"multibody", "quasi_static"}) {
    const auto outcome = run("iso_28580", "a50", {}, fidelity);
    CHECK(number(outcome, "force_method_N") == Approx(number(outcome, "rolling_resistance_N")).epsilon(1e-6));
  }
}

TEST_CASE("the reported loss lacks the tire's share at skim load", "[fast]") {
  // F_pl comes from the skim phase, so F_r lacks what the tire loses at 200 N: (200 N / F_z)^b, and a little more since
  // the tire has cooled by then.
  std::vector<std::string> tires{"a40", "a50", "a60", "c1_205_55r16"};
  for (const char* tire : {"a40", "a50", "a60"}) tires.push_back(tests::combined_tire_path(tire));
  for (const std::string& name : tires) {
    INFO(name);
    const scenarios::RunSpec spec = make_spec("iso_28580", name, {}, "quasi_static");
    const auto outcome = scenarios::run_scenario(spec, {});
    const auto& recording = outcome.recording;
    const auto tire_loss_N = [&](double start_s, double end_s) {
      return scenarios::calc_window_mean(recording.time_s, recording.channel("rolling_resistance_N"), {start_s, end_s},
                                         1.0);
    };
    const double lacking_N = tire_loss_N(1738.0, 1798.0) - number(outcome, "rolling_resistance_N");
    CHECK(lacking_N == Approx(tire_loss_N(1918.0, 1978.0)).epsilon(1e-6));
    const double share = lacking_N / tire_loss_N(1738.0, 1798.0);
    const double* exponent = models::find_own_number(spec.tire.values.own, "load_exponent");  // (3.5): proportional
    const double at_equal_temperature =
        std::pow(200.0 / number(outcome, "load_N"), exponent != nullptr ? *exponent : 1.0);
    CHECK(share > at_equal_temperature);
    CHECK(share < 1.15 * at_equal_temperature);
    // The coefficient of a file as a true loss has this share again, but for what the tire cools.
    const double of_file = *scenarios::calc_true_iso_rrc(spec.tire, spec.baseline) / spec.tire.iso_28580->rrc;
    CHECK(of_file == Approx(1.0 / (1.0 - share)).epsilon(6e-3));
    CHECK(of_file > 1.0);
  }
}

TEST_CASE("a known coefficient comes back from the whole test", "[fast]") {
  // Of a constant coefficient the skim load takes 200 N: F_r = RRc (Fz - 200 N).
  scenarios::RunSpec spec = make_spec("iso_28580", "a50");
  spec.baseline = models::Baseline::kConstantRrc;
  spec.tire.has_constant = true;
  spec.tire.values.constant.rrc = 0.0075;
  const auto outcome = scenarios::run_scenario(spec, {});
  CHECK(number(outcome, "rolling_resistance_N") == Approx(0.0075 * (6865.0 - 200.0)).epsilon(1e-6));
}

TEST_CASE("corrections: none at 25 degC on the 2 m drum, and each with the right sign", "[fast]") {
  scenarios::RunSpec spec = make_spec("iso_28580", "a50");
  CHECK(scenarios::correct_rrc(0.005, 298.15, spec) == Approx(0.005));
  CHECK(scenarios::correct_rrc(0.005, 303.15, spec) == Approx(0.005 * 1.04));  // 5 K times 0.008
  spec.rig.drum.diameter_m = 1.2;
  CHECK(scenarios::correct_rrc(0.005, 298.15, spec) == Approx(0.005 / 1.0845).epsilon(1e-4));
}

TEST_CASE("a test on a smaller drum, corrected to 2 m, gives the 2 m result but for the tire's warmth", "[fast]") {
  const double on_2m = number(run("iso_28580", "a50"), "rrc_25degC_2m_N_per_kN");
  const double on_1m7 = number(run("iso_28580", "a50", {"rig.drum.diameter_m=1.7"}), "rrc_25degC_2m_N_per_kN");
  CHECK(on_1m7 < on_2m);  // more loss, warmer tire
  CHECK(on_1m7 == Approx(on_2m).epsilon(0.02));
}

TEST_CASE("the temperature correction brings a test at 22 degC near that at 25", "[fast]") {
  const auto standard = run("iso_28580", "a50");
  const auto cool = run("iso_28580", "a50", {"ambient_degC=22"});
  CHECK(number(cool, "rrc_N_per_kN") > number(standard, "rrc_N_per_kN"));
  CHECK(number(cool, "rrc_25degC_2m_N_per_kN") == Approx(number(standard, "rrc_25degC_2m_N_per_kN")).epsilon(0.02));
  CHECK(cool.warnings.empty());
  CHECK(run("iso_28580", "a50", {"ambient_degC=15"}).warnings.size() == 1);
}

TEST_CASE("a tire that comes in cold is soaked before its pressure is set", "[fast]") {
  const auto soaked = run("iso_28580", "a50", {"initial_tire_temperature_degC=5"});
  const auto standard = run("iso_28580", "a50");
  // 3 h leave 0.1 of 20 degC
  CHECK(number(soaked, "rrc_N_per_kN") == Approx(number(standard, "rrc_N_per_kN")).epsilon(3e-4));
  // without the soak the gas would be set cold and warm up: the verified pressure tells
  const auto rushed = run("iso_28580", "a50", {"initial_tire_temperature_degC=5", "soak_h=0"});
  CHECK(number(rushed, "pressure_verified_kPa") > 251.0);
  CHECK(number(soaked, "pressure_verified_kPa") == Approx(250.0).margin(0.1));
}

TEST_CASE("measurement cycles repeat and settle", "[fast]") {
  const auto outcome = run("iso_28580", "a50", {"measurement_cycles=4"});
  REQUIRE(outcome.result["cycles"].size() == 5);
  const auto rrc = [&](std::size_t i) { return outcome.result["cycles"][i]["rrc_N_per_kN"].get<double>(); };
  CHECK(rrc(4) == Approx(rrc(3)).epsilon(2e-4));
  CHECK(number(outcome, "rrc_N_per_kN") == rrc(4));
}

TEST_CASE("halving all tolerances changes RRc by less than 1e-5", "[fast]") {
  scenarios::RunSpec spec = make_spec("iso_28580", "a50");
  const double rrc = number(scenarios::run_scenario(spec, {}), "rrc_N_per_kN");
  spec.tolerance_factor = 0.5;
  CHECK(number(scenarios::run_scenario(spec, {}), "rrc_N_per_kN") == Approx(rrc).epsilon(1e-5));
}

TEST_CASE("halving the grid of the quasi-static run changes RRc by less than 1e-5", "[fast]") {
  scenarios::RunSpec spec = make_spec("iso_28580", "a50", {}, "quasi_static");
  const double rrc = number(scenarios::run_scenario(spec, {}), "rrc_N_per_kN");
  spec.tolerance_factor = 0.5;
  CHECK(number(scenarios::run_scenario(spec, {}), "rrc_N_per_kN") == Approx(rrc).epsilon(1e-5));
}

TEST_CASE("parts that change fast do not make long quasi-static steps unstable", "[fast]") {
  const std::vector<std::vector<std::string>> fast{
      {"tire.thermal.H_gas_W_per_K=30", "warm_up_min=60"},
      {"tire.thermal.gas_heat_capacity_J_per_K=10", "warm_up_min=60"},
      {"speed_km_h=120", "warm_up_min=125", "effects.flat_spot.excess_percent=8", "effects.flat_spot.distance_km=0.1"}};
  for (const std::vector<std::string>& settings : fast) {
    INFO(settings.front());
    scenarios::RunSpec spec = make_spec("warm_up", "a50", settings, "quasi_static");
    const scenarios::Outcome usual = scenarios::run_scenario(spec, {});
    spec.tolerance_factor = 0.1;
    const scenarios::Outcome fine = scenarios::run_scenario(spec, {});
    for (const char* channel : {"rolling_resistance_N", "cavity_pressure_kPa", "liner_temperature_degC"}) {
      const double value = usual.recording.channel(channel).back();
      CHECK(value == Approx(fine.recording.channel(channel).back()).epsilon(1e-5));
    }
  }
}

TEST_CASE("results are bit-identical from one or two threads", "[fast]") {
  const std::vector<std::string> loads{"5000", "5500", "6000", "6500", "7000"};
  const auto sweep = [&](int threads) {
    std::vector<std::vector<double>> torques(loads.size());
    parallel_for(loads.size(), threads, [&](std::size_t i) {
      torques[i] = run("iso_28580", "a50", {"load_N=" + loads[i]}, "multibody").recording.channel("drum_torque_Nm");
    });
    return torques;
  };
  CHECK(sweep(1) == sweep(2));
}

TEST_CASE("with sensors on, the offset cancels and the uncertainty covers what noise does", "[fast]") {
  const double exact = number(run("iso_28580", "a50"), "rrc_N_per_kN");
  scenarios::RunSpec spec = make_spec("iso_28580", "a50", {}, "quasi_static");
  spec.sensors = models::SensorSet{{models::quantities::kDrumTorque, scenarios::find_force_sensor(spec)}};
  int within = 0;
  constexpr int kSeeds = 200;
  double largest_offset_Nm = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    spec.seed = static_cast<std::uint64_t>(seed);
    const auto outcome = scenarios::run_scenario(spec, {});
    largest_offset_Nm = std::max(largest_offset_Nm, std::abs(outcome.recording.channel("drum_torque_Nm")[0]));
    if (std::abs(number(outcome, "rrc_N_per_kN") - exact) < number(outcome, "rrc_uncertainty_N_per_kN")) ++within;
  }
  CHECK(largest_offset_Nm > 0.9);  // offsets of the size of the sensor's were there
  // k = 2 covers 95.4 %: of 200, 191 with a standard deviation of 3
  CHECK(within > 181);
  CHECK(within < 200);
}

TEST_CASE("effects act in a scenario through the run document", "[fast]") {
  const double plain = number(run("iso_28580", "a50"), "rrc_N_per_kN");
  CHECK(number(run("iso_28580", "a50", {"effects.load_exponent.exponent=1.1"}), "rrc_N_per_kN") > plain);
  const auto warm_bearings = run("transient_skim", "a50", {"effects.bearing_warmup.fall_per_K=0.03"});
  const auto none = run("transient_skim", "a50");
  CHECK(number(warm_bearings, "parasitic_fall_N") > 10.0 * number(none, "parasitic_fall_N"));
  // the bearings' warm-up leaves the tire's temperature alone
  CHECK(warm_bearings.recording.channel("liner_temperature_degC") == none.recording.channel("liner_temperature_degC"));
}

TEST_CASE("a tire file states the warm-up and the correction of its class", "[fast]") {
  const std::string truck = "c3_315_80r22_5";
  const auto usual = run("iso_28580", truck);
  CHECK(number(usual, "rrc_N_per_kN") == number(run("iso_28580", truck, {"warm_up_min=180"}), "rrc_N_per_kN"));
  CHECK(usual.warnings.empty());
  // Its slope is that of its class, so that air of 22 and 28 degC give the same corrected coefficient.
  const double cool = number(run("iso_28580", truck, {"ambient_degC=22"}), "rrc_25degC_2m_N_per_kN");
  const double warm = number(run("iso_28580", truck, {"ambient_degC=28"}), "rrc_25degC_2m_N_per_kN");
  CHECK(cool == Approx(warm).epsilon(0.002));
}

TEST_CASE("a warm-up that is too short for the tire is warned of", "[fast]") {
  const auto rushed = run("iso_28580", "c3_315_80r22_5", {"warm_up_min=30"});
  REQUIRE(rushed.warnings.size() == 1);
  CHECK_THAT(rushed.warnings.front(), Catch::Contains("the warm-up (warm_up_min) is too short"));
  // The sentence of the result says so, too.
  CHECK_THAT(rushed.sheet.summary,
             Catch::Contains("The tire has not settled: RRc is") && Catch::EndsWith("above that in steady state."));
  const auto settled = run("iso_28580", "c1_205_55r16");
  CHECK(settled.warnings.empty());
  CHECK_THAT(settled.sheet.summary, !Catch::Contains("settled"));
}

TEST_CASE("the skim test has the load of the tire's class, or the one that the run gives", "[fast]") {
  const auto find_skim_load_N = [](const char* tire, const std::vector<std::string>& settings) {
    scenarios::RunSpec spec = make_spec("iso_28580", tire, settings, "quasi_static");
    const auto outcome = scenarios::run_scenario(spec, {});
    const auto& recording = outcome.recording;
    return scenarios::calc_window_mean(recording.time_s, recording.channel("load_N"),
                                       {number(outcome, "skim_start_s"), number(outcome, "skim_end_s")}, 1.0);
  };
  CHECK(find_skim_load_N("a50", {}) == Approx(200.0));
  CHECK(find_skim_load_N("c2_215_65r16c", {}) == Approx(150.0));
  CHECK(find_skim_load_N("c3_315_80r22_5", {}) == Approx(400.0));
  CHECK(find_skim_load_N("c3_315_80r22_5", {"rig.skim.load_N=300"}) == Approx(300.0));
  CHECK(find_skim_load_N("c3_315_80r22_5", {"rig.skim_by_class.C3_load_N=350"}) == Approx(350.0));
}

TEST_CASE("a higher skim load takes more of the tire's own loss out of the result", "[fast]") {
  // The skim reading has the loss of the tire at skim load: (F_skim/F_z)^b of its loss under load at equal temperature.
  const auto find_rrc = [](const std::string& skim_load_N) {
    return number(run("iso_28580", "c3_315_80r22_5", {"rig.skim.load_N=" + skim_load_N}, "quasi_static"),
                  "rrc_25degC_2m_N_per_kN");
  };
  CHECK(find_rrc("400") < find_rrc("200"));
}
