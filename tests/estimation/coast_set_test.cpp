// Sets of drum coastdowns as files give them, and what their report says in turn.
#include "estimation/drum_deceleration/coast_set.h"

#include <catch2/catch.hpp>

#include "estimation/drum_deceleration/drum_coastdown.h"
#include "tests/support/run_program.h"

using namespace rollrig;
using namespace rollrig::estimation;
using tests::TemporaryFolder;
using tests::write_file;

TEST_CASE("rows of drum and wheel in one file go to their body", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("set.toml"), R"(format = "rollrig-drum-coastdown/1"
name = "both"
[drum]
diameter_m = 1.7
[[run]]
file = "1.csv"
state = "loaded"
pressure_kPa = 250.0
[[run]]
file = "1.csv"
state = "lifted"
)");
  write_file(folder.file("1.csv"), "src,t_s,speed_mps\nD,0.0,20.0\nW,0.01,19.5\nD,1.0,19.0\nW,1.01,18.5\nD,2.0,18.0\n");
  const CoastSet set = read_coast_set(folder.file("set.toml"));
  REQUIRE(set.runs.size() == 2);
  REQUIRE(set.runs[0].drum.has_value());
  REQUIRE(set.runs[0].wheel.has_value());
  CHECK(set.runs[0].drum->speed_m_s == std::vector<double>{20.0, 19.0, 18.0});
  CHECK(set.runs[0].wheel->speed_m_s == std::vector<double>{19.5, 18.5});
}

TEST_CASE("a wheel's inertia without a run of the lifted wheel is refused, and the message says what is missing",
          "[fast]") {
  const TemporaryFolder folder;
  const auto write = [&folder](const std::string& wheel) {
    write_file(
        folder.file("set.toml"),
        "format = \"rollrig-drum-coastdown/1\"\n[drum]\ndiameter_m = 2.0\ninertia_kg_m2 = 850.0\n" + wheel + R"([[run]]
file = "1.csv"
state = "loaded"
pressure_kPa = 250.0
[[run]]
file = "1.csv"
state = "lifted"
)");
  };
  write_file(folder.file("1.csv"), "time_s,speed_km_h\n0,80\n1,79\n2,78\n");
  for (const char* wheel :
       {"[wheel]\ninertia_kg_m2 = 1.1\nrolling_radius_m = 0.345\n", "[wheel]\nmass_ratio = 0.02\n"}) {
    write(wheel);
    CHECK_THROWS_WITH(read_coast_set(folder.file("set.toml")),
                      Catch::Contains("no run has the lifted wheel alone") && Catch::Contains("body = \"wheel\""));
  }
  write("");
  CHECK_NOTHROW(read_coast_set(folder.file("set.toml")));
}

TEST_CASE("a resonance has the pressure of its runs, one without a tire on the drum has none", "[fast]") {
  DrumCoastdownFit fit;
  fit.resonances.resize(2);
  fit.resonances[0].pressure_Pa = 250e3;
  const Json json = make_coastdown_json({}, fit);
  CHECK(json["resonances"][0]["pressure_kPa"] == 250.0);
  CHECK(json["resonances"][1]["pressure_kPa"].is_null());
}
