// Files of one's own: a tire, a rig, a vehicle, and a set from logs that nothing describes.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "build_paths.h"
#include "measurements/measurement_set.h"
#include "tests/cli/longest_line.h"
#include "tests/support/foreign_logs.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using rollrig::tests::flatten;
using rollrig::tests::LoggerStyle;
using rollrig::tests::longest_line;
using rollrig::tests::read_file;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

namespace {

const std::string kExample = ROLLRIG_SOURCE_DIR "/assets/examples/hidden_effect";

rollrig::tests::ProgramResult run_well(const std::string& arguments, const TemporaryFolder& folder) {
  const auto result = run_program(arguments, folder.path());
  INFO("rollrig " << arguments << "\n" << result.out << result.err);
  CHECK(result.status == 0);
  CHECK(longest_line(result.out) <= 80);
  return result;
}

/// Semicolons, decimal commas, a row of units, dates and times of day, m/s and bar.
LoggerStyle make_german_style() {
  LoggerStyle style;
  style.is_german = true;
  style.separator = ';';
  style.decimal = ',';
  style.time = LoggerStyle::Time::kClockAndDate;
  style.units = LoggerStyle::Units::kRow;
  style.speed_unit = "m/s";
  style.load_unit = "kN";
  style.lines_above = 2;
  style.gap_word = "---";
  style.counts_rows = true;
  return style;
}

/// English names without a word of units but in the headings, spreadsheet days, psi and degF.
LoggerStyle make_english_style() {
  LoggerStyle style;
  style.separator = '\t';
  style.time = LoggerStyle::Time::kSpreadsheetDays;
  style.units = LoggerStyle::Units::kParentheses;
  style.wording = 1;
  style.load_unit = "kgf";
  style.temperature_unit = "degF";
  style.pressure_unit = "psi";
  return style;
}

json diagnose(const std::string& set, const TemporaryFolder& folder) {
  run_well("diagnose " + set + " --json " + fs::path(set).filename().string() + ".json --quiet", folder);
  return json::parse(read_file(folder.file(fs::path(set).filename().string() + ".json")));
}

}  // namespace

TEST_CASE("a new tire runs in the tests of tires and of vehicles, and is not written over", "[slow]") {
  const TemporaryFolder folder;
  const auto made = run_well("new tire --size 205/55R16 --load-index 91 --rrc 8.2 --name mine", folder);
  CHECK_THAT(made.out, Contains("RRc simulated") && Contains("8.200 N/kN") && Contains("mine.toml"));
  CHECK_THAT(run_well("validate mine.toml", folder).out, Contains("good") && !Contains("ISO 28580"));
  const auto iso = run_well("run iso_28580 --tire ./mine.toml", folder);
  CHECK_THAT(flatten(iso.out), Contains("tire file says 8.200 N/kN, difference +0.0"));
  for (const char* scenario :
       {"warm_up", "load_sweep", "pressure_sweep", "speed_sweep", "transient_skim", "coastdown", "dyno_setting"}) {
    run_well(std::string("run ") + scenario + " --tire ./mine.toml --fidelity quasi_static", folder);
  }
  const std::string before = read_file(folder.file("mine.toml"));
  CHECK(run_program("new tire --size 205/55R16 --load-index 91 --rrc 9 --name mine", folder.path()).status == 2);
  CHECK(read_file(folder.file("mine.toml")) == before);
  run_well("new tire --size 205/55R16 --load-index 91 --rrc 9 --name mine --force", folder);
  CHECK(read_file(folder.file("mine.toml")) != before);
}

TEST_CASE("validate warns of a tire whose RRc is not what its numbers give", "[fast]") {
  const TemporaryFolder folder;
  run_well("new tire --size 205/55R16 --load-index 91 --rrc 8.2 --name mine", folder);
  std::string text = read_file(folder.file("mine.toml"));
  const std::string stated = "rrc_N_per_kN = 8.2";
  text.replace(text.find(stated), stated.size(), "rrc_N_per_kN = 8.0");
  write_file(folder.file("mine.toml"), text);
  CHECK_THAT(flatten(run_well("validate mine.toml", folder).out),
             Contains("gives an RRc of 8.200 N/kN, +2.5 % from the 8.000 N/kN"));
}

TEST_CASE("a new rig and a new vehicle carry a new tire", "[slow]") {
  const TemporaryFolder folder;
  run_well("new tire --size 205/55R16 --load-index 91 --rrc 8.2 --name mine", folder);
  run_well("new rig --name drum --diameter 1.7 --inertia 280", folder);
  run_well("new rig --kind flat_belt --name belt --moving-mass 350", folder);
  run_well("new rig --kind dyno --name rollers --diameter 1.2", folder);
  run_well("new vehicle --name car --mass 1900 --abc 147.7 -0.237 0.0345", folder);
  run_well("new vehicle --name car2 --mass 1900 --abc-lbf-mph 33.2 -0.0857 0.02006 --driven all", folder);
  for (const char* file : {"drum", "belt", "rollers", "car", "car2"}) {
    run_well(std::string("validate ") + file + ".toml", folder);
  }
  run_well("run iso_28580 --tire ./mine.toml --rig ./drum.toml --fidelity quasi_static", folder);
  run_well("run warm_up --tire ./mine.toml --rig ./belt.toml --fidelity quasi_static", folder);
  run_well("run coastdown --tire ./mine.toml --vehicle ./car.toml --fidelity quasi_static", folder);
  run_well("run coastdown --tire ./mine.toml --rig ./rollers.toml --vehicle ./car2.toml --fidelity quasi_static",
           folder);
}

