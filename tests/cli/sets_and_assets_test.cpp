// Measurement sets and assets on the command line: written, validated and fitted.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "build_paths.h"
#include "tests/cli/longest_line.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using rollrig::tests::flatten;
using rollrig::tests::longest_line;
using rollrig::tests::read_file;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

TEST_CASE("a set is written, validated and fitted", "[slow]") {
  const TemporaryFolder folder;
  REQUIRE(run_program("run speed_sweep --tire '" ROLLRIG_SOURCE_DIR
                      "/tests/published/combined_law/a50.toml' --sensors source --set 'speeds_km_h=[80, 120]' "
                      "--set measurement_cycles=1 --set settle_min=0 --write-set set --quiet",
                      folder.path())
              .status == 0);
  CHECK_THAT(run_program("validate set", folder.path()).out, Contains("2 runs"));
  const auto fit = run_program("fit tire set --out fitted --name mine", folder.path());
  INFO(fit.err);
  REQUIRE(fit.status == 0);
  CHECK(longest_line(fit.out) <= 80);
  CHECK(run_program("validate fitted/mine.toml", folder.path()).status == 0);
  const json result = json::parse(read_file(folder.file("fitted/fit.json")));
  const auto& parameters = result["parameters"];
  CHECK(std::count_if(parameters.begin(), parameters.end(), [](const json& at) { return !at["nuisance"]; }) == 6);
  CHECK(result["at_speeds"].size() == 2);
  CHECK_THAT(fit.out, Contains("heat capacity *") && Contains("class"));
  CHECK(run_program("run iso_28580 --tire fitted/mine.toml", folder.path()).status == 0);
}

TEST_CASE("a tire with a bounded law is fitted, without what belongs to lines over speed", "[fast]") {
  const TemporaryFolder folder;
  REQUIRE(run_program("run speed_sweep --tire c1_205_55r16 --sensors source --set 'speeds_km_h=[60, 110]' "
                      "--set measurement_cycles=1 --set settle_min=0 --write-set set --quiet",
                      folder.path())
              .status == 0);
  const auto fit = run_program("fit tire set --out fitted --name mine --html page.html", folder.path());
  INFO(fit.err);
  REQUIRE(fit.status == 0);
  CHECK_THAT(flatten(fit.out), Contains("two-step regression left out"));
  CHECK(longest_line(fit.out) <= 80);
  CHECK(run_program("validate fitted/mine.toml", folder.path()).status == 0);
  CHECK(json::parse(read_file(folder.file("fitted/fit.json")))["two_step"].is_null());
  CHECK(run_program("run iso_28580 --tire fitted/mine.toml --fidelity quasi_static", folder.path()).status == 0);
  const auto map = run_program("fit tire set --load-map", folder.path());
  CHECK(map.status == 2);
  CHECK_THAT(flatten(map.err), Contains("--load-map") && Contains("bounded"));
}

TEST_CASE("one warm-up gives a tire, and the numbers that it decides at its speed", "[fast]") {
  const TemporaryFolder folder;
  for (const char* tire : {"c1_205_55r16", "'" ROLLRIG_SOURCE_DIR "/tests/published/combined_law/a50.toml'"}) {
    REQUIRE(run_program(std::string("run warm_up --sensors source --write-set set --force --quiet --tire ") + tire,
                        folder.path())
                .status == 0);
    const auto fit = run_program("fit tire set --out fitted --force --name mine --html page.html", folder.path());
    INFO(fit.out << fit.err);
    REQUIRE(fit.status == 0);
    CHECK(longest_line(fit.out) <= 80);
    CHECK_THAT(fit.out, Contains("At the speeds of the set"));
    CHECK(json::parse(read_file(folder.file("fitted/fit.json")))["at_speeds"].size() == 1);
    CHECK(run_program("validate fitted/mine.toml", folder.path()).status == 0);
    CHECK(run_program("run iso_28580 --tire fitted/mine.toml --fidelity quasi_static", folder.path()).status == 0);
  }
}

TEST_CASE("a set that is written without sensors is said to hold no measurement", "[fast]") {
  const TemporaryFolder folder;
  const auto plain = run_program("run skim --tire a50 --write-set plain", folder.path());
  CHECK(plain.status == 0);
  CHECK_THAT(plain.out, Contains("nothing is measured in it") && Contains("--sensors"));
  const auto measured = run_program("run skim --tire a50 --sensors source --write-set measured", folder.path());
  CHECK(measured.status == 0);
  CHECK_THAT(measured.out, !Contains("nothing is measured"));
}

namespace {
/// A set of two runs in "set", its pressures in bar under a kPa heading where wanted.
void write_small_set(const TemporaryFolder& folder, bool in_bar) {
  REQUIRE(run_program("run speed_sweep --tire a50 --sensors source --set 'speeds_km_h=[80, 120]' "
                      "--set measurement_cycles=1 --set settle_min=0 --write-set set --quiet",
                      folder.path())
              .status == 0);
  if (!in_bar) return;
  for (const char* run : {"set/speed-80.csv", "set/speed-120.csv"}) {
    std::istringstream in(read_file(folder.file(run)));
    std::string line;
    std::getline(in, line);
    REQUIRE(line.substr(line.rfind(',') + 1) == "cavity_pressure_kPa");
    std::string out = line + "\n";
    while (std::getline(in, line)) {
      const std::size_t last = line.rfind(',') + 1;
      if (last < line.size()) line.replace(last, std::string::npos, std::to_string(std::stod(line.substr(last)) / 100));
      out += line + "\n";
    }
    write_file(folder.file(run), out);
  }
}
}  // namespace

