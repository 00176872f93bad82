// The four methods of ISO 28580 on rigs without and with errors, and its test by tire class.
#include <catch2/catch.hpp>
#include <cmath>

#include <fmt/format.h>

#include "scenarios/common/iso_methods.h"
#include "scenarios/common/readings.h"
#include "sim/core/columns.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using Catch::Contains;
using tests::number;
using tests::run;

namespace {

const std::vector<std::string> kOfEachClass{"c1_205_55r16", "c2_215_65r16c", "c3_315_80r22_5"};

/// F_r by one method.
double read_method_N(const scenarios::Outcome& outcome, const std::string& name) {
  for (const Json& method : outcome.result["methods"]) {
    if (method["name"] == name) return method["rolling_resistance_N"].get<double>();
  }
  FAIL("no method " << name);
  return 0.0;
}

scenarios::Outcome run_coasts(const std::string& tire, std::vector<std::string> settings = {},
                              const std::string& fidelity = "quasi_static") {
  settings.emplace_back("method=deceleration");
  return run("iso_28580", tire, settings, fidelity);
}

// A coast begins above the test speed, where the tire becomes warmer by up to a few tenths of a degree.
constexpr double kCoastTolerance = 4e-3;

}  // namespace

TEST_CASE("on a rig without errors the four methods agree for each tire class", "[fast]") {
  for (const std::string& tire : kOfEachClass) {
    const auto outcome = run_coasts(tire);
    const double torque_N = read_method_N(outcome, "torque");
    INFO(tire << ": " << outcome.result["methods"].dump());
    CHECK(read_method_N(outcome, "force") == Approx(torque_N).epsilon(1e-6));
    CHECK(read_method_N(outcome, "power") == Approx(torque_N).epsilon(1e-6));
    CHECK(read_method_N(outcome, "deceleration") == Approx(torque_N).epsilon(kCoastTolerance));
    CHECK(outcome.result["method"] == "deceleration");
    CHECK(number(outcome, "rrc_25degC_2m_N_per_kN") ==
          Approx(1e3 * read_method_N(outcome, "deceleration") / number(outcome, "load_N")).epsilon(1e-9));
  }
}

TEST_CASE("the coasts leave the other methods as they are without them", "[fast]") {
  for (const char* fidelity : {"quasi_static", "multibody"}) {
    INFO(fidelity);
    const auto with = run_coasts("c1_205_55r16", {}, fidelity);
    const auto without = run("iso_28580", "c1_205_55r16", {}, fidelity);
    // of the skim test only, before which the tire has cooled a little longer
    CHECK(read_method_N(with, "torque") == Approx(read_method_N(without, "torque")).epsilon(1e-4));
    CHECK(without.result["methods"].size() == 3);
    CHECK(read_method_N(with, "deceleration") == Approx(read_method_N(with, "torque")).epsilon(kCoastTolerance));
    CHECK(read_method_N(with, "power") == Approx(read_method_N(with, "torque")).epsilon(1e-5));
  }
}

TEST_CASE("methods agree off the reference conditions: smaller drum, other speed, larger loss of the rig", "[fast]") {
  const auto outcome =
      run_coasts("c1_205_55r16", {"rig.drum.diameter_m=1.7", "speed_km_h=60", "rig.parasitic.c0_N=40"});
  const double torque_N = read_method_N(outcome, "torque");
  CHECK(read_method_N(outcome, "force") == Approx(torque_N).epsilon(1e-6));
  CHECK(read_method_N(outcome, "power") == Approx(torque_N).epsilon(1e-6));
  CHECK(read_method_N(outcome, "deceleration") == Approx(torque_N).epsilon(kCoastTolerance));
  // the loss of the rig is in no method; a coast ends sooner with it, and the tire of the skim test is warmer
  const auto usual = run_coasts("c1_205_55r16", {"rig.drum.diameter_m=1.7", "speed_km_h=60"});
  for (const char* method : {"torque", "force", "power"}) {
    CHECK(read_method_N(outcome, method) == Approx(read_method_N(usual, method)).epsilon(1e-4));
  }
  CHECK(read_method_N(outcome, "deceleration") ==
        Approx(read_method_N(usual, "deceleration")).epsilon(kCoastTolerance));
}

