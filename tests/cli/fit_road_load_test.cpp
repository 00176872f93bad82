#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "sim/core/csv.h"
#include "sim/core/json.h"
#include "tests/cli/longest_line.h"
#include "tests/support/coastdown_study.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using Catch::Contains;
using tests::longest_line;
using tests::read_file;
using tests::run_program;
using tests::TemporaryFolder;

TEST_CASE("fit road-load: table of 80 columns, JSON and residuals", "[fast]") {
  const TemporaryFolder folder;
  tests::write_file(folder.file("coast.csv"), tests::write_coastdown_csv(tests::simulate_coastdowns({}, 1)));
  const auto run = run_program("fit road-load coast.csv --mass 2100 --out fitted --html page.html", folder.path());
  INFO(run.err << run.out);
  REQUIRE(run.status == 0);
  CHECK(longest_line(run.out) <= 80);
  CHECK_THAT(run.out, Contains("N/(km/h)2") && Contains("not checked") && Contains("3 % of the mass as tested"));
  const std::string page = read_file(folder.file("page.html"));
  for (const char* shown :
       {"effective mass", "force, N", "scatter of speed", "drift of coast times", "runs each way"}) {
    INFO(shown);
    CHECK(run.out.find(shown) != std::string::npos);
    CHECK(page.find(shown) != std::string::npos);
  }
  const Json json = Json::parse(read_file(folder.file("fitted/road_load.json")));
  CHECK(json["format"] == "rollrig-road-load/1");
  CHECK(json["A_N"].get<double>() == Approx(120.0).epsilon(0.01));
  CHECK(json["B_N_per_km_h"].get<double>() == Approx(0.5).epsilon(0.1));
  CHECK(json["C_N_per_km_h2"].get<double>() == Approx(0.03).epsilon(0.01));
  for (const char* key : {"A_N_sd", "B_N_per_km_h_sd", "C_N_per_km_h2_sd"}) CHECK(json[key].get<double>() > 0.0);
  CHECK(json["correlation"][0][0].get<double>() == Approx(1.0));
  CHECK(std::abs(json["correlation"][0][1].get<double>()) < 1.0);
  CHECK(json["headings"].size() == 2);
  CHECK(json["session_drift"].size() == 1);
  CHECK(json["corrected"]["ambient"] == true);
  for (const Json& check : json["checks"]) {
    for (const char* key : {"name", "status", "found", "limit", "clause"}) CHECK(check[key].is_string());
  }
  const CsvTable residuals = CsvTable::read(folder.file("fitted/residuals.csv"));
  CHECK(residuals.row_count() == json["residuals"].size());
  CHECK(residuals.has("residual_N"));
  // what is left is centered, in proportion to its standard deviation
  double sum = 0.0;
  for (const Json& point : json["residuals"]) {
    CHECK(point["force_N"].get<double>() - point["fit_N"].get<double>() ==
          Approx(point["residual_N"].get<double>()).margin(1e-9));
    sum += point["residual_N"].get<double>() * std::sqrt(point["weight"].get<double>());
  }
  CHECK(std::abs(sum / static_cast<double>(json["residuals"].size())) < 0.3);
}

TEST_CASE("fit road-load: per unit of mass, bounds, one heading, JSON alone", "[fast]") {
  const TemporaryFolder folder;
  tests::CoastdownStudy study;
  study.pairs = 1;
  tests::write_file(folder.file("coast.csv"), tests::write_coastdown_csv(tests::simulate_coastdowns(study, 1)));
  const auto json_of = [&](const std::string& options) {
    const auto run = run_program("fit road-load coast.csv --json - " + options, folder.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return Json::parse(run.out);
  };
  const Json per_mass = json_of("--per-mass");
  CHECK(per_mass["A_m_s2"].get<double>() == Approx(120.0 / 2163.0).epsilon(0.01));
  const Json bounded = json_of("--mass 2100 --bounds A=:,B=0.6:,C=:");
  CHECK(bounded["B_N_per_km_h"].get<double>() == Approx(0.6));
  CHECK(bounded["B_N_per_km_h_sd"].is_null());
  CHECK(bounded["on_bound"][0] == "B_N_per_km_h");
  CHECK_THAT(bounded["warnings"].dump(), Contains("bounds are on"));
  CHECK(json_of("--mass 2100 --effective-mass 2200")["A_N"].get<double>() == Approx(120.0 * 2200 / 2163).epsilon(0.01));
  const std::string text = read_file(folder.file("coast.csv"));
  std::string single;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.find(",-,") == std::string::npos) single += line + "\n";
  }
  tests::write_file(folder.file("single.csv"), single);
  const auto run = run_program("fit road-load single.csv --mass 2100", folder.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("warning: not both headings"));
  CHECK(longest_line(run.out) <= 80);
  CHECK(run_program("fit road-load single.csv --mass 2100 --quiet", folder.path()).out.empty());
}

TEST_CASE("fit road-load: a target has each coefficient once", "[fast]") {
  const TemporaryFolder folder;
  tests::write_file(folder.file("coast.csv"), tests::write_coastdown_csv(tests::simulate_coastdowns({}, 1)));
  const auto run = [&](const std::string& target) {
    return run_program("fit road-load coast.csv --mass 2100 --target " + target, folder.path());
  };
  CHECK(run("A=130,B=0.5,C=0.03").status == 0);
  for (const auto& [target, says] : {std::pair("A=130,B=0.5", "the target has C missing"),
                                     std::pair("A=130,f0=131,B=0.5,C=0.03", "the target has A more than once")}) {
    const auto wrong = run(target);
    CHECK(wrong.status == 2);
    CHECK_THAT(wrong.err, Contains(says));
  }
}
