#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "measurements/sensor_file.h"
#include "scenarios/common/readings.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using tests::make_spec;
using tests::number;
using tests::run;

TEST_CASE("a warm-up reads the law's B off the curve, plus what the rising pressure adds", "[fast]") {
  const auto outcome = run("warm_up", tests::combined_tire_path(), {"load_N=5400", "pressure_kPa=280"});
  const auto tire = tests::read_combined_tire().values.rolling_resistance;
  const double law_B = tire.B0_per_K + tire.B1_s_per_m_K * 80.0 / 3.6;
  // absolute pressure 381.3 kPa over 298 K, gauge about 288 kPa: the pressure adds 0.4 * 1.279 / 288 = 0.0018;
  // that F_r lacks the skim share, which does not fall with it, adds 3 to 4 % of B
  const double expected = 1.035 * (law_B + 0.0018);
  CHECK(number(outcome, "band_B_per_degC") == Approx(expected).epsilon(0.02));
  CHECK(number(outcome, "start_excess_percent") > 0.0);
}

TEST_CASE("a warm-up may end when the tire reaches a temperature", "[fast]") {
  for (const char* fidelity : {"multibody", "quasi_static"}) {
    const auto outcome = run("warm_up", "a50", {"until_tire_degC=36"}, fidelity);
    const double end_s = number(outcome, "warm_up_s");
    CHECK(end_s > 60.0);
    CHECK(end_s < 1800.0);
    const auto& recording = outcome.recording;
    const auto row = static_cast<std::size_t>(
        std::lower_bound(recording.time_s.begin(), recording.time_s.end(), end_s) - recording.time_s.begin());
    CHECK(recording.channel("liner_temperature_degC")[row] == Approx(309.15).margin(0.03));
  }
  const double multibody_s = number(run("warm_up", "a50", {"until_tire_degC=36"}, "multibody"), "warm_up_s");
  CHECK(multibody_s == Approx(number(run("warm_up", "a50", {"until_tire_degC=36"}), "warm_up_s")).margin(0.1));
}

TEST_CASE("a skim test parts into rig and tire", "[fast]") {
  const auto outcome = run("skim", "a50");
  CHECK(number(outcome, "rig_alone_N") + number(outcome, "tire_share_N") ==
        Approx(number(outcome, "parasitic_N")).epsilon(1e-6));
}

TEST_CASE("a skim series extrapolates to the rig alone when the tire's loss goes with load", "[fast]") {
  // On a tire that keeps its temperature the loss is proportional to load, and the straight line is exact.
  const std::vector<std::string> isothermal{"tire.rolling_resistance.B0_per_degC=0",
                                            "tire.rolling_resistance.B1_s_per_m_degC=0",
                                            "tire.rolling_resistance.pressure_exponent=0"};
  const auto exact = run("skim_series", tests::combined_tire_path(), isothermal);
  CHECK(number(exact, "intercept_N") == Approx(number(exact, "rig_alone_N")).epsilon(1e-6));
  std::vector<std::string> with_own_loss = isothermal;
  with_own_loss.push_back("effects.tire_loss_in_skim.force_N=2");
  with_own_loss.push_back("effects.tire_loss_in_skim.load_power=0");
  with_own_loss.push_back("effects.tire_loss_in_skim.fall_per_degC=0");
  const auto own = run("skim_series", tests::combined_tire_path(), with_own_loss);
  CHECK(number(own, "intercept_N") - number(own, "rig_alone_N") == Approx(2.0).margin(0.05));
}

TEST_CASE("a transient skim test without effects falls only by the tire's own share", "[fast]") {
  const auto outcome = run("transient_skim", "a50");
  CHECK(number(outcome, "parasitic_fall_N") > 0.0);
  CHECK(number(outcome, "parasitic_fall_N") < 0.2);
  CHECK(number(outcome, "rolling_resistance_fall_N") > 1.0);
}

TEST_CASE("a pressure sweep weakens the law's exponent by the warmer tire at low pressure", "[fast]") {
  const auto outcome = run("pressure_sweep", "a50");
  CHECK(number(outcome, "steady_state_pressure_exponent") < -0.2);
  CHECK(number(outcome, "steady_state_pressure_exponent") > -0.4);
  REQUIRE(outcome.result["cycles"].size() == 3);
  CHECK(outcome.set_runs.size() == 3);
  for (const auto& run_of_set : outcome.set_runs) {
    CHECK(run_of_set.initial_tire_temperature_K == Approx(298.15).margin(0.15));
  }
  // The soak of 3 h leaves 0.1 K of the cycle before, in 298 K: 0.1 kPa of 400 (absolute).
  CHECK(outcome.set_runs[2].cold_pressure_Pa == Approx(300e3).margin(150.0));
}

