// [validity] of a tire: a run beyond it is warned of, once for each quantity.
#include <catch2/catch.hpp>

#include "models/tire/tire_file.h"
#include "scenarios/run/run_spec.h"
#include "scenarios/run/tire_validity.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;

namespace {

/// Warnings of a run of a50 that speak of validity.
std::vector<std::string> warn(const std::string& scenario, const std::vector<std::string>& settings) {
  std::vector<std::string> found;
  for (const std::string& warning : tests::run(scenario, "a50", settings).warnings) {
    if (warning.find("is valid from") != std::string::npos) found.push_back(warning);
  }
  return found;
}

}  // namespace

TEST_CASE("a run within the validity of its tire is not warned of, skim test and standstill included", "[fast]") {
  CHECK(warn("iso_28580", {}).empty());
  CHECK(warn("sae_j1634", {"wheels=1", "mid_min=5", "end_min=5"}).empty());
}

TEST_CASE("a run beyond the validity of its tire is warned of, each quantity by itself", "[fast]") {
  const auto fast = warn("warm_up", {"speed_km_h=150", "warm_up_min=5"});
  REQUIRE(fast.size() == 1);
  CHECK_THAT(fast[0], Catch::Contains("speed from 0 to 150 km/h") && Catch::Contains("to 120"));
  const auto heavy = warn("iso_28580", {"load_N=9000", "warm_up_min=5"});
  REQUIRE(heavy.size() == 1);
  CHECK_THAT(heavy[0], Catch::Contains("load up to") && Catch::Contains("'a50'"));
  CHECK_THAT(warn("iso_28580", {"load_N=2000"})[0], Catch::Contains("load up to"));
  CHECK_THAT(warn("iso_28580", {"ambient_degC=-10"})[0], Catch::Contains("liner temperature from -10"));
}

TEST_CASE("the validity of a tire is written as it was read, and an empty range is refused", "[fast]") {
  const std::string text = models::write_tire(tests::read_asset_tire("a50"));
  const models::TireFile again = models::read_tire(parse_config(text, "a50.toml"));
  REQUIRE(again.validity.has_value());
  CHECK(again.validity->highest_load_N == 6865.0);
  std::string empty = text;
  const std::size_t at = empty.find("highest_load_N");
  empty.replace(at, empty.find('\n', at) - at, "highest_load_N = 5000");
  CHECK_THROWS_WITH(models::read_tire(parse_config(empty, "a50.toml")),
                    Catch::Contains("[validity]") && Catch::Contains("more than lowest_load_N"));
}

namespace {

/// A tire on the source's lines whose loss falls to nothing at 60 km/h and is negative above.
models::TireFile make_driving_tire() {
  models::TireFile tire = tests::read_combined_tire("a50");
  tire.name = "driving";
  tire.values.load_map.clear();
  tire.values.rolling_resistance.A0_N = 50.0;
  tire.values.rolling_resistance.A1_N_s_per_m = -3.0;
  return tire;
}

}  // namespace

TEST_CASE("a tire whose loss is negative within its validity is doubted, with the key and the speed", "[fast]") {
  const auto found = scenarios::list_negative_losses(make_driving_tire());
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], Catch::Contains("A1_N_s_per_m = -3:") && Catch::Contains("above 60 km/h"));
  models::TireFile slow = make_driving_tire();
  slow.validity = models::TireValidity{};
  slow.validity->highest_speed_m_s = 50.0 / 3.6;
  CHECK(scenarios::list_negative_losses(slow).empty());
  for (const char* tire : {"a40", "a50", "a60", "c1_205_55r16", "c3_315_80r22_5"}) {
    INFO(tire);
    CHECK(scenarios::list_negative_losses(tests::read_asset_tire(tire)).empty());
  }
}

TEST_CASE("a run in which the tire drives the wheel fails, and says when and why", "[fast]") {
  scenarios::RunSpec spec = tests::make_spec("warm_up", "a50", {"speed_km_h=80", "warm_up_min=5"});
  spec.tire = make_driving_tire();
  for (const scenarios::Fidelity fidelity : {scenarios::Fidelity::kQuasiStatic, scenarios::Fidelity::kMultibody}) {
    spec.fidelity = fidelity;
    CHECK_THROWS_WITH(scenarios::run_scenario(spec, {}), Catch::Contains("rolling_resistance_N is -") &&
                                                             Catch::Contains("(speed 6") && Catch::Contains("degC") &&
                                                             Catch::Contains("A1_N_s_per_m = -3 makes") &&
                                                             Catch::Contains("'driving'"));
  }
}
