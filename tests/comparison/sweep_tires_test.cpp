// Sweeps and campaigns over tires: each point is the run of its tire, and results name it.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "build_paths.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using namespace rollrig::tests;

namespace {

const std::string kSweep = "sweep iso_28580 --fidelity quasi_static ";

std::string read_asset(const char* tire) {
  return read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/tires/" + tire + ".toml");
}

}  // namespace

TEST_CASE("each point of a sweep over tires is the run of its tire", "[fast]") {
  const TemporaryFolder folder;
  const ProgramResult swept =
      run_program(kSweep + "--vary tire=a40,a50 --vary pressure_kPa=220,260 --out s --html page.html", folder.path());
  INFO(swept.out << swept.err);
  REQUIRE(swept.status == 0);
  CHECK_THAT(read_file(folder.file("s/sweep.csv")), Catch::StartsWith("tire,pressure_kPa,") && Contains("\na40,220,"));
  const json points = json::parse(read_file(folder.file("s/sweep.json")))["points"];
  REQUIRE(points.size() == 4);
  const ProgramResult alone =
      run_program("run iso_28580 --fidelity quasi_static --tire a50 --set pressure_kPa=260 --json -", folder.path());
  CHECK(points[3]["set"] == json({{"tire", "a50"}, {"pressure_kPa", "260"}}));
  CHECK(points[3]["result"] == json::parse(alone.out)["result"]);
  const json manifests = json::parse(read_file(folder.file("s/manifests.json")))["manifests"];
  CHECK(manifests[0]["tire"]["name"] == "a40");
  CHECK(manifests[2]["tire"]["name"] == "a50");
}

TEST_CASE("a tire that is a file goes by its name, two of one name by their files", "[fast]") {
  const TemporaryFolder folder;
  std::string own = read_asset("a40");
  own.replace(own.find("name = \"a40\""), 12, "name = \"own\"");
  write_file(folder.file("first.toml"), own);
  write_file(folder.file("second.toml"), own);
  const ProgramResult one = run_program(kSweep + "--vary tire=first.toml,a50 --out s", folder.path());
  INFO(one.out << one.err);
  REQUIRE(one.status == 0);
  CHECK_THAT(read_file(folder.file("s/sweep.csv")), Contains("\nown,"));
  REQUIRE(run_program(kSweep + "--vary tire=first.toml,second.toml --out t", folder.path()).status == 0);
  CHECK_THAT(read_file(folder.file("t/sweep.csv")), Contains("\nfirst.toml,") && Contains("\nsecond.toml,"));
}

TEST_CASE("a tire that is given in two spellings is refused", "[fast]") {
  const TemporaryFolder folder;
  const std::string file = std::string(ROLLRIG_SOURCE_DIR) + "/assets/tires/a50.toml";
  const ProgramResult refused =
      run_program("sweep skim --fidelity quasi_static --vary tire=a50," + file, folder.path());
  CHECK(refused.status == 2);
  CHECK_THAT(flatten(refused.err), Catch::Contains("a tire is varied twice") && Catch::Contains("a50.toml"));
}

TEST_CASE("a campaign over tires refuses to go on with a tire that has changed", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("own.toml"), read_asset("a40"));
  const ProgramResult made =
      run_program("campaign new c iso_28580 --fidelity quasi_static --vary tire=own.toml,a50 --quiet", folder.path());
  INFO(made.out << made.err);
  REQUIRE(made.status == 0);
  const json definition = json::parse(read_file(folder.file("c/campaign.json")));
  CHECK(definition["files"].dump().find("own.toml") != std::string::npos);
  CHECK(definition["factors"][0]["values"][1] == "a50");
  std::string changed = read_asset("a40");
  changed.replace(changed.find("loss_N = 43.46527"), 17, "loss_N = 44.46527");
  write_file(folder.file("own.toml"), changed);
  CHECK(run_program("campaign run c --quiet", folder.path()).status == 2);
  write_file(folder.file("own.toml"), read_asset("a40"));
  CHECK(run_program("campaign run c --quiet", folder.path()).status == 0);
  REQUIRE(run_program("campaign export c --csv c.csv --quiet", folder.path()).status == 0);
  CHECK_THAT(read_file(folder.file("c.csv")), Contains("a50"));
}