TEST_CASE("a fit says that a column looks as if it were in another unit", "[slow]") {
  const TemporaryFolder good;
  write_small_set(good, false);
  const auto right = run_program("fit tire set", good.path());
  CHECK(right.status == 0);
  CHECK_THAT(right.out, !Contains("looks as if"));
  const TemporaryFolder bad;
  write_small_set(bad, true);
  const auto fit = run_program("fit tire set --json fit.json", bad.path());
  CHECK_THAT(fit.out + fit.err, Contains("cavity_pressure_kPa holds bar"));
  CHECK(fit.status == 1);
  CHECK_THAT(read_file(bad.file("fit.json")), Contains("cavity_pressure_kPa holds bar"));
}

TEST_CASE("a fit leaves out what a diagnosis leaves out", "[fast]") {
  const TemporaryFolder folder;
  write_small_set(folder, false);
  REQUIRE(run_program("fit tire set --json clean.json --quiet", folder.path()).status == 0);
  std::istringstream in(read_file(folder.file("set/speed-80.csv")));
  std::string out;
  std::string line;
  for (int row = 0; std::getline(in, line); ++row) {
    std::size_t at = 0;  // the fifth column is the torque
    for (int column = 0; column < 4; ++column) at = line.find(',', at) + 1;
    if (row > 0 && row % 97 == 0 && line[at] != ',') line.replace(at, line.find(',', at) - at, "-9999");
    out += line + "\n";
  }
  write_file(folder.file("set/speed-80.csv"), out);
  const auto fit = run_program("fit tire set --json spiked.json", folder.path());
  CHECK(fit.status == 0);
  CHECK_THAT(flatten(fit.out), Contains("samples of stuck sensors or that stand alone were left out"));
  const auto A0_N = [&](const char* file) {
    return json::parse(read_file(folder.file(file)))["parameters"][0]["value"].get<double>();
  };
  CHECK(A0_N("spiked.json") == Approx(A0_N("clean.json")).epsilon(0.02));
}

TEST_CASE("validate: 0 for a good set, 1 for one whose columns cannot be right, 2 for one that cannot be read",
          "[slow]") {
  const TemporaryFolder good;
  write_small_set(good, false);
  const auto passed = run_program("validate set", good.path());
  CHECK(passed.status == 0);
  CHECK_THAT(passed.out, Contains("good measurement set") && !Contains("measured nothing"));
  const TemporaryFolder bad;
  write_small_set(bad, true);
  const auto doubtful = run_program("validate set '" ROLLRIG_SOURCE_DIR "/assets/tires/a50.toml'", bad.path());
  CHECK(doubtful.status == 1);
  CHECK_THAT(doubtful.out, Contains("doubtful measurement set") && Contains("good tire"));  // the rest is looked at too
  fs::remove(bad.file("set/speed-80.csv"));
  CHECK(run_program("validate set", bad.path()).status == 2);
}

TEST_CASE("validate says how many rows are of runs that measured nothing", "[fast]") {
  const TemporaryFolder folder;
  write_small_set(folder, false);
  std::istringstream in(read_file(folder.file("set/speed-80.csv")));
  std::string line;
  std::getline(in, line);
  const auto columns = std::count(line.begin(), line.end(), ',') + 1;
  std::string out = line + "\n";
  std::size_t rows = 0;
  for (; std::getline(in, line); ++rows) {
    std::size_t last = line.size();
    for (int i = 0; i < 3; ++i) last = line.rfind(',', last - 1);  // torque, temperature, pressure
    out += line.substr(0, last) + ",,,\n";
  }
  REQUIRE(columns >= 7);
  write_file(folder.file("set/speed-80.csv"), out);
  const auto run = run_program("validate set", folder.path());
  INFO(run.out << run.err);
  CHECK_THAT(flatten(run.out), Contains(std::to_string(rows) + " of them in runs that measured nothing"));
}

TEST_CASE("every asset is valid", "[slow]") {
  for (const char* kind : {"tires", "rigs", "sensors", "regression"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(ROLLRIG_SOURCE_DIR) / "assets" / kind)) {
      if (entry.path().extension() != ".toml") continue;
      const auto run = run_program("validate '" + entry.path().string() + "'");
      INFO(run.err);
      CHECK(run.status == 0);
    }
  }
}

TEST_CASE("every number of an asset cites its place in the source or says that it is assumed", "[fast]") {
  const std::vector<const char*> cited_by{"§",         "Table", "Figure",  "(3.",         "Assumed",     "Calibrated",
                                          "ISO 28580", "EPREL", "UN R117", "Designation", "Example file"};
  for (const char* kind : {"tires", "rigs", "sensors"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(ROLLRIG_SOURCE_DIR) / "assets" / kind)) {
      std::istringstream in(read_file(entry.path().string()));
      for (std::string line; std::getline(in, line);) {
        const bool assigns_number = line.find(" = ") != std::string::npos && line.find('"') == std::string::npos;
        if (!assigns_number || line == "matrix = [") continue;  // [correlation], of calibrated numbers
        INFO(entry.path() << ": " << line);
        const bool is_cited = std::any_of(cited_by.begin(), cited_by.end(),
                                          [&](const char* word) { return line.find(word) != std::string::npos; });
        CHECK(is_cited);
      }
    }
  }
}
