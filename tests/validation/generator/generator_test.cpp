// What every case and validation set of the independent generator must be: repeatable, and silent about its cause.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "build_paths.h"
#include "sim/core/file_io.h"
#include "tests/support/run_program.h"
#include "tests/validation/generator/generated_set.h"
#include "tests/validation/generator/planned_case.h"
#include "validation/files.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

std::map<std::string, std::string> make_files(const std::string& arguments) {
  const TemporaryFolder folder;
  const auto made = run_validation("make-case " + arguments + " --out " + folder.file("set"));
  INFO(made.err);
  REQUIRE(made.status == 0);
  return read_folder(folder.file("set"));
}

/// The first columns of a CSV: what rig or vehicle was told, or reports.
std::string given_columns(const std::string& csv) {
  std::istringstream in(csv);
  std::string given;
  const int columns = csv.find("longitudinal_force_N") < csv.find('\n') ? 5 : 4;
  for (std::string line; std::getline(in, line);) {
    std::size_t end = 0;
    for (int comma = 0; comma < columns; ++comma) end = line.find(',', end + 1);
    given += line.substr(0, end) + "\n";
  }
  return given;
}

/// Effects that can be made on a kind, as `list` says.
std::vector<std::string> effect_names(const std::string& kind) {
  const auto listed = run_validation("list");
  std::istringstream in(listed.out);
  std::vector<std::string> names;
  std::string name;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.front() != ' ') name = line.substr(0, line.find(' '));
    if (line.rfind("  made on", 0) == 0 && line.find(kind) != std::string::npos) names.push_back(name);
  }
  return names;
}

}  // namespace

TEST_CASE("the same order gives the same set to the bit, another seed another set", "[slow]") {
  const auto first = make_files("--effect rim_heat --seed 5");
  CHECK(make_files("--effect rim_heat --seed 5") == first);
  CHECK(make_files("--effect rim_heat --seed 6") != first);
  const auto fewer = make_files("--effect rim_heat --seed 5 --runs 2");
  for (const auto& [name, content] : fewer) {
    INFO(name);
    if (name != "set.toml") CHECK(first.at(name) == content);  // runs do not depend on each other
  }
  CHECK(fewer.size() == 5);
}

