// rollrig_validation follow-up: cases again with the runs of a plan.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

#include "diagnosis/checks/set_checks.h"
#include "tests/validation/generator/planned_case.h"

namespace fs = std::filesystem;
using Catch::Contains;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

double mean(const std::vector<double>& values, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) sum += values[i];
  return sum / static_cast<double>(to - from);
}

}  // namespace

TEST_CASE("a followed-up set repeats its own runs byte for byte and adds those of the plan", "[slow]") {
  const std::string road = "time_s,speed_km_h,elevation_m,ambient_degC\n0,80,0,10\n300,80,0,10\n";
  const std::string dyno =
      "time_s,speed_km_h,load_N,longitudinal_force_N,ambient_degC\n0,80,5000,150,24\n300,80,5000,150,24\n";
  for (const auto& [kind, csv] :
       {std::pair<std::string, std::string>("drum", kSteady), {"dyno", dyno}, {"road", road}}) {
    INFO(kind);
    PlannedCase made("--effect inertia_error --seed 5 --runs 2", kind);
    made.add(csv);
    made.add(csv);
    const measurements::MeasurementSet set = made.follow();
    REQUIRE(set.runs.size() == 4);
    CHECK(set.runs[2].session == "next");
    CHECK(set.runs[3].cold_pressure_Pa == 240e3);
    CHECK(set.runs[3].columns.at("speed_km_h").back() == Approx(80.0 / 3.6));
    const auto before = read_folder(made.root + "/sets/0001");
    const auto after = read_folder(made.root + "/followup/sets/0001");
    for (const auto& [name, content] : before) {
      INFO(name);
      if (name == "set.toml") {
        CHECK(after.at(name).substr(0, content.size()) == content);
      } else {
        CHECK(after.at(name) == content);
      }
    }
    CHECK(after.size() == before.size() + 2);
    CHECK(after.at("test-1.csv") != after.at("test-2.csv"));  // another run has another noise
  }
}

TEST_CASE("the same truth and plan give the same bytes, with any number of threads", "[fast]") {
  PlannedCase made("--effect rim_heat --seed 6 --runs 1");
  made.add(kSteady);
  made.follow();
  const auto first = read_folder(made.root + "/followup/sets/0001");
  fs::remove_all(made.root + "/followup/sets");
  REQUIRE(made.run(" --threads 3").status == 0);
  CHECK(read_folder(made.root + "/followup/sets/0001") == first);
  CHECK(made.run().status == 2);  // not over what is there
}

TEST_CASE("the test shows the effect of the truth, with its size", "[fast]") {
  const std::string stands = std::string(kDrumHeader) + "0,0,0,24\n1800,0,0,24\n";
  const auto read_zero = [&](const std::string& effect) {
    PlannedCase made("--effect " + effect + " --seed 7 --runs 1 --noise-free");
    made.add(stands, Json::array(), true);
    const measurements::MeasurementSet set = made.follow();
    CHECK(set.runs[1].force_at_standstill);
    CHECK_FALSE(set.runs[0].force_at_standstill);
    const double radius_m = 0.5 * set.rig->drum.diameter_m;
    std::vector<double> zero_N = set.runs[1].columns.at("drum_torque_Nm");
    for (double& value : zero_N) value /= radius_m;
    return zero_N;
  };
  for (const double zero_N : read_zero("none")) CHECK(zero_N == 0.0);
  // 0.6 N each 10 min in the mean over 30 min, beside what follows the air by less than 0.4 of that a kelvin.
  CHECK(read_zero("torque_zero_drift --size 0.6 --form amplifier").back() == Approx(1.8).margin(0.4));
}

TEST_CASE("in reversed rotation a zero keeps its sign, all else turns over", "[fast]") {
  PlannedCase made("--effect load_cross_talk --form fixed --size 5 --seed 14 --runs 1 --noise-free");
  made.add(kSteady);
  made.plan["runs"][0]["reversed"] = true;
  made.add(kSteady);
  const measurements::MeasurementSet set = made.follow();
  CHECK(set.runs[1].reversed);
  CHECK_FALSE(set.runs[2].reversed);
  const double reversed_Nm = set.runs[1].columns.at("drum_torque_Nm")[100];
  const double forwards_Nm = set.runs[2].columns.at("drum_torque_Nm")[100];
  // Twice the load's part; the air of the two runs differs by a degree or so, which is worth some hundredths.
  const double twice_Nm = 2.0 * 0.5 * set.rig->drum.diameter_m * 5000.0 * std::sin(5e-3);
  CHECK(forwards_Nm - reversed_Nm == Approx(twice_Nm).epsilon(0.05));
}

TEST_CASE("weights on the lever are read with the gain of the sensor", "[fast]") {
  PlannedCase made("--effect torque_gain --form with_air --size 4 --seed 15 --runs 1 --noise-free");
  made.add(
      "time_s,speed_km_h,load_N,ambient_degC,hung_torque_Nm\n0,0,0,25,0\n60,0,0,25,0\n70,0,0,25,50\n130,0,0,25,50\n",
      Json::array(), true);
  const measurements::MeasurementSet set = made.follow();
  const measurements::MeasuredRun& run = set.runs[1];
  CHECK(run.columns.at("drum_torque_Nm")[50] == 0.0);
  CHECK(run.columns.at("drum_torque_Nm")[100] == Approx(52.0).margin(0.05));
  CHECK(run.columns.at("hung_torque_Nm")[100] == 50.0);
  CHECK_FALSE(set.runs[0].has(models::quantities::kHungTorque));
  for (const std::string& warning : diagnosis::check_set(set, 1).warnings) {
    CHECK_THAT(warning, !Contains("test-1 is compared"));  // the zero at standstill is, without ever 20 km/h
  }
}

