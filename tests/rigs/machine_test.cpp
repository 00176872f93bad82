// Kinds of machines: what the registry knows, and the words of older files.
#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "rigs/rig_file.h"
#include "sim/core/assets.h"
#include "tests/support/machines.h"

using namespace rollrig;

TEST_CASE("every rig file is written as it was read", "[fast]") {
  for (const std::string& name : list_assets("rigs")) {
    INFO(name);
    const rigs::RigFile rig = rigs::read_rig(read_config(find_asset("rigs", name)));
    CHECK(rig.name == name);
    const std::string text = rigs::write_rig(rig);
    const rigs::RigFile again = rigs::read_rig(parse_config(text, "rig.toml"));
    CHECK(again.kind == rig.kind);
    CHECK(rigs::write_rig(again) == text);
  }
}

TEST_CASE("how a rig cools tires is written and read, in the new format alone", "[fast]") {
  rigs::RigFile rig = rigs::read_rig(read_config(find_asset("rigs", "drum_2m")));
  rig.tire_cooling = {};
  rig.skim_by_class = {};
  CHECK_THAT(rigs::write_rig(rig), Catch::StartsWith("format = \"rollrig-rig/1\"") && !Catch::Contains("tire_cooling"));
  rig.tire_cooling = {11.0, 1.5};
  rig.tire_cooling_uncertainties = {0.7, 0.0};
  const std::string text = rigs::write_rig(rig);
  CHECK_THAT(text, Catch::StartsWith("format = \"rollrig-rig/2\""));
  const rigs::RigFile again = rigs::read_rig(parse_config(text, "rig.toml"));
  CHECK(again.tire_cooling.at_rest_W_per_m2_K == 11.0);
  CHECK(again.tire_cooling.per_speed_W_s_per_m3_K == 1.5);
  CHECK(again.tire_cooling_uncertainties.at_rest_W_per_m2_K == 0.7);
  CHECK(again.tire_cooling_uncertainties.per_speed_W_s_per_m3_K == 0.0);
}

TEST_CASE("the loads of the skim test by class are written and read, in the new format alone", "[fast]") {
  rigs::RigFile rig = rigs::read_rig(read_config(find_asset("rigs", "drum_2m")));
  rig.tire_cooling = {};
  rig.skim_by_class = {0.0, 350.0};
  const std::string text = rigs::write_rig(rig);
  CHECK_THAT(text, Catch::StartsWith("format = \"rollrig-rig/2\""));
  rigs::RigFile again = rigs::read_rig(parse_config(text, "rig.toml"));
  rigs::use_skim_load_of_class(again, tests::read_asset_tire("c3_315_80r22_5"));
  CHECK(again.skim.load_N == 350.0);
  CHECK(again.skim_by_class.c3_load_N == 0.0);
  again.skim_by_class = {0.0, 350.0};
  again.skim.load_N = 200.0;
  rigs::use_skim_load_of_class(again, tests::read_asset_tire("c2_215_65r16c"));  // a load of 0: that of [skim]
  CHECK(again.skim.load_N == 200.0);
}

TEST_CASE("a road by its former word is still read, and its asset still found", "[fast]") {
  const rigs::RigFile rig = rigs::read_rig(parse_config(R"(format = "rollrig-rig/1"
name = "flat"
kind = "flat"
[environment]
ambient_degC = 20.0
)",
                                                        "rig.toml"));
  CHECK(rig.kind == tests::kRoad);
  CHECK(find_asset("rigs", "flat") == find_asset("rigs", "road"));
}

TEST_CASE("a measured column of a kind is one of its own, and its force is among them", "[fast]") {
  for (const tests::Machine kind : rigs::machine_kinds()) {
    INFO(kind->word);
    const std::vector<Quantity> measured = rigs::measured_channels(*kind);
    CHECK(std::count(measured.begin(), measured.end(), kind->traits.force) == 1);
    for (const auto& [channel, sensor] : kind->default_sensors) {
      CHECK(std::count(measured.begin(), measured.end(), channel) == 1);
    }
  }
}

TEST_CASE("a kind whose sets name a vehicle and no rig has one of its own kind, in standard air", "[fast]") {
  CHECK(&rigs::find_kind_without_rig(&models::is_on_road) == tests::kRoad);
  CHECK_THROWS_AS(rigs::find_kind_without_rig(&models::has_skim), std::invalid_argument);
  for (const tests::Machine kind : rigs::machine_kinds()) {
    if (kind->names_rig()) continue;
    const rigs::RigFile rig = kind->make_rig();
    CHECK(rig.kind == kind);
    CHECK(rig.environment.ambient_pressure_Pa == kStandardAtmosphere_Pa);
  }
}
