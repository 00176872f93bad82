// Every message on docs/troubleshooting.md is provoked, and is as the page has it, with its exit status.
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "build_paths.h"
#include "sim/core/file_io.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using namespace rollrig::tests;

namespace {

enum ExitStatus { kDone = 0, kDoubtful = 1, kWrongInput = 2, kFailed = 3 };

struct Mistake {
  std::string section;  // of the page
  std::string make;     // what a user did before: commands of a shell beside campaign/, a copy of the example
  std::string command;
  ExitStatus status;
};

/// What changes a column, its number in front, of the rows of a file.
std::string edit_rows(const std::string& file, const std::string& program) {
  return "awk -F, -v OFS=, 'NR > 1 { " + program + " } { print }' campaign/" + file + " > new && mv new campaign/" +
         file;
}

std::string edit_runs(const std::string& program) {
  std::string commands;
  for (const char* run : {"1-warm-up-120.csv", "2-load-sweep.csv", "3-warm-up-40.csv"}) {
    commands += edit_rows(run, program) + "\n";
  }
  return commands;
}

const std::string kFirst = "campaign/1-warm-up-120.csv";
const std::string kNoPackages =
    "mkdir bin && ln -s /bin/cat /usr/bin/dirname bin && cd bin && echo 'echo 1000' > id && echo exit 0 > dpkg &&"
    "echo 'for p; do case $p in -*|libceres-dev|libsimbody-dev) ;; *) echo $p=install ok installed;; esac; done' >"
    " dpkg-query && chmod +x *";

/// In the order of the page; a section with several messages has several.
const std::vector<Mistake> kMistakes{
    {"Packages are missing", kNoPackages,
     "PATH=$PWD/bin /bin/sh " ROLLRIG_SOURCE_DIR "/tools/install_packages.sh packages.txt", kWrongInput},
    {"Unknown name", "", "./rollrig run iso_28580 --tire a55", kWrongInput},
    {"Unknown key", "", "./rollrig run iso_28580 --tire a50 --set speed_kmh=100", kWrongInput},
    {"Value out of range", "", "./rollrig run iso_28580 --tire a50 --set ambient_degC=298", kWrongInput},
    {"The folder holds files", "", "./rollrig run iso_28580 --tire a50 --out campaign", kWrongInput},
    {"There is no set.toml", "rm campaign/set.toml", "./rollrig diagnose campaign", kWrongInput},
    {"Unknown column", "sed -i 1s/drum_torque/drum_torqe/ " + kFirst, "./rollrig diagnose campaign", kWrongInput},
    {"Missing column", "cut -d, -f1-3,5- " + kFirst + " > new && mv new " + kFirst, "./rollrig validate campaign",
     kWrongInput},
    {"Semicolons or decimal commas", "sed -i 's/,/;/g' " + kFirst, "./rollrig validate campaign", kWrongInput},
    {"Semicolons or decimal commas", "sed -i '15s/295.045/\"295,045\"/' " + kFirst, "./rollrig validate campaign",
     kWrongInput},
    {"Time does not increase, or is in milliseconds", "sed -i '121s/^119,/118,/' " + kFirst,
     "./rollrig validate campaign", kWrongInput},
    {"Time does not increase, or is in milliseconds", edit_rows("1-warm-up-120.csv", "$1 = 1000 * $1"),
     "./rollrig validate campaign", kWrongInput},
    {"Empty field in an input column", edit_rows("1-warm-up-120.csv", "if (NR == 22) $2 = \"\""),
     "./rollrig validate campaign", kWrongInput},
    {"Bad rows",
     edit_rows("1-warm-up-120.csv", "if (NR == 22) $2 = 2257.2; if (NR == 31) NF = 3") + "\n" +
         edit_rows("3-warm-up-40.csv", "if (NR == 9) $3 = \"OVER\""),
     "./rollrig validate campaign", kWrongInput},
    {"A sensor is not described", "sed -i '/^.sensors.cavity/,/^$/d' campaign/set.toml", "./rollrig validate campaign",
     kWrongInput},
    {"A sensor without noise",
     "sed -i '/^.sensors.drum/,/^$/s/^\\(noise_sd\\|drift_sd\\|resolution\\) = .*/\\1 = 0/' campaign/set.toml",
     "./rollrig diagnose campaign", kWrongInput},
    {"A wrong unit or exchanged columns", edit_runs("if ($7 != \"\") $7 /= 100"), "./rollrig validate campaign",
     kDoubtful},
    {"Further from the simulation than any effect", edit_runs("if ($5 != \"\") $5 *= 2.5"),
     "./rollrig validate campaign", kDoubtful},
    {"A sensor stands still", edit_rows("1-warm-up-120.csv", "if ($1 >= 300 && $1 < 1200) $6 = 31.2"),
     "./rollrig validate campaign", kDone},
    {"Two runs hold the same samples", "cp " + kFirst + " campaign/3-warm-up-40.csv", "./rollrig validate campaign",
     kDone},
    {"A run was cut short", "sed -i '27,$d' " + kFirst, "./rollrig validate campaign", kDone},
    {"Spikes", edit_rows("2-load-sweep.csv", "if (NR == 502 || NR == 1002 || NR == 1502) $7 = -99"),
     "./rollrig validate campaign", kDone},
    {"No speed to fit a tire", "for run in campaign/*.csv; do cut -d, -f1-5,7 $run > new && mv new $run; done",
     "./rollrig fit tire campaign", kWrongInput},
    {"A fit does not converge", "grep -e run -e ,85,75, assets/examples/coastdown_bins.csv > one_bin.csv",
     "./rollrig fit road-load one_bin.csv --mass 2203", kFailed},
    {"The two logs have nothing in common", "cp " ROLLRIG_SOURCE_DIR "/tests/bad_input/import_* .",
     "./rollrig import import_nothing_in_common.toml --out joined", kWrongInput},
    {"The run fails", "", "./rollrig run iso_28580 --tire a50 --set tire.bounded.loss_N=5000", kFailed},
    {"The run fails", "", "./rollrig run iso_28580 --tire a50 --set tire.bounded.loss_N=5000 --fidelity quasi_static",
     kFailed},
};

bool begins_message(const std::string& line) {
  for (const char* word : {"    error: ", "    run failed: ", "    campaign: ", "    rollrig: "}) {
    if (line.rfind(word, 0) == 0) return true;
  }
  return false;
}

/// The messages of each section: indented lines up to one that is not.
std::map<std::string, std::vector<std::string>> read_messages() {
  std::map<std::string, std::vector<std::string>> messages;
  std::istringstream in(rollrig::read_text_file(ROLLRIG_SOURCE_DIR "/docs/troubleshooting.md"));
  std::string section;
  bool goes_on = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("### ", 0) == 0) section = line.substr(4);
    if (begins_message(line)) {
      messages[section].push_back(line);
      goes_on = true;
    } else if (goes_on && line.rfind("    ", 0) == 0) {
      messages[section].back() += "\n" + line;
    } else {
      goes_on = false;
    }
  }
  return messages;
}