TEST_CASE("a speed sweep averages its measurement cycles and rises with speed", "[fast]") {
  const auto outcome = run("speed_sweep", "a50", {"speeds_km_h=[40, 80, 120]"});
  REQUIRE(outcome.result["cycles"].size() == 3);
  CHECK(outcome.result["cycles"][0]["rrc_N_per_kN"] < outcome.result["cycles"][2]["rrc_N_per_kN"]);
  CHECK(outcome.result["cycles"][1]["speed_km_h"].get<double>() == Approx(80.0));
}

TEST_CASE("sweeps report the steady state, as after a very long hold", "[slow]") {
  struct Sweep {
    const char* name;
    const char* values;
  };
  for (const auto& [name, values] :
       {Sweep{"speed_sweep", "speeds_km_h=[30,70,110]"}, Sweep{"load_sweep", "loads_N=[6300,4100]"},
        Sweep{"pressure_sweep", "pressures_kPa=[240,310]"}}) {
    for (const char* tire : {"a40", "a50", "a60"}) {
      INFO(name << ' ' << tire);
      const auto sweep = run(name, tire, {values, "ambient_degC=21"});
      const auto held = run(name, tire, {values, "ambient_degC=21", "settle_min=600"});
      for (const std::string& warning : sweep.warnings) CHECK_THAT(warning, !Catch::Contains("settle_min"));
      REQUIRE(sweep.result["cycles"].size() == held.result["cycles"].size());
      for (std::size_t i = 0; i < held.result["cycles"].size(); ++i) {
        const auto rrc = [&](const scenarios::Outcome& of) {
          return of.result["cycles"][i]["rrc_N_per_kN"].get<double>();
        };
        // where a run begins to warn; ten minutes after a skim test leave up to 3e-2
        CHECK(rrc(sweep) == Approx(rrc(held)).epsilon(2e-3));
      }
    }
  }
}

TEST_CASE("a sweep with the source's short cycles says how far it is from steady state, and warns", "[slow]") {
  for (const char* tire : {"a40", "a50", "a60"}) {
    INFO(tire);
    const auto brief = run("speed_sweep", tire, {"speeds_km_h=[40,110]", "settle_min=0"});
    const auto held = run("speed_sweep", tire, {"speeds_km_h=[40,110]", "settle_min=600"});
    REQUIRE(brief.warnings.size() == 1);
    CHECK_THAT(brief.warnings[0], Catch::Contains("settle_min"));
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& cycle = brief.result["cycles"][i];
      const double above = cycle["rrc_N_per_kN"].get<double>() / held.result["cycles"][i]["rrc_N_per_kN"].get<double>();
      CHECK(cycle["unsettled_percent"].get<double>() == Approx(1e2 * (above - 1.0)).margin(0.02));
    }
  }
}

TEST_CASE("what a torque sensor's noise does to a settled tire is no reason for a warning", "[fast]") {
  scenarios::RunSpec spec = make_spec("speed_sweep", "a60", {}, "quasi_static");
  spec.sensors = measurements::read_sensor_asset("source");
  CHECK(scenarios::run_scenario(spec, {}).warnings.empty());
}

TEST_CASE("a narrow transition of the loss to its limit has the loss of a narrower one", "[fast]") {
  const auto find_rrc = [](const char* width) {
    return run("iso_28580", "a50", {std::string("tire.bounded.limit_width_K=") + width, "soak_h=0"})
        .result["rrc_25degC_2m_N_per_kN"]
        .get<double>();
  };
  const double narrow = find_rrc("0.1");
  for (const char* width : {"0.02", "0.006"}) {
    INFO(width);
    CHECK(find_rrc(width) == Approx(narrow).epsilon(1e-3));  // e^((T - T_m)/w) overflows
  }
}

