// Pages in headless Chromium, from file://: no message on the console, nothing asked of a network,
// charts drawn in pixels, the slider moves the animation, first paint within two seconds, no larger than two megabytes.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "build_paths.h"
#include "sim/core/csv.h"
#include "tests/support/run_program.h"
#include "tests/validation/scoring/validation_set_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

constexpr std::uintmax_t kMostBytes = 2'000'000;

/// What check_page.mjs says of a page; `asked` are its options.
void check_page(const std::string& page, const std::string& asked) {
  CHECK(fs::file_size(page) <= kMostBytes);
  const std::string script = std::string(ROLLRIG_SOURCE_DIR) + "/tests/report/check_page.mjs";
  const ProgramResult checked = run_other(ROLLRIG_NODE, "'" + script + "' '" + page + "' " + asked);
  INFO(checked.out << checked.err);
  CHECK(checked.status == 0);
}

/// Runs `rollrig <arguments> --html page.html` and checks the page.
void check_command(const TemporaryFolder& folder, const std::string& arguments, const std::string& asked,
                   int status = 0) {
  const ProgramResult run = run_program(arguments + " --html page.html", folder.path());
  INFO(arguments << '\n' << run.out << run.err);
  REQUIRE(run.status == status);
  check_page(folder.file("page.html"), asked);
}

/// A set of two warm-ups with an effect in it.
void write_set(const TemporaryFolder& folder) {
  const ProgramResult made = run_program(
      "run speed_sweep --tire a50 --sensors source --set 'speeds_km_h=[80,120]' --set warm_up_min=10 --set "
      "settle_min=0 "
      "--set effects.bearing_warmup.fall_per_K=0.03 --write-set set --quiet",
      folder.path());
  INFO(made.err);
  REQUIRE(made.status == 0);
}

}  // namespace

TEST_CASE("page of an ISO test on the multibody drum", "[slow]") {
  const TemporaryFolder folder;
  check_command(
      folder, "run iso_28580 --tire a50 --out run",
      "--charts 2 --animation --section --equations 4 --recording '" + folder.file("run/recording.csv") + "'");
}

TEST_CASE("page of a multi-cycle test of a quarter on its roller", "[slow]") {
  check_command(TemporaryFolder(), "run sae_j1634 --tire a50 --set wheels=1", "--charts 4 --animation --section");
}

TEST_CASE("page of two hours with ten rows a second", "[slow]") {
  const TemporaryFolder folder;
  write_file(folder.file("long.toml"),
             "format = \"rollrig-run/1\"\nscenario = \"warm_up\"\ntire = \"a50\"\nsensors = \"source\"\n"
             "sample_interval_s = 0.1\n[settings]\nwarm_up_min = 120.0\n");
  check_command(folder, "run long.toml", "--charts 2 --animation");
}

TEST_CASE("pages of tires, sets and runs whose names hold a script", "[slow]") {
  const TemporaryFolder folder;
  const std::string name = "<img src=x onerror=attacked=1>";
  std::string tire = read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/tires/a50.toml");
  const std::size_t at = tire.find("name");
  tire.replace(at, tire.find('\n', at) - at, "name = '</script><script>attacked=1</script>" + name + "'");
  write_file(folder.file(name + ".toml"), tire);
  const std::string quick = " --fidelity quasi_static ";
  const std::string shows = " --shows '" + name + "'";
  const std::string alone = " --texts-alone";  // the page of a diagnosis, the last one, is checked in full
  check_command(folder, "run skim --tire './" + name + ".toml'" + quick, "--charts 2" + shows + alone);
  write_file(folder.file(name + ".csv"),
             "time_s,speed_km_h,load_N,ambient_degC\n0,0,5000,25\n30,80,5000,25\n300,80,5000,25\n");
  fs::copy_file(folder.file(name + ".csv"), folder.file("b" + name + ".csv"));
  check_command(folder,
                "sweep follow_drum --tire a50" + quick + "--vary pressure_kPa=250,260 --vary 'program=" + name +
                    ".csv,b" + name + ".csv'",
                "--charts 1" + shows + alone);
  write_set(folder);
  const std::string set_file = read_file(folder.file("set/set.toml"));
  std::string named = set_file;
  for (std::size_t from = named.find("speed-80"); from != std::string::npos;
       from = named.find("speed-80", from + name.size())) {
    named.replace(from, 8, name);
  }
  write_file(folder.file("set/set.toml"), named);
  fs::rename(folder.file("set/speed-80.csv"), folder.file("set/" + name + ".csv"));
  check_command(folder, "fit tire set", "--charts 3" + shows + alone);
  check_command(folder, "diagnose set --only bearing_warmup,load_exponent", "--charts 3" + shows);
}

TEST_CASE("page of a set with a run that measured nothing", "[slow]") {
  const TemporaryFolder folder;
  write_set(folder);
  const std::string run = folder.file("set/speed-80.csv");
  const CsvTable csv = CsvTable::read(run);
  const std::vector<std::string> kept{"time_s", "speed_km_h", "load_N", "ambient_degC"};
  CsvWriter given(kept);
  std::vector<std::vector<std::string>> columns;
  for (const std::string& name : kept) columns.push_back(csv.text(name));
  for (std::size_t row = 0; row < csv.row_count(); ++row) {
    for (const auto& column : columns) given.add(column[row]);
    given.end_row();
  }
  write_file(run, given.take());
  check_command(folder, "diagnose set --only bearing_warmup,load_exponent", "--charts 2");
}

TEST_CASE("page of a score", "[slow]") {
  const ValidationSetFolder made;
  REQUIRE(run_validation("run set --quiet", made.folder.path()).status == 0);
  REQUIRE(run_validation("score set --quiet --html page.html", made.folder.path()).status == 0);
  const std::string page = made.folder.file("page.html");
  check_page(page, "--charts 1");
  const std::string boxes = std::string(ROLLRIG_SOURCE_DIR) + "/tests/report/check_boxes.mjs";
  const ProgramResult checked = run_other(ROLLRIG_NODE, "'" + boxes + "' '" + page + "'");
  INFO(checked.out << checked.err);
  CHECK(checked.status == 0);
}

TEST_CASE("a page goes to standard output alone, and is refused where it cannot be", "[fast]") {
  const TemporaryFolder folder;
  const std::string quick = "run skim --tire a50 --fidelity quasi_static ";
  const ProgramResult out = run_program(quick + "--html -", folder.path());
  CHECK(out.status == 0);
  CHECK_THAT(out.out, Catch::StartsWith("<!doctype html>"));
  CHECK_THAT(out.out, Catch::EndsWith("</html>\n"));
  CHECK(folder.entry_count() == 0);
  for (const char* asked : {"--html nowhere/page.html", "--html . ", "--html - --json -"}) {
    const ProgramResult refused = run_program(quick + asked, folder.path());
    INFO(asked << refused.err);
    CHECK(refused.status == 2);
    CHECK(refused.out.empty());
    CHECK(folder.entry_count() == 0);
  }
}