std::string blank_numbers(const std::string& text) {
  static const std::regex number(R"([0-9]+(\.[0-9]+)?)");
  return std::regex_replace(text, number, "#");
}

/// Makes the mistake in a folder of its own, and compares what is said with the page.
void check_mistake(const Mistake& mistake, const std::string& message) {
  const TemporaryFolder folder;
  fs::create_symlink(ROLLRIG_PROGRAM, folder.file("rollrig"));
  fs::create_directory_symlink(ROLLRIG_SOURCE_DIR "/assets", folder.file("assets"));
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/examples/hidden_effect", folder.file("campaign"));
  write_file(folder.file("make.sh"), "set -e\n" + mistake.make + "\n");
  write_file(folder.file("typed.sh"), mistake.command + "\n");
  REQUIRE(run_other("sh", "make.sh", folder.path()).status == 0);
  const ProgramResult result = run_other("sh", "typed.sh", folder.path());
  INFO(mistake.section << ": " << mistake.command << "\n" << result.out << result.err);
  CHECK(result.status == mistake.status);
  const bool is_of_set = mistake.status == kDone || mistake.status == kDoubtful;  // what `validate` finds, not an error
  const std::string said = flatten(is_of_set ? result.out : result.err);
  if (mistake.status == kFailed) {  // when a run fails depends on the last digits
    CHECK_THAT(blank_numbers(said), Catch::Contains(blank_numbers(flatten(message))));
  } else {
    CHECK_THAT(said, Catch::Contains(flatten(message)));
  }
}

}  // namespace

TEST_CASE("every message on the page of troubleshooting is what its mistake gives", "[slow]") {
  auto messages = read_messages();
  for (const Mistake& mistake : kMistakes) {
    auto& left = messages[mistake.section];
    INFO(mistake.section);
    REQUIRE_FALSE(left.empty());
    check_mistake(mistake, left.front());
    left.erase(left.begin());
  }
  for (const auto& [section, left] : messages) {
    INFO(section);
    CHECK(left.empty());
  }
}
