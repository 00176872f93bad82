#include "scenarios/run/golden.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/temporary_folder.h"

using namespace rollrig;
using scenarios::GoldenValue;

namespace {
const double kNoTime = std::nan("");
std::vector<GoldenValue> two_values() {
  return {{"result.rrc_N_per_kN", kNoTime, 5.2, 1e-4, 1e-5}, {"drum_torque_Nm", 60.0, 45.0, 1e-4, 1e-5}};
}
}  // namespace

TEST_CASE("what is within tolerance is the same, what is beyond is named", "[fast]") {
  const auto golden = two_values();
  auto now = two_values();
  now[1].value += 4e-4;
  CHECK(scenarios::compare_with_golden(golden, now).problems.empty());
  now[1].value += 4e-4;
  const auto comparison = scenarios::compare_with_golden(golden, now);
  REQUIRE(comparison.problems.size() == 1);
  CHECK_THAT(comparison.problems[0], Catch::Contains("drum_torque_Nm at 60"));
  CHECK(comparison.worst_quantity == "drum_torque_Nm at 60 s");
}

TEST_CASE("a missing, a new and a NaN value are differences", "[fast]") {
  const auto golden = two_values();
  auto now = two_values();
  now[0].quantity = "result.other";
  CHECK(scenarios::compare_with_golden(golden, now).problems.size() == 2);
  now = two_values();
  now[0].value = kNoTime;
  CHECK(scenarios::compare_with_golden(golden, now).problems.size() == 1);
}

TEST_CASE("an update keeps the tolerances that were set by hand", "[fast]") {
  auto former = two_values();
  former[0].absolute_tolerance = 0.5;
  auto now = two_values();
  now[0].value = 5.4;
  scenarios::keep_tolerances(former, now);
  CHECK(now[0].absolute_tolerance == 0.5);
  CHECK(now[0].value == 5.4);
}

TEST_CASE("a golden that is written is read back", "[fast]") {
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("golden.json");
  tests::write_file(path, scenarios::write_golden(two_values()));
  CHECK(scenarios::compare_with_golden(scenarios::read_golden(path), two_values()).problems.empty());
}
