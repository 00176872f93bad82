// A, B, C of a public test-car record, by the command line: README.md.
#include <catch2/catch.hpp>

#include "build_paths.h"
#include "sim/core/json.h"
#include "tests/support/run_program.h"

using namespace rollrig;
using tests::run_program;

namespace {

const std::string kHere = ROLLRIG_SOURCE_DIR "/tests/published/test_car_record/";

/// The record at a speed, in lbf and mph.
double record_N(double speed_km_h) {
  const double speed_mph = speed_km_h / 1.609344;
  return 4.4482216152605 * (33.2 - 0.0857 * speed_mph + 0.02006 * speed_mph * speed_mph);
}

}  // namespace

TEST_CASE("a public record's A, B, C come back from the car's coastdown, by the command line", "[published]") {
  const auto run = run_program("run " + kHere + "run.toml --json -");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const Json result = Json::parse(run.out)["result"];
  int speeds = 0;
  for (const Json& point : result["force_N"]) {
    const double speed_km_h = point["speed_km_h"].get<double>();
    INFO(speed_km_h);
    CHECK(point["force_N"].get<double>() == Approx(record_N(speed_km_h)).epsilon(0.005));
    ++speeds;
  }
  CHECK(speeds == 7);
  // The coefficients themselves: 147.7 N, -0.2369 N/(km/h), 0.03445 N/(km/h)2
  CHECK(result["A_N"].get<double>() == Approx(147.68).epsilon(0.01));
  CHECK(result["B_N_per_km_h"].get<double>() == Approx(-0.2369).margin(0.02));
  CHECK(result["C_N_per_km_h2"].get<double>() == Approx(0.03445).epsilon(0.01));
}

TEST_CASE("rollers are set to a public record within 10 N, and bear less than it by the tires' loss", "[published]") {
  const auto run = run_program("run " + kHere + "dyno.toml --json -");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const Json result = Json::parse(run.out)["result"];
  CHECK(result["within_criterion"].get<bool>());
  CHECK(result["target_A_N"].get<double>() == Approx(147.68).epsilon(1e-4));
  for (const Json& point : result["differences"]) CHECK(std::abs(point["difference_N"].get<double>()) < 10.0);
  // Four tires of 4 to 6 N/kN under 18.9 kN
  CHECK(result["target_A_N"].get<double>() - result["set_A_N"].get<double>() > 50.0);
  CHECK(result["target_A_N"].get<double>() - result["set_A_N"].get<double>() < 130.0);
}
