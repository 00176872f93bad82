// Road loads from rollrig's own recordings, in the units of both sides of the ocean.
#include <catch2/catch.hpp>

#include "sim/core/json.h"
#include "tests/cli/longest_line.h"
#include "tests/support/coastdown_study.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using Catch::Contains;
using tests::read_file;
using tests::run_program;
using tests::TemporaryFolder;

TEST_CASE("the recording of a simulated coastdown gives the road load that the run itself says", "[fast]") {
  const TemporaryFolder folder;
  REQUIRE(run_program("run coastdown --tire a50 --fidelity quasi_static --out run", folder.path()).status == 0);
  const Json of_run = Json::parse(read_file(folder.file("run/result.json")))["result"];
  for (const char* input : {"run", "run/recording.csv"}) {
    const auto fit = run_program(std::string("fit road-load ") + input + " --json -", folder.path());
    INFO(fit.err);
    REQUIRE(fit.status == 0);
    const Json json = Json::parse(fit.out);
    CHECK(json["options"]["mass_kg"].get<double>() == Approx(2202.58));
    for (const char* key : {"A_N", "B_N_per_km_h", "C_N_per_km_h2"}) {
      CHECK(json[key].get<double>() == Approx(of_run[key].get<double>()).epsilon(1e-3));
    }
  }
}

TEST_CASE("f0, f1, f2 and A, B, C in lbf and mph are the same force, and bounds and targets go in both", "[fast]") {
  const TemporaryFolder folder;
  tests::write_file(folder.file("coast.csv"), tests::write_coastdown_csv(tests::simulate_coastdowns({}, 1)));
  const auto run = [&](const std::string& options) {
    const auto result = run_program("fit road-load coast.csv --mass 2100 " + options, folder.path());
    INFO(result.err);
    REQUIRE(result.status == 0);
    return result.out;
  };
  const Json json = Json::parse(run("--json -"));
  const Json& epa = json["lbf_mph"];
  const Json& wltp = json["f0_f1_f2"];
  const double mph = 60.0, km_h = 60.0 * 1.609344;
  const double lbf = epa["A_lbf"].get<double>() + mph * epa["B_lbf_per_mph"].get<double>() +
                     mph * mph * epa["C_lbf_per_mph2"].get<double>();
  const double N = wltp["f0_N"].get<double>() + km_h * wltp["f1_N_per_km_h"].get<double>() +
                   km_h * km_h * wltp["f2_N_per_km_h2"].get<double>();
  CHECK(lbf * 4.4482216152605 == Approx(N));
  const Json bounded = Json::parse(run("--bounds A_lbf=30: --json -"));
  CHECK(bounded["lbf_mph"]["A_lbf"].get<double>() == Approx(30.0));
  CHECK(bounded["on_bound"][0] == "A_N");
  CHECK(bounded["ci95"]["A_N"][0].get<double>() == Approx(30.0 * 4.4482216152605));
  CHECK(Json::parse(run("--bounds f1=0.6: --json -"))["B_N_per_km_h"].get<double>() == Approx(0.6));
  const std::string text = run("--target A_lbf=27,B_lbf=0.18,C_lbf=0.0175 --bounds f1=0.6:");
  CHECK_THAT(text, Contains("lbf/mph2") && Contains("on its limit") && Contains("over target") && Contains("A, f0"));
  CHECK(tests::longest_line(text) <= 80);
}

TEST_CASE("a run that is left out is not used", "[fast]") {
  const TemporaryFolder folder;
  tests::CoastdownStudy study;
  study.pairs = 3;
  tests::write_file(folder.file("coast.csv"), tests::write_coastdown_csv(tests::simulate_coastdowns(study, 1)));
  const auto result = run_program("fit road-load coast.csv --mass 2100 --leave-out 3 --json -", folder.path());
  REQUIRE(result.status == 0);
  const Json fit = Json::parse(result.out);
  REQUIRE(!fit["residuals"].empty());
  for (const Json& point : fit["residuals"]) CHECK(point["run"] != "3");
}