TEST_CASE("files of a set that lack a set.toml get one", "[fast]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("logs"));
  for (const char* run : {"1-warm-up-120", "2-load-sweep", "3-warm-up-40"}) {
    fs::copy(kExample + "/" + run + ".csv", folder.file(std::string("logs/") + run + ".csv"));
  }
  run_well("new set logs --tire '" + kExample + "/tire.toml' --rig '" + kExample + "/rig.toml'", folder);
  CHECK_THAT(run_well("validate logs", folder).out, Contains("3 runs"));
}

TEST_CASE("the mapping that is written makes the set that import --guess makes", "[slow]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("logs"));
  rollrig::tests::write_foreign_logs(rollrig::measurements::read_measurement_set(kExample), make_german_style(),
                                     folder.file("logs"));
  const std::string machine = " --tire '" + kExample + "/tire.toml' --rig '" + kExample + "/rig.toml'";
  const auto guessed = run_well("import --guess logs --out campaign" + machine, folder);
  CHECK_THAT(flatten(guessed.out),
             Contains("speed_km_h: 'Geschwindigkeit', m/s") && Contains("not read: Messwert Nr."));
  run_well("new set logs" + machine, folder);
  run_well("import logs/import.toml --out again --quiet", folder);
  for (const char* file : {"1-warm-up-120.csv", "2-load-sweep.csv", "3-warm-up-40.csv", "set.toml"}) {
    CHECK(read_file(folder.file(std::string("campaign/") + file)) ==
          read_file(folder.file(std::string("again/") + file)));
  }
  run_well("import campaign/import.toml --out third --quiet", folder);  // paths hold there, too
}

TEST_CASE("from a folder of logs to a diagnosis: three commands, and the cause of the original set", "[slow]") {
  const TemporaryFolder folder;
  const json truth = diagnose(kExample, folder);
  REQUIRE(truth["verdict"] == "explained");
  int number = 0;
  for (const LoggerStyle& style : {make_german_style(), make_english_style()}) {
    const std::string logs = "logs" + std::to_string(++number);
    const std::string set = "set" + std::to_string(number);
    fs::create_directory(folder.file(logs));
    rollrig::tests::write_foreign_logs(rollrig::measurements::read_measurement_set(kExample), style, folder.file(logs));
    run_well("import --guess " + logs + " --tire '" + kExample + "/tire.toml' --rig '" + kExample +
                 "/rig.toml' --out " + set,
             folder);
    run_well("validate " + set, folder);
    const json found = diagnose(set, folder);
    INFO(found["causes"].dump() << "\n" << found["probability"].dump() << "\n" << found["unknown_like"].dump());
    CHECK(found["verdict"] == truth["verdict"]);
    CHECK(found["causes"][0]["effects"] == truth["causes"][0]["effects"]);
  }
}

TEST_CASE("from an RRc and a log of a warm-up to a tire: one command", "[slow]") {
  const TemporaryFolder folder;
  // the specimen loses a tenth more than its label says, and falls faster with temperature
  run_well("new tire --size 205/55R16 --load-index 91 --rrc 9.0 --name specimen", folder);
  run_well(
      "run speed_sweep --tire ./specimen.toml --sensors source --set 'speeds_km_h=[60, 110]' --set "
      "measurement_cycles=1 --set settle_min=0 --set tire.bounded.fall_per_degC=0.014 --write-set truth --quiet",
      folder);
  LoggerStyle style = make_german_style();
  style.time = LoggerStyle::Time::kSeconds;
  fs::create_directory(folder.file("logs"));
  rollrig::tests::write_foreign_logs(rollrig::measurements::read_measurement_set(folder.file("truth")), style,
                                     folder.file("logs"));
  const auto made =
      run_program("new tire --size 205/55R16 --load-index 91 --rrc 8.2 --name mine --warm-up logs", folder.path());
  INFO(made.out << made.err);
  REQUIRE(made.status == 0);
  CHECK_THAT(flatten(made.out), Contains("from the 8.200 N/kN that the file states"));
  CHECK_THAT(run_well("validate mine.toml", folder).out, Contains("good"));
  const auto rrc_of = [&folder](const std::string& tire, const std::string& more) {
    run_well("run iso_28580 --tire ./" + tire + ".toml --json " + tire + ".json --quiet" + more, folder);
    return json::parse(read_file(folder.file(tire + ".json")))["result"]["rrc_N_per_kN"].get<double>();
  };
  // the torque sensor is good to 0.2 N of 40 N (k = 1)
  CHECK(rrc_of("mine", "") == Approx(rrc_of("specimen", " --set tire.bounded.fall_per_degC=0.014")).epsilon(0.01));
}
