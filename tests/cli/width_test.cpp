// What stands on a terminal: tables as wide as it, no text cut, no progress left.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "build_paths.h"
#include "tests/cli/longest_line.h"
#include "tests/support/pseudo_terminal.h"
#include "tests/support/run_program.h"

using Catch::Contains;
using rollrig::tests::longest_line;
using rollrig::tests::run_in_terminal;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::TerminalResult;

namespace {

std::vector<std::string> split(const std::string& text, const std::string& at) {
  const std::regex separator(at);
  std::vector<std::string> parts(std::sregex_token_iterator(text.begin(), text.end(), separator, -1), {});
  parts.erase(std::remove(parts.begin(), parts.end(), ""), parts.end());
  return parts;
}

const std::vector<std::string>& list_commands() {
  static const std::vector<std::string> commands{
      "--help",
      "fit road-load --help",
      "list",
      "describe sae_j1634",
      "describe bearing_warmup",
      "diagnose --explain tire_loss_in_skim",
      "run iso_28580 --tire a50 --fidelity quasi_static",
      "run transient_skim --tire a50 --fidelity quasi_static",
      "run sae_j1634 --tire a50 --set wheels=1 --fidelity quasi_static",
      "run dyno_setting --tire a50 --fidelity quasi_static",
      "sweep iso_28580 --tire a50 --vary pressure_kPa=210,310 --fidelity quasi_static",
      "sweep iso_28580 --tire a50 --vary pressure_kPa=210,310 --fidelity quasi_static --show "
      "drum_torque_Nm,parasitic_N,rolling_resistance_N,rrc_N_per_kN,rrc_25degC_2m_N_per_kN,rrc_uncertainty_N_per_kN,"
      "liner_temperature_degC",
      "fit road-load '" ROLLRIG_SOURCE_DIR "/assets/examples/coastdowns.csv' --mass 2203",
      "import '" ROLLRIG_SOURCE_DIR "/assets/examples/logs/import.toml' --out joined --force",
      "convert --force 32 --from-drum 2.0 --to-drum 1.2 --tire a50",
      "align '" ROLLRIG_SOURCE_DIR "/assets/examples/alignment.csv' --reference-machine drum_A"};
  return commands;
}

}  // namespace

TEST_CASE("no line is wider than the terminal, and nothing is cut", "[slow]") {
  const TemporaryFolder folder;
  for (const std::string& command : list_commands()) {
    std::vector<std::string> words;
    for (const int columns : {80, 100, 200}) {
      const TerminalResult run = run_in_terminal(command, columns, folder.path());
      INFO(command << "\n" << run.shown);
      CHECK(run.status == 0);
      // The path of a file is left whole.
      const std::string own = std::regex_replace(run.shown, std::regex(".*" ROLLRIG_SOURCE_DIR ".*\n"), "");
      CHECK(longest_line(own) <= static_cast<std::size_t>(columns));
      CHECK_THAT(run.sent, !Contains("\x1b"));
      if (columns == 80) {
        CHECK(run.shown == run_program(command, folder.path()).out);  // 80 where there is no terminal
      }
      // Cells that are broken at another width hold the same letters, in another order.
      std::string letters = own;
      letters.erase(std::remove_if(letters.begin(), letters.end(), [](unsigned char c) { return std::isspace(c); }),
                    letters.end());
      std::sort(letters.begin(), letters.end());
      if (command.rfind("sweep", 0) != 0) words.push_back(letters);  // whose columns depend on the width
    }
    INFO(command);
    CHECK(std::adjacent_find(words.begin(), words.end(), std::not_equal_to<>()) == words.end());
  }
}

TEST_CASE("a wide terminal is made use of", "[fast]") {
  CHECK(longest_line(run_in_terminal("list effects", 200).shown) > 100);
  CHECK(longest_line(run_in_terminal("list effects", 40).shown) <= 80);
  const std::string sweep = "sweep iso_28580 --tire a50 --vary pressure_kPa=210,310 --fidelity quasi_static";
  CHECK(longest_line(run_in_terminal(sweep, 200).shown) > longest_line(run_in_terminal(sweep, 80).shown));
}

TEST_CASE("headers of columns stand apart, one over each column", "[fast]") {
  const TerminalResult run = run_in_terminal("run transient_skim --tire a50 --fidelity quasi_static", 200);
  std::istringstream in(run.shown);
  for (std::string line; std::getline(in, line);) {
    if (line.find("torque N m") == std::string::npos) continue;
    std::string row;
    std::getline(in, row);
    INFO(line << "\n" << row);
    CHECK(split(line, " {2,}").size() == split(row, " +").size());
    CHECK_THAT(split(line, " {2,}"), Catch::VectorContains(std::string("torque N m")));
    return;
  }
  FAIL("no table\n" + run.shown);
}

TEST_CASE("a diagnosis tells how long it will take, and nothing of that is left", "[slow]") {
  const TerminalResult run =
      run_in_terminal("diagnose '" ROLLRIG_SOURCE_DIR "/assets/examples/hidden_effect' --threads 1", 80);
  INFO(run.sent);
  REQUIRE(run.status == 0);
  CHECK_THAT(run.shown, Catch::StartsWith("Verdict") && !Contains(" left"));
  CHECK(longest_line(run.shown) <= 80);
  const double end_s = run.pieces.back().first;
  int told = 0;
  for (const auto& [time_s, piece] : run.pieces) {
    std::smatch match;
    const std::regex form("diagnose  ([0-9]+) %, about ([0-9]+) s left  ");
    if (!std::regex_search(piece, match, form) || std::stoi(match[1]) < 25) continue;
    CHECK(time_s + std::stod(match[2]) > 0.4 * end_s);
    CHECK(time_s + std::stod(match[2]) < 2.5 * end_s);
    ++told;
  }
  CHECK(told > 2);
}

TEST_CASE("a long sweep tells how long it will take, and its table starts on a clean line", "[slow]") {
  const TerminalResult run =
      run_in_terminal("sweep skim --tire a50 --vary load_N=4000:7000:20 --threads 1 --show parasitic_N", 80);
  INFO(run.sent.substr(0, 2000));
  REQUIRE(run.status == 0);
  CHECK_THAT(run.sent, Contains(" s left"));
  CHECK_THAT(run.shown, Catch::StartsWith("  151 runs\n  load_N  parasitic_N\n"));
}

TEST_CASE("a long command says in a log, too, how long it will take", "[slow]") {
  const TemporaryFolder folder;
  // Stopped for longer than the ten seconds that are waited for, so that the test itself has little to calculate.
  const std::string start = "sweep iso_28580 --tire a50 --vary ambient_degC=20:30:0.1 --threads 1";
  const std::string halt = " & sleep 1; kill -STOP $!; sleep 10; kill -CONT $!; wait $!";
  const auto logged = run_program(start + " --json sweep.json" + halt, folder.path(), "");
  INFO(logged.err);
  CHECK(logged.status == 0);
  CHECK_THAT(logged.err, Catch::Matchers::Matches("sweep  [0-9]+ %, about [0-9]+ (s|min) left.*\n"));
  CHECK(std::count(logged.err.begin(), logged.err.end(), '\n') == 1);
}
