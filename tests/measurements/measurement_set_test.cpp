#include "measurements/measurement_set.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "build_paths.h"
#include "measurements/resimulation.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/machines.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;

namespace {
/// A set of a run with ideal sensors, written to a folder of its own.
struct WrittenSet {
  scenarios::RunSpec spec;
  scenarios::Outcome outcome;
  tests::TemporaryFolder folder;

  WrittenSet(const std::string& scenario, const std::vector<std::string>& settings)
      : spec(tests::make_spec(scenario, tests::combined_tire_path(), settings, "quasi_static")) {
    spec.sensors = models::SensorSet{};
    for (const char* channel : {"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"}) {
      (*spec.sensors)[channel] = {};
    }
    outcome = scenarios::run_scenario(spec, {});
    for (const auto& [name, content] : scenarios::write_measurement_set(spec, outcome, "test")) {
      tests::write_file(folder.file(name), content);
    }
  }
};
}  // namespace

TEST_CASE("a run written as a set is read back and resimulated to the same channels", "[fast]") {
  const WrittenSet written("transient_skim", {"repeats=2"});
  const measurements::MeasurementSet set = measurements::read_measurement_set(written.folder.path());
  REQUIRE(set.runs.size() == 1);
  CHECK(set.kind == tests::kDrum);
  const measurements::MeasuredRun& run = set.runs[0];
  CHECK(run.time_s.front() == 0.0);
  CHECK(run.initial_tire_temperature_K == Approx(298.15).margin(1e-4));

  tests::DrumFixture fixture;
  fixture.tire = set.tire;
  fixture.rig = *set.rig;
  fixture.initial_K = run.initial_tire_temperature_K;
  fixture.cold_pressure_Pa = run.cold_pressure_Pa;
  const auto resimulated = fixture.run_quasi_static(measurements::make_recorded_program(run, *tests::kDrum));
  REQUIRE(resimulated.time_s == run.time_s);
  for (const char* channel : {"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"}) {
    double worst = 0.0;
    const auto& measured = run.columns.at(channel);
    for (std::size_t i = 0; i < measured.size(); ++i) {
      if (std::isnan(measured[i])) continue;
      worst = std::max(worst, std::abs(resimulated.channel(channel)[i] / measured[i] - 1.0));
    }
    INFO(channel);
    CHECK(worst < 2e-5);
  }
}

TEST_CASE("the program of a drum run joins rows that go on in a straight line", "[fast]") {
  const WrittenSet written("transient_skim", {"repeats=2"});
  const measurements::MeasurementSet set = measurements::read_measurement_set(written.folder.path());
  const sim::Program program = measurements::make_recorded_program(set.runs[0], *set.kind);
  CHECK(program.phases[0].segments.size() < 20);  // of about 1000 rows
  CHECK(program.duration_s() == Approx(set.runs[0].time_s.back()));
}

TEST_CASE("means that reach beyond the cut of a run are left empty", "[fast]") {
  const WrittenSet written("pressure_sweep", {"warm_up_min=2", "settle_min=0"});
  const measurements::MeasurementSet set = measurements::read_measurement_set(written.folder.path());
  REQUIRE(set.runs.size() == 3);
  for (const auto& run : set.runs) {
    CHECK(std::isnan(run.columns.at("drum_torque_Nm").front()));
    CHECK_FALSE(std::isnan(run.columns.at("drum_torque_Nm")[1]));
  }
}

TEST_CASE("the real road set of the shared data is read where it is present", "[fast]") {
  const char* folder = std::getenv("ROLLRIG_MEASURED_DATA");
  const fs::path set_folder =
      fs::path(folder != nullptr ? folder : ROLLRIG_SOURCE_DIR "/../shared/data/measured") / "road_trips_i3";
  if (!fs::exists(set_folder)) {
    WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
    return;
  }
  const measurements::MeasurementSet set = measurements::read_measurement_set(set_folder.string());
  CHECK(set.kind == tests::kRoad);
  CHECK(set.runs.size() == 20);
  CHECK(set.vehicle->count_wheels() == 4);
  CHECK(set.baseline == models::Baseline::kConstantRrc);
}