namespace {

/// For every effect of each kind, or every so many of them.
void check_given_columns(std::size_t every) {
  const std::map<std::string, std::string> options{
      {"drum", "--kind drum"},
      {"flat_belt", "--kind flat_belt --runs 2"},
      {"dyno", "--kind dyno --runs 1"},
      {"road (combined)", "--kind road --baseline combined --runs 2"},
      {"road (constant_rrc)", "--kind road --baseline constant_rrc --runs 2"}};
  for (const auto& [kind, option] : options) {
    const auto none = make_files(option + " --effect none --seed 11");
    const std::vector<std::string> effects = effect_names(kind);
    for (std::size_t i = 0; i < effects.size(); i += every) {
      const std::string& effect = effects[i];
      const auto with = make_files(option + " --effect " + effect + " --seed 11");
      REQUIRE(with.size() == none.size());
      for (const auto& [name, content] : none) {
        INFO(kind << ", " << effect << ", " << name);
        REQUIRE(with.count(name) == 1);
        if (fs::path(name).extension() == ".csv") {
          CHECK(given_columns(with.at(name)) == given_columns(content));
        } else {
          CHECK(with.at(name) == content);
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("nothing but the measured values depends on every fourth effect", "[slow]") { check_given_columns(4); }

TEST_CASE("nothing but the measured values depends on the effect", "[weekly]") { check_given_columns(1); }

TEST_CASE("a validation set of each kind has what its kind shows, and effects outside of the catalog where asked",
          "[slow]") {
  for (const std::string kind : {"drum", "flat_belt", "dyno", "road"}) {
    const TemporaryFolder folder;
    const auto made = run_validation(
        fmt::format("make --kind {} --seed 7305 --singles 0 --each 1 --none 1 --pairs 3 --outside 9 --runs 1 "
                    "--out {}",
                    kind, folder.file("set")));
    INFO(kind << "\n" << made.err);
    REQUIRE(made.status == 0);
    const Json truth = Json::parse(read_file(folder.file("set/truth.json")));
    std::set<std::string> effects;
    for (const auto& [number, set] : truth.at("sets").items()) {
      for (const Json& effect : set.at("effects")) effects.insert(effect.at("id").get<std::string>());
      const auto read = measurements::read_measurement_set(folder.file("set/sets/" + number));
      CHECK(kind == read.kind->word);
    }
    CHECK(effects.count("speed_record") == 1);
    CHECK(effects.count("speed_interference") == 1);
    CHECK(effects.count("slip_loss") == (kind == "dyno" ? 1 : 0));
    CHECK(effects.count("wind_and_grade") == (kind == "road" ? 1 : 0));
    CHECK(effects.count("windage") == (kind == "road" ? 0 : 1));
    CHECK(effects.count("tire_loss_in_skim") == (kind == "drum" || kind == "flat_belt" ? 1 : 0));
    CHECK(effects.count("curvature_exponent") == (kind == "drum" ? 0 : 1));
  }
}

TEST_CASE("what a kind does not show is refused, with the kinds that do", "[fast]") {
  const auto refused = run_validation("make-case --kind drum --effect wind_and_grade --out nowhere");
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Catch::Contains("road"));
  CHECK(run_validation("make-case --kind drums --effect none --out nowhere").status == 2);
  CHECK(run_validation("make-case --kind road --baseline combined --effect tire_temperature --out nowhere").status ==
        2);
  CHECK(run_validation("make-case --kind drum --baseline combined --effect none --out nowhere").status == 2);
  CHECK(run_validation("make --kind drum --effects brake_heat --out nowhere").status == 2);
  CHECK_FALSE(fs::exists("nowhere"));
}

TEST_CASE("messages and --help name every kind of machine", "[fast]") {
  const std::string refused = run_validation("make-case --kind drums --effect none --out nowhere").err;
  for (const char* command : {"make", "make-case"}) {
    const std::string help = run_validation(std::string(command) + " --help").out;
    for (const rigs::MachineKind* kind : rigs::machine_kinds()) {
      INFO(command);
      CHECK_THAT(help, Catch::Contains(kind->word));
      CHECK_THAT(refused, Catch::Contains(kind->word));
    }
  }
}

TEST_CASE("no file of a set names an effect, a seed or a true value", "[fast]") {
  const TemporaryFolder folder;
  const auto made = run_validation("make-case --effect slow_leak,clock_shift --seed 4711 --truth " +
                                   folder.file("truth.json") + " --out " + folder.file("set"));
  REQUIRE(made.status == 0);
  CHECK(made.out.empty());
  const Json truth = Json::parse(read_file(folder.file("truth.json")));
  CHECK(truth.at("effects").size() == 2);
  for (const auto& [name, content] : read_folder(folder.file("set"))) {
    INFO(name);
    for (const char* word : {"leak", "clock", "effect", "seed", "4711", "truth", "true", "shift"}) {
      if (std::string(word) == "4711" && fs::path(name).extension() == ".csv") continue;  // a reading may hold it
      const bool is_said = content.find(word) != std::string::npos;
      INFO(word);
      CHECK_FALSE(is_said);
    }
    for (const auto& [key, number] : truth.at("base").items()) {
      if (fs::path(name).extension() != ".toml") continue;
      CHECK_THAT(content, !Catch::Contains(fmt::format("{:.5g}", number.at("true").get<double>())));
    }
  }
}

TEST_CASE("a validation set is shuffled, numbered, repeatable, and its truth has the hash that was printed", "[slow]") {
  const TemporaryFolder folder;
  const std::string arguments =
      "make --kind drum --seed 9 --singles 0 --each 3 --none 6 --pairs 2 --outside 0 --effects slow_leak,load_exponent "
      "--runs 1";
  const auto made = run_validation(arguments + " --out " + folder.file("set"));
  INFO(made.err);
  REQUIRE(made.status == 0);
  const auto files = read_folder(folder.file("set"));
  CHECK_THAT(made.out, Catch::Contains(calc_sha256(files.at("truth.json"))));
  CHECK_THAT(files.at("truth.sha256"), Catch::StartsWith(calc_sha256(files.at("truth.json"))));
  const Json truth = Json::parse(files.at("truth.json"));
  REQUIRE(truth.at("sets").size() == 14);
  std::map<std::size_t, int> by_count;
  std::string order;
  std::set<std::string> folders;
  for (const auto& [number, set] : truth.at("sets").items()) {
    ++by_count[set.at("effects").size()];
    order += set.at("effects").empty() ? "-" : set.at("effects").front().at("id").get<std::string>().substr(0, 1);
    CHECK(fs::is_directory(folder.file("set/sets/" + number)));
    CHECK_NOTHROW(measurements::read_measurement_set(folder.file("set/sets/" + number)));
    CHECK(set.at("set_sha256") == validation::hash_case(folder.file("set/sets/" + number)));
  }
  CHECK(truth.contains("kind") == false);  // of a drum: as it always was
  CHECK(by_count == std::map<std::size_t, int>{{0, 6}, {1, 6}, {2, 2}});
  CHECK(order.find("------") == std::string::npos);  // not as they were listed
  for (const auto& [name, content] : files) {
    if (name != "truth.json" && name != "truth.sha256") CHECK(name.rfind("sets/00", 0) == 0);
  }
  REQUIRE(run_validation(arguments + " --out " + folder.file("again")).status == 0);
  CHECK(read_folder(folder.file("again")) == files);
}

TEST_CASE("a run that is stopped by a mistake leaves nothing behind", "[fast]") {
  const TemporaryFolder folder;
  const std::string inside = folder.file("set/truth.json");
  const auto made = run_validation("make-case --effect none --out " + folder.file("set") + " --truth " + inside);
  CHECK(made.status == 2);
  CHECK(folder.entry_count() == 0);
  write_file(folder.file("taken"), "a file");
  CHECK(run_validation("make --out " + folder.file("taken")).status == 2);
  CHECK(read_file(folder.file("taken")) == "a file");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a mixed validation set has every effect of the catalog, each size class, and each sort of campaign",
          "[slow]") {
  const TemporaryFolder folder;
  const auto made = run_validation(
      fmt::format("make --seed 31 --singles 102 --pairs 3 --none 2 --outside 9 --runs 1 --out {}", folder.file("set")));
  INFO(made.err);
  REQUIRE(made.status == 0);
  const Json truth = Json::parse(read_file(folder.file("set/truth.json")));
  std::map<std::string, std::map<std::string, int>> singles;  // by effect, by class
  std::set<std::string> campaigns;
  for (const auto& [number, set] : truth.at("sets").items()) {
    campaigns.insert(set.at("campaign_kind").get<std::string>());
    if (set.at("effects").size() != 1 || !set.at("effects")[0].contains("size_class")) continue;
    const Json& effect = set.at("effects")[0];
    ++singles[effect.at("id").get<std::string>()][effect.at("size_class").get<std::string>()];
    CHECK_NOTHROW(measurements::read_measurement_set(folder.file("set/sets/" + number)));
  }
  CHECK(campaigns.size() == 6);
  CHECK(singles.size() == 34);  // each that is drawn on some kind, three times
  for (const auto& [effect, classes] : singles) {
    INFO(effect);
    CHECK(classes.size() == 3);
  }
}

TEST_CASE("cases of three effects are drawn beside the others, which stay as they are", "[slow]") {
  const TemporaryFolder folder;
  const std::string rest =
      "--seed 33 --singles 2 --pairs 1 --none 1 --outside 1 --runs 1 "
      "--effects slow_leak,torque_gain,rim_heat --kind drum --out ";
  REQUIRE(run_validation("make " + rest + folder.file("without")).status == 0);
  REQUIRE(run_validation("make --triples 2 " + rest + folder.file("with")).status == 0);
  const auto count_effects = [&folder](const std::string& set) {
    const Json truth = Json::parse(read_file(folder.file(set + "/truth.json")));
    std::map<std::size_t, int> counts;  // of cases, by the number of effects
    for (const auto& [number, one] : truth.at("sets").items()) ++counts[one.at("effects").size()];
    return counts;
  };
  CHECK(count_effects("without") == std::map<std::size_t, int>{{0, 1}, {1, 3}, {2, 1}});
  CHECK(count_effects("with") == std::map<std::size_t, int>{{0, 1}, {1, 3}, {2, 1}, {3, 2}});
  const auto refused = run_validation(
      "make --triples 1 --singles 0 --pairs 0 --none 0 --outside 0 --kind drum "
      "--effects slow_leak,torque_gain --out " +
      folder.file("two"));
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Catch::Contains("three or more --effects"));
}

TEST_CASE("size classes are thirds of what is drawn, by the distance from doing nothing", "[slow]") {
  const TemporaryFolder folder;
  const auto made = run_validation(
      "make --kind drum --seed 32 --singles 24 --none 0 --pairs 0 --outside 0 --effects pressure_exponent,clock_shift "
      "--runs 1 --out " +
      folder.file("set"));
  INFO(made.err);
  REQUIRE(made.status == 0);
  std::map<std::string, std::map<std::string, std::vector<double>>> strengths;
  const Json truth = Json::parse(read_file(folder.file("set/truth.json")));
  for (const auto& [number, set] : truth.at("sets").items()) {
    const Json& effect = set.at("effects").at(0);
    strengths[effect.at("id").get<std::string>()][effect.at("size_class").get<std::string>()].push_back(
        std::abs(effect.at("size").get<double>() - effect.at("neutral").get<double>()));
  }
  for (auto& [effect, of] : strengths) {
    INFO(effect);
    const auto largest = [](const std::vector<double>& all) { return *std::max_element(all.begin(), all.end()); };
    const auto least = [](const std::vector<double>& all) { return *std::min_element(all.begin(), all.end()); };
    CHECK(largest(of["small"]) < least(of["middle"]));
    CHECK(largest(of["middle"]) < least(of["large"]));
    CHECK(of["middle"].size() == 4);
  }
}

TEST_CASE("the generator has no symbol of the simulator above sim/core in it", "[fast]") {
  const auto symbols = run_other("/usr/bin/nm", std::string("-C '") + ROLLRIG_GENERATOR_LIBRARY + "'");
  if (symbols.status != 0 || symbols.out.find(" rollrig::generator::") == std::string::npos) {
    WARN("skipped: nm is not there, or the library is stripped");
    return;
  }
  for (const char* folder :
       {"sim", "models", "rigs", "measurements", "estimation", "scenarios", "exports", "diagnosis", "report", "cli"}) {
    INFO(folder);
    CHECK(symbols.out.find(std::string("rollrig::") + folder + "::") == std::string::npos);
  }
}