TEST_CASE("a test that is too short says how far its RRc is from steady state, and the further the more", "[fast]") {
  const auto find_rrc = [](const scenarios::Outcome& of) { return of.result["rrc_N_per_kN"].get<double>(); };
  const double steady = find_rrc(run("iso_28580", "c1_205_55r16", {"warm_up_min=600"}));
  for (const char* setting : {"warm_up_min=10", "warm_up_min=5", "warm_up_min=1", "measurement_min=10",
                              "measurement_min=6", "measurement_min=2"}) {
    INFO(setting);
    const bool is_cycle = std::string(setting).front() == 'm';
    const auto outcome =
        run("iso_28580", "c1_205_55r16", {setting, is_cycle ? "measurement_cycles=3" : "measurement_cycles=0"});
    const double above = 1e2 * (find_rrc(outcome) / steady - 1.0);
    REQUIRE(above > 3.0);
    REQUIRE(!outcome.warnings.empty());
    CHECK_THAT(outcome.warnings.front(), Catch::Contains(fmt::format("RRc is {:.1f} % above", above)));
    CHECK(outcome.result.contains("why_no_label"));
  }
  CHECK(run("iso_28580", "c1_205_55r16").warnings.empty());
  for (const char* heat_capacity : {"30500", "45750", "76250"}) {
    INFO(heat_capacity);
    const std::string slow = std::string("tire.thermal.heat_capacity_J_per_K=") + heat_capacity;
    const auto brief = run("iso_28580", "c1_205_55r16", {slow});
    const auto held = run("iso_28580", "c1_205_55r16", {slow, "warm_up_min=600"});
    const double above = 1e2 * (find_rrc(brief) / find_rrc(held) - 1.0);
    const auto warning = std::find_if(brief.warnings.begin(), brief.warnings.end(), [](const std::string& one) {
      return one.find("steady state") != std::string::npos;
    });
    REQUIRE(warning != brief.warnings.end());
    CHECK_THAT(*warning, Catch::Contains(fmt::format("RRc is {:.1f} % above", above)));
  }
}

TEST_CASE("a truck tire in cycles of ten minutes is not settled by any method, and has no label", "[fast]") {
  for (const char* method : {"torque", "deceleration"}) {
    scenarios::RunSpec spec = make_spec("iso_28580", "c3_315_80r22_5",
                                        {"measurement_cycles=3", std::string("method=") + method}, "quasi_static");
    const auto outcome = scenarios::run_scenario(spec, {});
    INFO(method);
    REQUIRE(!outcome.warnings.empty());
    CHECK_THAT(outcome.warnings.front(), Catch::Contains("above that in steady state"));
    CHECK(!outcome.result.contains("label_class"));
  }
}

TEST_CASE("a long average and a drum that is warmer than the air are not the label's test", "[fast]") {
  for (const char* setting : {"window_s=600", "surface_temperature_degC=40"}) {
    INFO(setting);
    CHECK(!run("iso_28580", "c1_205_55r16", {setting}).result.contains("label_class"));
  }
  CHECK(run("iso_28580", "c1_205_55r16", {"surface_temperature_degC=27", "window_s=30"})
            .result.contains("label_class"));
}

TEST_CASE("a load sweep takes the loads of the tire's own table", "[fast]") {
  CHECK(run("load_sweep", "a40").result["cycles"].size() == 4);
  const auto outcome = run("load_sweep", "a50");
  REQUIRE(outcome.result["cycles"].size() == 3);
  CHECK(outcome.result["cycles"][1]["load_N"].get<double>() == Approx(6100.0));
  // (3.5) is proportional only at equal temperature
  CHECK(number(run("load_sweep", tests::combined_tire_path()), "steady_state_load_exponent") < 1.0);
}

TEST_CASE("a power is fitted exactly to a power", "[fast]") {
  CHECK(scenarios::fit_power({1.0, 2.0, 5.0}, {3.0, 3.0 * std::pow(2.0, -0.4), 3.0 * std::pow(5.0, -0.4)}) ==
        Approx(-0.4));
}

TEST_CASE("a sweep with a resistance that is read below zero has no exponent, and says why", "[fast]") {
  for (const auto& [scenario, exponent] : {std::pair("pressure_sweep", "steady_state_pressure_exponent"),
                                           std::pair("load_sweep", "steady_state_load_exponent")}) {
    INFO(scenario);
    // The load is read as a negative force: 20 mrad of 5 kN are more than the resistance.
    const auto outcome = run(scenario, "a50", {"effects.load_cross_talk.angle_mrad=-20"});
    CHECK(outcome.result["cycles"][0]["rolling_resistance_N"].get<double>() < 0.0);
    CHECK(outcome.result.count(exponent) == 0);
    REQUIRE(outcome.warnings.size() == 1);
    CHECK_THAT(outcome.warnings[0], Catch::Contains("not positive"));
    CHECK(run(scenario, "a50").result.count(exponent) == 1);
  }
}

