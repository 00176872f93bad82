#include <catch2/catch.hpp>
#include <cmath>

#include "measurements/measurement_set.h"
#include "measurements/resimulation.h"
#include "scenarios/run/run_spec.h"
#include "sim/energy_audit.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using tests::TemporaryFolder;

namespace {

constexpr const char* kHeader = "time_s,speed_km_h,load_N,ambient_degC\n";

/// A run of the scenario on rows given as text, by default of tire a50 in the fast fidelity.
scenarios::Outcome follow(const std::string& csv, std::vector<std::string> settings = {},
                          const std::string& fidelity = "quasi_static") {
  const TemporaryFolder folder;
  tests::write_file(folder.file("steps.csv"), csv);
  settings.push_back("program=" + folder.file("steps.csv"));
  return tests::run("follow_drum", "a50", settings, fidelity);
}

/// Everything that a drum does: ramps, load steps, a lifted tire, standstill, air that warms.
const std::string kEverything = std::string(kHeader) +
                                "0,80,5400,25\n300,80,200,25.5\n400,80,0,25.5\n500,80,4000,26\n560,120,4000,26\n"
                                "860,120,5400,27\n900,0,5400,27\n1100,0,5400,27\n1150,60,3000,27\n1400,60,3000,27\n";

void check_equal(const sim::Recording<double>& a, const sim::Recording<double>& b, double tolerance) {
  REQUIRE(a.time_s.size() == b.time_s.size());
  REQUIRE(a.channels.size() == b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.row_count(); ++i) {
      worst = std::max(worst, std::abs(a.values[c][i] - b.values[c][i]) / (1.0 + std::abs(b.values[c][i])));
    }
    INFO(a.channels[c].quantity.header());
    CHECK(worst <= tolerance);
  }
}

double channel_at(const scenarios::Outcome& outcome, const char* channel, double time_s) {
  return outcome.recording.channel(channel)[outcome.recording.row_at(time_s)];
}

}  // namespace

TEST_CASE("the rows of a warm-up make the warm-up", "[fast]") {
  const std::string rows = std::string(kHeader) + "0,80,5400,25\n1800,80,200,25\n1980,80,200,25\n";
  for (const char* fidelity : {"multibody", "quasi_static"}) {
    INFO(fidelity);
    const auto warm_up = tests::run("warm_up", "a50", {"load_N=5400", "pressure_kPa=280"}, fidelity);
    const auto program = follow(rows, {"pressure_kPa=280"}, fidelity);
    check_equal(program.recording, warm_up.recording, 1e-7);
    const Json& loaded = program.result["stretches"][0];
    const Json& skim = program.result["stretches"][1];
    CHECK(loaded["force_N"].get<double>() - skim["force_N"].get<double>() ==
          Approx(tests::number(warm_up, "rolling_resistance_N")).epsilon(1e-6));
  }
}

TEST_CASE("energy closes whatever the rows ask for", "[fast]") {
  for (const char* fidelity : {"multibody", "quasi_static"}) {
    INFO(fidelity);
    const sim::EnergyAudit audit = follow(kEverything, {}, fidelity).recording.audit;
    CHECK(std::abs(audit.calc_closure(sim::EnergyTerm::Ledger::kMechanical)) < sim::kAuditLimit);
    CHECK(std::abs(audit.calc_closure(sim::EnergyTerm::Ledger::kThermal)) < sim::kAuditLimit);
  }
}

TEST_CASE("a load holds until the next row, all else goes straight", "[fast]") {
  const auto outcome = follow(kEverything);
  CHECK(channel_at(outcome, "load_N", 299.0) == Approx(5400.0));
  CHECK(channel_at(outcome, "load_N", 300.0) == Approx(200.0));
  CHECK(channel_at(outcome, "load_N", 450.0) == 0.0);
  CHECK(3.6 * channel_at(outcome, "speed_km_h", 530.0) == Approx(100.0));
  CHECK(channel_at(outcome, "ambient_degC", 150.0) == Approx(298.4));
  CHECK(channel_at(outcome, "speed_km_h", 1000.0) == 0.0);
  // 80 km/h for 500 s, to 120 in 60 s, 120 for 300 s, to 0 in 40 s, 200 s of rest, to 60 in 50 s, 60 for 250 s
  const double expected_km = (80.0 * 500.0 + 100.0 * 60.0 + 120.0 * 300.0 + 60.0 * 40.0 + 30.0 * 50.0 + 60.0 * 250.0);
  CHECK(tests::number(outcome, "distance_km") == Approx(expected_km / 3600.0));
  CHECK(tests::number(outcome, "duration_s") == Approx(1400.0));
}

TEST_CASE("a lifted tire leaves the rig's own loss", "[fast]") {
  const std::string rows = std::string(kHeader) + "0,80,0,25\n200,80,0,25\n";
  for (const char* fidelity : {"multibody", "quasi_static"}) {
    INFO(fidelity);
    const auto outcome = follow(rows, {}, fidelity);
    const rigs::RigFile rig = tests::read_asset_rig();
    const double expected_N = models::calc_parasitic_N(rig.parasitic, 80.0 / 3.6);
    CHECK(outcome.result["stretches"][0]["force_N"].get<double>() == Approx(expected_N).epsilon(1e-4));
  }
}