TEST_CASE("an error in the scale of the torque is in the torque method alone", "[fast]") {
  const auto exact = run_coasts("c1_205_55r16");
  const auto wrong = run_coasts("c1_205_55r16", {"effects.torque_gain.gain_percent=2"});
  CHECK(read_method_N(wrong, "torque") == Approx(1.02 * read_method_N(exact, "torque")).epsilon(1e-6));
  for (const char* method : {"force", "power", "deceleration"}) {
    CHECK(read_method_N(wrong, method) == Approx(read_method_N(exact, method)).epsilon(1e-9));
  }
  const double difference = wrong.result["methods"][1]["difference_percent"].get<double>();
  CHECK(difference == Approx(100.0 * (1.0 / 1.02 - 1.0)).epsilon(1e-4));
}

TEST_CASE("the deceleration method is off by as much as its budget says, more after short measurement cycles",
          "[fast]") {
  for (const std::string& tire : kOfEachClass) {
    INFO(tire);
    const auto difference_percent = [&](const std::string& cycles) {
      const auto outcome = run_coasts(tire, {"measurement_cycles=" + cycles});
      return outcome.result["methods"].back()["difference_percent"].get<double>();
    };
    CHECK(std::abs(difference_percent("0")) < 0.4);
    CHECK(std::abs(difference_percent("3")) < 0.9);
    CHECK(std::abs(difference_percent("3")) > 0.4);
  }
}

TEST_CASE("every number of the test is that of the method that is set, in each cycle", "[fast]") {
  const std::vector<std::string> rig_errors{"effects.torque_gain.gain_percent=4", "spindle_misalignment_mrad=0.3",
                                            "measurement_cycles=2"};
  for (const char* method : {"torque", "force", "power", "deceleration"}) {
    std::vector<std::string> settings = rig_errors;
    settings.push_back(std::string("method=") + method);
    const auto outcome = run("iso_28580", "c1_205_55r16", settings, "quasi_static");
    INFO(method << ": " << outcome.result.dump());
    const double load_N = number(outcome, "load_N");
    CHECK(number(outcome, "rolling_resistance_N") == Approx(read_method_N(outcome, method)));
    CHECK(number(outcome, "rrc_N_per_kN") == Approx(1e3 * read_method_N(outcome, method) / load_N));
    // 25 degC and a 2 m drum: nothing to correct.
    CHECK(number(outcome, "rrc_25degC_2m_N_per_kN") == Approx(number(outcome, "rrc_N_per_kN")).epsilon(1e-9));
    const Json& cycles = outcome.result["cycles"];
    REQUIRE(cycles.size() == 3);
    CHECK(cycles[2]["rolling_resistance_N"] == outcome.result["rolling_resistance_N"]);
    CHECK(cycles[2]["parasitic_N"] == outcome.result["parasitic_N"]);
    double sum_N_per_kN = -cycles[0]["rrc_N_per_kN"].get<double>();  // the warm-up is no measurement cycle
    const auto to_force_method = [](const Json& of) {
      return of["rolling_resistance_N"].get<double>() / of["force_method_N"].get<double>();
    };
    for (const Json& cycle : cycles) {
      // The gain is in the torque method alone: a cycle of it would stand out by 4 % among those of another method.
      CHECK(to_force_method(cycle) == Approx(to_force_method(outcome.result)).epsilon(5e-3));
      sum_N_per_kN += cycle["rrc_N_per_kN"].get<double>();
    }
    CHECK(number(outcome, "rrc_cycles_mean_N_per_kN") == Approx(sum_N_per_kN / 2.0));
  }
}

TEST_CASE("a force cell that is not at a right angle to the load shows a part of it, in the force method alone",
          "[fast]") {
  const auto exact = run_coasts("c1_205_55r16");
  const auto wrong = run_coasts("c1_205_55r16", {"spindle_misalignment_mrad=1"});
  // F_z sin d (1 + r_l/R), R = 1 m, r_l = D/2 - F_z/k_z; the skim test takes off its own part
  const auto shown_N = [](double load_N) { return load_N * std::sin(1e-3) * (1.0 + 0.316 - load_N / 210000.0); };
  CHECK(read_method_N(wrong, "force") - read_method_N(exact, "force") ==
        Approx(shown_N(4825.0) - shown_N(200.0)).epsilon(1e-6));
  for (const char* method : {"torque", "power", "deceleration"}) {
    CHECK(read_method_N(wrong, method) == Approx(read_method_N(exact, method)).epsilon(1e-9));
  }
  const auto other_way = run_coasts("c1_205_55r16", {"spindle_misalignment_mrad=-1"});
  CHECK(read_method_N(other_way, "force") < read_method_N(exact, "force"));
}