TEST_CASE("a set of a dynamometer need not describe its sensors", "[fast]") {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("set.toml"), R"(format = "rollrig-measurements/1"
name = "dyno"
tire = "a50"
rig = "dyno_1m2"
[sensors.cavity_pressure_kPa]
offset_sd = 1.0
drift_sd = 0.0
drift_time_s = 1.0
noise_sd = 0.5
resolution = 0.0
[[run]]
id = "a"
file = "a.csv"
session = "day"
initial_tire_temperature_degC = 25.0
cold_pressure_kPa = 280.0
)");
  tests::write_file(folder.file("a.csv"),
                    "time_s,speed_km_h,load_N,longitudinal_force_N,ambient_degC,loss_force_N,cavity_pressure_kPa\n"
                    "0,80,5400,0,25,40,280\n1,80,5400,0,25,40,280\n");
  const measurements::MeasurementSet set = measurements::read_measurement_set(folder.path());
  CHECK(set.assumed_sensors == std::vector<Quantity>{models::quantities::kLossForce});
  CHECK(set.sensors.at("loss_force_N").noise_sd > 0.0);
  CHECK(set.sensors.at("cavity_pressure_kPa").noise_sd == Approx(500.0));
  CHECK(set.sensors.count("liner_temperature_degC") == 0);  // not measured

  const std::string text = read_text_file(folder.file("set.toml"));
  const auto read_as = [&](const std::string& kind) {
    std::string with_kind = text;
    with_kind.insert(with_kind.find("[sensors"), "kind = \"" + kind + "\"\n");
    tests::write_file(folder.file("set.toml"), with_kind);
    return measurements::read_measurement_set(folder.path()).kind;
  };
  CHECK(read_as("roller") == set.kind);
  CHECK(read_as("dyno") == set.kind);  // its former word
  CHECK_THROWS_AS(read_as("drum"), InputError);
  CHECK_THROWS_WITH(read_as("rollers"), Catch::Contains("roller"));
}

TEST_CASE("runs of a drum and a roller may be reversed and have weights on their sensor, and a road has no rig",
          "[fast]") {
  const auto read = [](const std::string& rig, const std::string& further) {
    const tests::TemporaryFolder folder;
    tests::write_file(folder.file("set.toml"), R"(format = "rollrig-measurements/1"
name = "set"
tire = "a50"
rig = ")" + rig + R"("
[[run]]
id = "a"
file = "a.csv"
session = "day, reversed"
initial_tire_temperature_degC = 25.0
cold_pressure_kPa = 280.0
reversed = true
)");
    tests::write_file(folder.file("a.csv"),
                      "time_s,speed_km_h,load_N,ambient_degC" + further + "\n0,80,5400,25,0\n1,80,5400,25,50\n");
    return measurements::read_measurement_set(folder.path());
  };
  const measurements::MeasurementSet set = read("drum_2m", ",hung_torque_Nm");
  CHECK(set.runs[0].reversed);
  CHECK(set.runs[0].columns.at("hung_torque_Nm") == std::vector<double>{0.0, 50.0});
  const measurements::MeasurementSet rollers = read("dyno_1m2", ",longitudinal_force_N");
  CHECK(rollers.runs[0].reversed);
  CHECK_THROWS_WITH(read("road", ""), Catch::Contains("road"));
}

TEST_CASE("a file that a set names and that is not there is refused where it is named", "[fast]") {
  for (const auto& [file, key] : {std::pair{"rig.toml", "rig"}, std::pair{"tire.toml", "tire"}}) {
    const WrittenSet written("warm_up", {});
    fs::remove(written.folder.file(file));
    try {
      measurements::read_measurement_set(written.folder.path());
      FAIL("read without " << file);
    } catch (const InputError& error) {
      CHECK(error.problem().key == key);
      CHECK(error.problem().line > 0);
      CHECK_THAT(error.problem().file, Catch::EndsWith("set.toml"));
      CHECK_THAT(error.problem().what, Catch::Contains(file));
    }
  }
}
