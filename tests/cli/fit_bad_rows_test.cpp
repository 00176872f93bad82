// Bad rows of the files that fits read: refused together, or left out and told in terminal, JSON and page.
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "build_paths.h"
#include "sim/core/json.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using namespace rollrig;
using Catch::Contains;
using tests::flatten;
using tests::read_file;
using tests::run_program;
using tests::TemporaryFolder;

namespace {

const std::string kExamples = ROLLRIG_SOURCE_DIR "/assets/examples/";

/// Line 31 loses its fields, line 61 has a speed that there is not.
void make_two_bad_rows(const std::string& file) {
  std::istringstream in(read_file(file));
  std::string text;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::size_t comma = line.find(',');
    if (number == 31) line.resize(comma);
    if (number == 61) line.replace(comma + 1, line.find(',', comma + 1) - comma - 1, "2257.2");
    text += line + "\n";
  }
  tests::write_file(file, text);
}

void check_both_ways(const std::string& command, const TemporaryFolder& folder, std::size_t rows) {
  const auto refused = run_program(command + " --json -", folder.path());
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("2 bad rows") && Contains("31  (row)") && Contains("61  speed_km_h") &&
                              Contains("--skip-bad-rows"));
  const auto fit = run_program(command + " --skip-bad-rows --json fit.json --html page.html", folder.path());
  INFO(fit.err << fit.out);
  REQUIRE(fit.status == 0);
  const std::string counted = "bad rows: 2 of " + std::to_string(rows) + " rows left out";
  CHECK_THAT(flatten(fit.out), Contains(counted));
  CHECK_THAT(read_file(folder.file("page.html")), Contains(counted));
  const Json bad = Json::parse(read_file(folder.file("fit.json")))["bad_rows"];
  REQUIRE(bad.size() == 1);
  CHECK(bad[0]["rows"] == rows);
  CHECK(bad[0]["rows_left_out"] == 2);
  REQUIRE(bad[0]["bad"].size() == 2);
  CHECK(bad[0]["bad"][0]["line"] == 31);
  CHECK(bad[0]["bad"][1]["column"] == "speed_km_h");
}

}  // namespace

TEST_CASE("fit road-load refuses bad rows together, or leaves them out and tells it", "[fast]") {
  const TemporaryFolder folder;
  fs::copy(kExamples + "coastdowns.csv", folder.file("coast.csv"));
  const auto clean = run_program("fit road-load coast.csv --mass 2203 --json -", folder.path());
  REQUIRE(clean.status == 0);
  CHECK(Json::parse(clean.out)["bad_rows"].empty());
  make_two_bad_rows(folder.file("coast.csv"));
  check_both_ways("fit road-load coast.csv --mass 2203", folder, 2139);
}

TEST_CASE("fit drum-coastdown refuses bad rows together, or leaves them out and tells it", "[fast]") {
  const TemporaryFolder folder;
  fs::copy(kExamples + "drum_coastdown", folder.path(),
           fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  make_two_bad_rows(folder.file("loaded_250_left.csv"));
  check_both_ways("fit drum-coastdown coasts.toml", folder, 187);
}

TEST_CASE("fit road-load leaves bad rows out of the recording of a run", "[fast]") {
  const TemporaryFolder folder;
  REQUIRE(run_program("run coastdown --tire a50 --fidelity quasi_static --out run", folder.path()).status == 0);
  std::istringstream in(read_file(folder.file("run/recording.csv")));
  std::string text;
  int number = 0;
  for (std::string line; std::getline(in, line);) text += (++number == 400 ? line.substr(0, 9) : line) + "\n";
  tests::write_file(folder.file("run/recording.csv"), text);
  const auto refused = run_program("fit road-load run", folder.path());
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("line 400"));
  const auto fit = run_program("fit road-load run --skip-bad-rows", folder.path());
  INFO(fit.err);
  CHECK(fit.status == 0);
  CHECK_THAT(flatten(fit.out), Contains("rows left out (recording.csv, line 400"));
}