TEST_CASE("a carriage that would bounce through the whole test is refused on the multibody drum", "[fast]") {
  const auto with_damping = [](const std::string& damping, const std::string& fidelity) {
    run("iso_28580", "a50", {"soak_h=0", "rig.carriage.damping_N_s_per_m=" + damping}, fidelity);
  };
  CHECK_THROWS_WITH(with_damping("0", "multibody"),
                    Catch::Contains("carriage") && Catch::Contains("at least") && Catch::Contains("damping_N_s_per_m"));
  CHECK_NOTHROW(with_damping("0", "quasi_static"));
  CHECK_NOTHROW(with_damping("700", "multibody"));
}

TEST_CASE("a value that a sweep repeats is measured again, each from a soaked tire", "[fast]") {
  const auto speeds = run("speed_sweep", "a50", {"speeds_km_h=[80,120,80]"});
  REQUIRE(speeds.result["cycles"].size() == 3);
  const auto loss_N = [&](std::size_t i) { return speeds.result["cycles"][i]["rolling_resistance_N"].get<double>(); };
  CHECK(loss_N(0) == Approx(loss_N(2)).epsilon(2e-3));
  CHECK(loss_N(1) > loss_N(0));
  std::set<std::string> ids;
  for (const auto& set_run : speeds.set_runs) ids.insert(set_run.id);
  CHECK(ids.size() == 3);
  CHECK(run("pressure_sweep", "a50", {"pressures_kPa=[250,300,250]"}).result["cycles"].size() == 3);
  const auto alike = run("load_sweep", "a50", {"loads_N=[5000,5000]"});
  CHECK(alike.result["cycles"].size() == 2);
  CHECK(alike.result.count("steady_state_load_exponent") == 0);  // no line through one value
}

TEST_CASE("a skim series reads each load where it was run, a repeated one as well", "[fast]") {
  const auto outcome = run("skim_series", "a50", {"skim_loads_N=[200,100,200,50]"});
  const auto force_N = [&](std::size_t i) { return outcome.result["points"][i]["force_N"].get<double>(); };
  REQUIRE(outcome.result["points"].size() == 4);
  CHECK(force_N(2) > force_N(0));  // the tire has cooled down between
  CHECK(force_N(3) < force_N(1));
}

TEST_CASE("a lossless wheel that is run up and down closes its audits", "[fast]") {
  for (const char* fidelity : {"multibody", "quasi_static"}) {
    scenarios::RunSpec spec = make_spec("speed_sweep", "a50",
                                        {"tire.constant.rrc_N_per_kN=0.0", "rig.parasitic.c0_N=0.0",
                                         "rig.parasitic.c1_N_s_per_m=0.0", "rig.parasitic.c2_N_s2_per_m2=0.0"},
                                        fidelity);
    spec.baseline = models::Baseline::kConstantRrc;
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    for (const auto& cycle : outcome.result["cycles"]) CHECK(std::abs(cycle["rrc_N_per_kN"].get<double>()) < 1e-6);
  }
}

TEST_CASE("the step from load to skim does not throw the wheel off the drum", "[fast]") {
  const std::vector<std::string> hard{"speed_km_h=250", "load_N=20000", "rig.drum.diameter_m=20.0",
                                      "rig.carriage.damping_N_s_per_m=2000.0"};
  for (const std::string& setting : hard) {
    INFO(setting);
    CHECK_NOTHROW(run("iso_28580", "a50", {setting, "soak_h=0"}, "multibody"));
  }
}

TEST_CASE("a wheel that bounces on a weak load cylinder is integrated through its jumps", "[slow]") {
  for (const int load_N : {6085, 6238, 6255, 6323, 6578, 6680, 6884}) {
    INFO(load_N);
    CHECK_NOTHROW(run("iso_28580", "a50",
                      {"load_N=" + std::to_string(load_N), "soak_h=0", "rig.carriage.damping_N_s_per_m=2000.0"},
                      "multibody"));
  }
}

TEST_CASE("sweeps run a truck tire at its own load and pressure, a car tire at those of the vehicle", "[fast]") {
  const auto find_load_N = [](const char* tire) {
    const auto outcome = run("speed_sweep", tire, {"speeds_km_h=[80]", "settle_min=0"});
    return outcome.result["cycles"][0]["load_N"].get<double>();
  };
  CHECK(find_load_N("c3_315_80r22_5") == Approx(33350.0).epsilon(1e-4));
  CHECK(find_load_N("a50") == Approx(5400.0).epsilon(1e-4));
}