TEST_CASE("a drum that is heavier than its file says reads too little in the deceleration method alone", "[fast]") {
  const auto exact = run_coasts("c1_205_55r16");
  const auto wrong = run_coasts("c1_205_55r16", {"effects.inertia_error.error_percent=5"});
  // 450 kg of drum and about 12 kg of wheel at the surface: F_r falls by the drum's share of 1/1.05
  const double wheel_kg = 1.1 / std::pow(0.316 - 4825.0 / 210000.0, 2.0);
  const double expected = (450.0 + wheel_kg) / (450.0 * 1.05 + wheel_kg);
  CHECK(read_method_N(wrong, "deceleration") == Approx(expected * read_method_N(exact, "deceleration")).epsilon(1e-3));
  // a coast takes longer, so that the tire of the skim test is colder
  for (const char* method : {"torque", "force", "power"}) {
    CHECK(read_method_N(wrong, method) == Approx(read_method_N(exact, method)).epsilon(1e-4));
  }
}

TEST_CASE("a coast with too few samples fails with a reason", "[fast]") {
  scenarios::RunSpec spec =
      tests::make_spec("iso_28580", "c3_315_80r22_5", {"method=deceleration", "window_s=200"}, "quasi_static");
  spec.sample_interval_s = 10.0;
  CHECK_THROWS_AS(scenarios::run_scenario(spec, {}), RunFailure);
}

TEST_CASE("the test takes load, pressure, speed, soak, warm-up and coefficient by class, settings win", "[fast]") {
  const auto truck = run("iso_28580", "c3_315_80r22_5");
  CHECK(number(truck, "speed_km_h") == Approx(80.0));
  CHECK(truck.settings["soak_h"] == 6.0);
  CHECK(truck.settings["warm_up_min"] == 180.0);
  CHECK(truck.warnings.empty());
  const auto slow = run("iso_28580", "c3_315_80r22_5", {"tire.service_description.speed_symbol=J"});
  CHECK(number(slow, "speed_km_h") == Approx(60.0));
  CHECK(slow.result.count("label_class") == 1);
  const auto asked =
      run("iso_28580", "c3_315_80r22_5", {"tire.service_description.speed_symbol=J", "speed_km_h=80", "soak_h=3"});
  CHECK(number(asked, "speed_km_h") == Approx(80.0));
  CHECK(asked.settings["soak_h"] == 3.0);
  CHECK(asked.result.count("label_class") == 0);  // not the test that the label is defined by
  const auto van = run("iso_28580", "c2_215_65r16c");
  CHECK(number(van, "load_N") == Approx(0.85 * 1030.0 * 9.80665).epsilon(1e-3));
  CHECK(van.settings["warm_up_min"] == 50.0);
}

TEST_CASE("the pressure is set cold and rises while the tire rolls", "[fast]") {
  for (const std::string& tire : kOfEachClass) {
    const auto outcome = run("iso_28580", tire);
    CHECK(number(outcome, "pressure_verified_kPa") == Approx(number(outcome, "pressure_set_kPa")).epsilon(1e-6));
    CHECK(number(outcome, "cavity_pressure_kPa") > 1.02 * number(outcome, "pressure_set_kPa"));
  }
}

TEST_CASE("reference tires have the label class of their product sheets", "[fast]") {
  // EPREL: 611429 (205/55R16 91V), 610243 (215/65R16C 109/107T), 383836 (315/80R22.5)
  const std::vector<std::pair<const char*, const char*>> known{
      {"c1_205_55r16", "C"}, {"c2_215_65r16c", "B"}, {"c3_315_80r22_5", "C"}};
  for (const auto& [tire, label] : known) {
    const auto outcome = run("iso_28580", tire);
    CHECK(outcome.result["label_class"] == label);
    CHECK(number(outcome, "label_probability") > 0.9);
    CHECK(number(outcome, "approval_stage") == 2.0);
  }
  CHECK(run("iso_28580", "a50").result.count("label_class") == 0);
}

TEST_CASE("a test off the standard has no label class, and says by what", "[fast]") {
  const auto why = [](const std::vector<std::string>& settings) {
    const auto outcome = run("iso_28580", "c1_205_55r16", settings);
    CHECK(outcome.result.count("label_class") == 0);
    return format_tables(outcome.sheet.list_tables());
  };
  CHECK_THAT(why({"rig.drum.diameter_m=1.2"}), Contains("drum's diameter"));
  CHECK_THAT(why({"ambient_degC=35"}), Contains("ambient temperature"));
  CHECK_THAT(why({"soak_h=0.5"}), Contains("soak"));
  CHECK(run("iso_28580", "c1_205_55r16", {"rig.drum.diameter_m=1.7"}).result.count("label_class") == 1);
  CHECK_THAT(why({"rig.drum.diameter_m=1.699"}), Contains("drum's diameter"));
  CHECK_THAT(why({"soak_h=2.99"}), Contains("soak"));
  CHECK_THAT(why({"warm_up_min=29.9"}), Contains("warm-up"));
  CHECK_THAT(why({"tire.iso_28580.ambient_coefficient_per_degC=0.0081"}), Contains("(K_t)"));
}

