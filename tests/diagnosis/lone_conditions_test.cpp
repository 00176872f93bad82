#include "diagnosis/findings/lone_conditions.h"

#include <catch2/catch.hpp>

#include "tests/diagnosis/gap_sets.h"

using namespace rollrig;
using diagnosis::find_lone_conditions;
using diagnosis::PreparedSet;
using Words = std::vector<std::string>;

namespace {

constexpr std::size_t kSecond = 1;  // 4.2 kN, as the fifth
constexpr std::size_t kThird = 2;   // 3 kN, as no other

}  // namespace

TEST_CASE("a run is alone in what no other run comes near", "[fast]") {
  auto measured = tests::make_gap_set({}, 5);
  CHECK(find_lone_conditions(PreparedSet(measured), kSecond).empty());
  CHECK(find_lone_conditions(PreparedSet(measured), kThird) == Words{"load"});
  SECTION("a pressure") {
    measured.runs[kSecond].cold_pressure_Pa += 30e3;
    CHECK(find_lone_conditions(PreparedSet(measured), kSecond) == Words{"pressure"});
  }
  SECTION("a temperature") {
    measured.runs[kSecond].initial_tire_temperature_K += 12.0;
    CHECK(find_lone_conditions(PreparedSet(measured), kSecond) == Words{"start temperature"});
    for (double& ambient_K : measured.runs[kSecond].columns.at("ambient_degC")) ambient_K -= 8.0;
    CHECK(find_lone_conditions(PreparedSet(measured), kSecond) == Words{"start temperature", "air temperature"});
  }
  SECTION("of two runs that share it, neither is alone") {
    measured.runs[kSecond].cold_pressure_Pa += 30e3;
    measured.runs[kThird].cold_pressure_Pa += 35e3;
    CHECK(find_lone_conditions(PreparedSet(measured), kSecond).empty());
    CHECK(find_lone_conditions(PreparedSet(measured), kThird) == Words{"load"});
  }
}