TEST_CASE("more rows on the same lines, or another start of the clock, change nothing", "[fast]") {
  const std::string rows = std::string(kHeader) + "0,60,5400,25\n200,100,5400,27\n400,100,200,27\n600,100,200,27\n";
  const std::string finer = std::string(kHeader) +
                            "0,60,5400,25\n100,80,5400,26\n200,100,5400,27\n300,100,5400,27\n400,100,200,27\n"
                            "500,100,200,27\n600,100,200,27\n";
  const std::string later =
      std::string(kHeader) + "1000,60,5400,25\n1200,100,5400,27\n1400,100,200,27\n1600,100,200,27\n";
  const auto outcome = follow(rows);
  check_equal(follow(finer).recording, outcome.recording, 1e-9);
  check_equal(follow(later).recording, outcome.recording, 1e-12);
}

TEST_CASE("a surface that the file has is that of the rig", "[fast]") {
  const std::string header = "time_s,speed_km_h,load_N,ambient_degC,surface_temperature_degC\n";
  const auto as_air = follow(header + "0,80,5400,25,25\n1500,80,5400,25,25\n");
  const auto warmer = follow(header + "0,80,5400,25,45\n1500,80,5400,25,45\n");
  const auto without = follow(std::string(kHeader) + "0,80,5400,25\n1500,80,5400,25\n");
  const char* end = "liner_temperature_end_degC";
  CHECK(tests::number(as_air, end) == Approx(tests::number(without, end)).epsilon(1e-9));
  const double rise_K = tests::number(warmer, end) - tests::number(as_air, end);
  CHECK(rise_K > 1.0);
  CHECK(rise_K < 20.0);
}

TEST_CASE("what memory a tire starts with goes by its rest, and into the set", "[fast]") {
  const std::string rows = std::string(kHeader) + "0,80,5400,25\n120,80,5400,25\n";
  const std::vector<std::string> short_soak{"soak_h=0", "pressure_check_min=0", "effects.flat_spot.excess_percent=6"};
  const auto start_N = [&](std::vector<std::string> settings) {
    settings.insert(settings.end(), short_soak.begin(), short_soak.end());
    return channel_at(follow(rows, settings), "rolling_resistance_N", 5.0);
  };
  const double soaked_N = start_N({});
  const double rested_N = start_N({"rest_before_min=30"});
  const double warm_N = start_N({"tire_state=warm"});
  CHECK(warm_N < rested_N);
  CHECK(rested_N < soaked_N);
  CHECK(start_N({"rest_before_min=100000"}) == Approx(soaked_N).epsilon(1e-4));

  const auto outcome = follow(rows, {"rest_before_min=30", "soak_h=1", "pressure_check_min=10"});
  REQUIRE(outcome.set_runs.size() == 1);
  CHECK(*outcome.set_runs[0].rest_before_s == Approx(100.0 * 60.0));
  CHECK(outcome.set_runs[0].id == "steps");
  CHECK_FALSE(follow(rows).set_runs[0].rest_before_s.has_value());
}

TEST_CASE("a program written as a set is resimulated to the same channels, memory and all", "[fast]") {
  const TemporaryFolder folder;
  tests::write_file(folder.file("steps.csv"), kEverything);
  scenarios::RunSpec spec = tests::make_spec(
      "follow_drum", "a50",
      {"program=" + folder.file("steps.csv"), "rest_before_min=30", "soak_h=0.5", "effects.flat_spot.excess_percent=6"},
      "quasi_static");
  spec.sensors = models::SensorSet{};
  for (const char* channel : {"drum_torque_Nm", "liner_temperature_degC"}) (*spec.sensors)[channel] = {};
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  for (const auto& [name, content] : scenarios::write_measurement_set(spec, outcome, "test")) {
    tests::write_file(folder.file(name), content);
  }
  const measurements::MeasurementSet set = measurements::read_measurement_set(folder.path());
  REQUIRE(set.runs.size() == 1);
  const measurements::MeasuredRun& run = set.runs[0];
  CHECK(run.rest_before_s.has_value());
  models::Corner<double> corner(rigs::make_context(set.tire, *set.rig, set.baseline), spec.effects);
  const auto resimulated = measurements::Resimulation(run, *set.kind).simulate(set, run, corner);
  for (const char* channel : {"drum_torque_Nm", "liner_temperature_degC"}) {
    const std::vector<double>& measured = run.columns.at(channel);
    double worst = 0.0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      if (run.columns.at("speed_km_h")[i] < 1.0 || std::isnan(measured[i])) continue;
      worst = std::max(worst, std::abs(resimulated.channel(channel)[i] - measured[i]) / (1.0 + std::abs(measured[i])));
    }
    INFO(channel);
    CHECK(worst < 2e-4);
  }
}

TEST_CASE("a run file of a set is a program", "[fast]") {
  const auto outcome = follow(
      "time_s,speed_km_h,load_N,ambient_degC,drum_torque_Nm,liner_temperature_degC\n0,80,5400,25,41,25\n"
      "60,80,5400,25,,26\n120,80,5400,25,40,27\n");
  CHECK(tests::number(outcome, "duration_s") == Approx(120.0));
}