TEST_CASE("a skim load above that of the standard has no label class and a warning, for each tire class", "[fast]") {
  const std::vector<std::pair<double, double>> most_N{{200.0, 201.0}, {200.0, 201.0}, {500.0, 501.0}};
  for (std::size_t i = 0; i < kOfEachClass.size(); ++i) {
    INFO(kOfEachClass[i]);
    const auto test = [&](double skim_load_N) {
      return run("iso_28580", kOfEachClass[i], {fmt::format("rig.skim.load_N={}", skim_load_N)});
    };
    const auto allowed = test(most_N[i].first), above = test(most_N[i].second);
    CHECK(allowed.result.count("label_class") == 1);
    CHECK(allowed.warnings.empty());
    CHECK(above.result.count("label_class") == 0);
    CHECK_THAT(above.result["why_no_label"].get<std::string>(), Contains("the skim load is not that of the standard"));
    REQUIRE(above.warnings.size() == 1);
    CHECK_THAT(above.warnings.front(), Contains("is above the"));
  }
}

TEST_CASE("methods that differ by more than 3 % are doubted, and an RRc that the class hardly has", "[fast]") {
  const auto warn = [](const std::vector<std::string>& settings) {
    std::string all;
    for (const std::string& warning : run("iso_28580", "c1_205_55r16", settings).warnings) all += warning + "\n";
    return all;
  };
  CHECK(warn({"effects.torque_gain.gain_percent=2.5"}).empty());
  CHECK_THAT(warn({"effects.torque_gain.gain_percent=4"}), Contains("the methods differ by more than 3 %: F_r is"));
  // Torque and power agree to rounding here: either may be the extreme.
  CHECK_THAT(warn({"spindle_misalignment_mrad=2"}),
             (Contains("by torque and") || Contains("by power and")) && Contains("by force"));
  CHECK_THAT(warn({"method=deceleration", "effects.inertia_error.error_percent=5"}), Contains("by deceleration"));
  CHECK_THAT(warn({"method=force", "spindle_misalignment_mrad=-4"}), Contains("is the class C1 right?"));
  // The scatter of the usual sensors is no error of the machine.
  scenarios::RunSpec spec = tests::make_spec("iso_28580", "c1_205_55r16", {}, "quasi_static");
  spec.sensors = models::SensorSet{{models::quantities::kDrumTorque, scenarios::find_force_sensor(spec)}};
  for (int seed = 1; seed <= 60; ++seed) {
    spec.seed = static_cast<std::uint64_t>(seed);
    CHECK(scenarios::run_scenario(spec, {}).warnings.empty());
  }
}

TEST_CASE("the maximum load of J2452 is that of the load index, and C1's load over 0.8 where there is none", "[fast]") {
  CHECK(run("sae_j1269", "c3_315_80r22_5").result["maximum_load_N"] == Approx(4000.0 * 9.80665));
  const auto without = tests::make_spec("sae_j1269", "a50", {}, "quasi_static");
  CHECK(number(scenarios::run_scenario(without, {}), "maximum_load_N") == Approx(without.tire.iso_28580->load_N / 0.8));
}

TEST_CASE("corrected RRc of a van's tire hardly depends on the air, by the coefficient of its class", "[fast]") {
  const double cool = number(run("iso_28580", "c2_215_65r16c", {"ambient_degC=22"}), "rrc_25degC_2m_N_per_kN");
  const double warm = number(run("iso_28580", "c2_215_65r16c", {"ambient_degC=28"}), "rrc_25degC_2m_N_per_kN");
  CHECK(cool == Approx(warm).epsilon(0.006));
}

TEST_CASE("a file whose numbers are not those of its class is doubted in the test", "[fast]") {
  const auto doubted = run("iso_28580", "c1_205_55r16", {"tire.iso_28580.load_N=5500"});
  REQUIRE(doubted.warnings.size() == 1);
  CHECK_THAT(doubted.warnings.front(), Catch::Contains("class C1 asks for"));
}