TEST_CASE("a lifted tire takes nothing: what turns is the drum alone, whatever presses the tire down", "[fast]") {
  const std::string ramp = std::string(kDrumHeader) + "0,40,0,24\n60,40,0,24\n140,120,0,24\n200,120,0,24\n";
  for (const char* effect : {"none", "load_record --size 10"}) {
    INFO(effect);
    PlannedCase made(fmt::format("--effect {} --seed 8 --runs 1 --noise-free", effect));
    made.add(ramp);
    const measurements::MeasurementSet set = made.follow();
    const std::vector<double>& torque_Nm = set.runs[1].columns.at("drum_torque_Nm");
    const double radius_m = 0.5 * set.rig->drum.diameter_m;
    const auto is = [&](const char* key) { return made.truth.at("base").at(key).at("true").get<double>(); };
    const auto parasitic_N = [&](double speed_m_s) {
      return is("c0_N") + is("c1_N_s_per_m") * speed_m_s + is("c2_N_s2_per_m2") * speed_m_s * speed_m_s;
    };
    CHECK(torque_Nm[30] == Approx(radius_m * parasitic_N(40.0 / 3.6)).epsilon(1e-4));
    const double inertia_Nm = set.rig->drum.inertia_kg_m2 / radius_m / 3.6;  // 1 km/h a second
    CHECK(torque_Nm[100] == Approx(radius_m * parasitic_N(80.0 / 3.6) + inertia_Nm).epsilon(1e-3));
  }
}

TEST_CASE("a heated drum is recorded, and warms the tire", "[fast]") {
  const std::string header = "time_s,speed_km_h,load_N,ambient_degC,surface_temperature_degC\n";
  PlannedCase made("--effect none --seed 9 --runs 1 --noise-free");
  made.add(kSteady);
  made.add(header + "0,80,5000,24,64\n600,80,5000,24,64\n");
  const measurements::MeasurementSet set = made.follow();
  CHECK_FALSE(set.runs[1].has(models::quantities::kSurfaceTemperature));
  REQUIRE(set.runs[2].has(models::quantities::kSurfaceTemperature));
  CHECK(set.runs[2].columns.at("surface_temperature_degC").back() == Approx(337.15));
  const double rise_K =
      set.runs[2].columns.at("liner_temperature_degC").back() - set.runs[1].columns.at("liner_temperature_degC").back();
  CHECK(rise_K > 1.0);
  CHECK(rise_K < 40.0);
}

TEST_CASE("what is not read is left empty, and the air is that of another day", "[fast]") {
  PlannedCase made("--effect none --seed 10 --runs 1");
  made.add(kSteady, {{0.0, 200.0}, {400.0, 500.0}});
  const measurements::MeasurementSet set = made.follow();
  const measurements::MeasuredRun& run = set.runs[1];
  for (const char* channel : {"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"}) {
    std::size_t inside = 0, outside = 0;
    for (std::size_t row = 0; row < run.time_s.size(); ++row) {
      const bool is_unread = run.time_s[row] < 200.0 || (run.time_s[row] >= 400.0 && run.time_s[row] < 500.0);
      (is_unread ? inside : outside) += std::isnan(run.columns.at(channel)[row]) ? 0U : 1U;
    }
    CHECK(inside == 0);
    CHECK(outside > 150);
  }
  const double air_degC = mean(run.columns.at("ambient_degC"), 0, run.time_s.size()) - 273.15;
  CHECK(air_degC == Approx(24.0).margin(1.5));
  CHECK(air_degC != Approx(24.0).margin(1e-6));
}

TEST_CASE("a day of its own has offsets of its own, and nothing else of its own", "[fast]") {
  const auto measure = [](const std::string& session) {
    PlannedCase made("--effect none --seed 11 --runs 1");
    made.plan["runs"] = Json::array();
    made.add(kSteady);
    made.plan["runs"][0]["session"] = session;
    write_file(made.plan_folder + "/plan.json", made.plan.dump());
    return made.follow();
  };
  const measurements::MeasurementSet later = measure("next");
  const measurements::MeasurementSet same_day = measure(later.runs.front().session);
  const std::vector<double>& a = later.runs[1].columns.at("drum_torque_Nm");
  const std::vector<double>& b = same_day.runs[1].columns.at("drum_torque_Nm");
  const double offset_Nm = a.back() - b.back();
  CHECK(std::abs(offset_Nm) > 0.01);
  for (std::size_t row = 0; row < a.size(); ++row) {
    REQUIRE(std::isnan(a[row]) == std::isnan(b[row]));
    if (!std::isnan(a[row])) REQUIRE(a[row] - b[row] == Approx(offset_Nm).margin(2e-4));
  }
}
