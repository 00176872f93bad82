// Every kind of page: its charts are drawn, its numbers are those of the JSON, and its texts, legends and plots stay
// apart in every width, theme and on paper.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <regex>
#include <set>

#include "build_paths.h"
#include "models/effect.h"
#include "scenarios/run/scenario.h"
#include "sim/core/json.h"
#include "sim/core/text.h"
#include "sim/core/units.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

struct PageKind {
  std::string name;
  std::string command;
  std::string checks = {};  // options of check_page.mjs, which does without kinds that are made like others
  int status = 0;           // exit status of the command
  bool has_picture = true;  // before any table
};

Json read_page(const std::string& file) {
  const std::string html = read_file(file);
  const std::string mark = "id=\"payload\">";
  const std::size_t first = html.find(mark) + mark.size();
  return Json::parse(html.substr(first, html.find("</script>", first) - first));
}

/// Numbers of a text with as many digits as they are shown with.
std::vector<std::string> list_shown(const std::string& text) {
  static const std::regex number(R"([-+]?\d+(\.\d+)?(e[-+]\d+)?)");
  std::vector<std::string> shown;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), number); at != std::sregex_iterator(); ++at) {
    shown.push_back(at->str());
  }
  return shown;
}

/// All numbers, those in texts among them.
std::vector<double> list_numbers_of(const Json& json) {
  std::vector<double> numbers;
  const Json flat = json.flatten();
  for (const auto& [key, value] : flat.items()) {
    if (value.is_number()) numbers.push_back(value.get<double>());
    if (!value.is_string()) continue;
    for (const std::string& shown : list_shown(value)) numbers.push_back(*parse_number(shown));
  }
  return numbers;
}

/// Whether a number as shown is this one: half of its last digit.
bool is_shown_as(const std::string& shown, double value) {
  const std::size_t exponent_at = shown.find('e');
  const std::string mantissa = shown.substr(0, exponent_at);
  const std::size_t point = mantissa.find('.');
  const int decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  const int exponent = exponent_at == std::string::npos ? 0 : std::stoi(shown.substr(exponent_at + 1));
  // The rounding of the number itself, and a few last bits of the arithmetic.
  return std::abs(*parse_number(shown) - value) <= 0.5001 * std::pow(10.0, exponent - decimals) + 1e-12;
}

/// Four digits or a decimal point: less is a count or a name, and is in any JSON by chance.
bool tells(const std::string& shown) { return shown.size() >= 4 && shown.find('.') != std::string::npos; }

/// The same, or beyond it: "over 99 %", "under 1 %".
bool is_told(const std::string& text, const std::string& shown, double value) {
  if (text.rfind("over ", 0) == 0) return value > *parse_number(shown);
  if (text.rfind("under ", 0) == 0) return value < *parse_number(shown);
  return is_shown_as(shown, value);
}

void check_tiles(const Json& page, const Json& json) {
  for (const Json& section : page["sections"]) {
    for (const Json& block : section["blocks"]) {
      if (block["type"] != "tiles") continue;
      for (const Json& tile : block["tiles"]) {
        const Json from = tile.value("from", Json::array());
        const std::vector<std::string> shown = list_shown(tile["value"]);
        for (std::size_t i = 0; i < from.size(); ++i) {
          const Json::json_pointer place(from[i].get<std::string>());
          INFO(tile.dump());
          REQUIRE(json.contains(place));
          if (!json[place].is_number()) continue;
          // A probability is shown in percent.
          const double factor = tile["value"].get<std::string>().find('%') != std::string::npos ? 100.0 : 1.0;
          REQUIRE(i < shown.size());
          CHECK(is_told(tile["value"], shown[i], factor * json[place].get<double>()));
        }
      }
    }
  }
}

/// Cells of a table, of a map or of shares, values of lines, or sentences on top, each with its row.
std::vector<std::pair<std::string, std::string>> list_cells(const Json& block) {
  std::vector<std::pair<std::string, std::string>> cells;
  for (const Json& row : block.value("rows", Json::array())) {
    for (const Json& cell : block["type"] == "table" ? row : Json::array()) {
      if (cell.is_string()) cells.emplace_back(row.dump(), cell);
    }
    for (const Json& cell : block["type"] == "map" ? row["cells"] : Json::array()) {
      if (cell.is_object()) cells.emplace_back(row.dump(), cell["text"]);
    }
    if (block["type"] == "shares") cells.emplace_back(row.dump(), row["text"]);
  }
  for (const Json& line : block.value("lines", Json::array())) cells.emplace_back(line.dump(), line["value"]);
  if (block["type"] == "lead") cells.emplace_back("", block["text"]);
  for (auto& [row, cell] : cells) boost::algorithm::replace_all(cell, " - ", " -");  // a sign in an equation
  return cells;
}

/// Every number with a decimal point in a table of the sections is in the JSON, in its unit, in percent or with another
/// prefix of its unit.
void check_tables(const Json& page, const Json& json) {
  constexpr std::array<double, 4> kFactors{1.0, 1e2, 1e3, 1e-3};
  const std::vector<double> numbers = list_numbers_of(json);
  const auto is_there = [&](const std::string& shown) {
    return std::any_of(numbers.begin(), numbers.end(), [&](double number) {
      return std::any_of(kFactors.begin(), kFactors.end(),
                         [&](double factor) { return is_shown_as(shown, factor * number); });
    });
  };
  for (const Json& section : page["sections"]) {
    for (const Json& block : section["blocks"]) {
      for (const auto& [row, cell] : list_cells(block)) {
        for (const std::string& shown : list_shown(cell)) {
          INFO(block.value("caption", "") << ": " << row << ": " << shown);
          if (tells(shown)) CHECK(is_there(shown));
        }
      }
    }
  }
}

/// The first screen says what the page says: a sentence, tiles, and a picture of it before any table.
void check_first_screen(const Json& page, bool has_picture) {
  static const std::set<std::string> kPictures{"curves", "bars", "waterfall", "forest", "map", "shares"};
  const Json& blocks = page["sections"][0]["blocks"];
  REQUIRE(blocks.size() > 1);
  CHECK(blocks[0]["type"] == "lead");
  CHECK(blocks[1]["type"] == "tiles");
  const std::string text = blocks[0]["text"];
  CHECK(text.back() == '.');
  CHECK(text.size() < 400);
  if (!has_picture) return;
  const auto is_one_of = [&](const std::set<std::string>& types) {
    return std::find_if(blocks.begin(), blocks.end(),
                        [&types](const Json& block) { return types.count(block["type"].get<std::string>()) > 0; });
  };
  CHECK(is_one_of(kPictures) < is_one_of({"table", "lines"}));
}

/// Tiles with a number, but for counts of what the page lists, say where the JSON has it.
void check_sources(const Json& page) {
  for (const Json& section : page["sections"]) {
    for (const Json& block : section["blocks"]) {
      if (block["type"] != "tiles") continue;
      for (const Json& tile : block["tiles"]) {
        INFO(tile.dump());
        const std::vector<std::string> shown = list_shown(tile["value"]);
        if (std::any_of(shown.begin(), shown.end(), &tells)) CHECK_FALSE(tile.value("from", Json::array()).empty());
      }
    }
  }
}

/// Texts that name something: titles, labels, headings, cells; not sentences, which may say what to write in a file.
void list_names(const Json& json, std::vector<std::string>& names) {
  static const std::set<std::string> kOther{"from",     "of",     "type",    "machine", "paragraphs",
                                            "items",    "note",   "notes",   "ledgers", "links",
                                            "subtitle", "legend", "command", "about",   "format"};
  if (json.is_string()) names.push_back(json);
  if (json.is_object() && (json.value("type", "") == "pre" || json.value("type", "") == "inputs")) return;
  if (json.is_array()) {
    for (const Json& each : json) list_names(each, names);
  }
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items()) {
    if (kOther.count(key) == 0) list_names(value, names);
  }
}

/// No key of a file stands where a name is to stand: none with a unit, no id of an effect or of a scenario.
void check_names(const Json& page) {
  static const std::regex word("[A-Za-z0-9.]+(_[A-Za-z0-9.]+)+");
  const std::vector<std::string> effects = models::effect_ids();
  const std::vector<std::string> scenarios = scenarios::scenario_names();
  std::vector<std::string> names;
  list_names(page, names);
  for (const std::string& name : names) {
    INFO(name);
    if (name.rfind("no column ", 0) == 0) continue;  // of the user's own file
    for (auto at = std::sregex_iterator(name.begin(), name.end(), word); at != std::sregex_iterator(); ++at) {
      const std::string key = at->str();
      if (key == "sigma_m") continue;  // a symbol of the regulation
      INFO(key);
      CHECK(unit_of_key(key).symbol.empty());
      CHECK(std::count(effects.begin(), effects.end(), key) == 0);
      CHECK(std::count(scenarios.begin(), scenarios.end(), key) == 0);
    }
  }
}

void check_in_browser(const std::string& script, const std::string& arguments) {
  const std::string path = std::string(ROLLRIG_SOURCE_DIR) + "/tests/report/" + script;
  const ProgramResult checked = run_other(ROLLRIG_NODE, "'" + path + "' " + arguments);
  INFO(checked.out << checked.err);
  CHECK(checked.status == 0);
}

void check_kinds(const TemporaryFolder& folder, const std::vector<PageKind>& kinds) {
  constexpr std::uintmax_t kMostBytes = 2'000'000;
  std::string pages;
  for (const PageKind& kind : kinds) {
    const std::string file = folder.file(kind.name + ".html");
    const ProgramResult made =
        run_program(fmt::format("{0} --html {1}.html --json {1}.json", kind.command, kind.name), folder.path());
    INFO(kind.command << '\n' << made.out << made.err);
    REQUIRE(made.status == kind.status);
    CHECK(fs::file_size(file) <= kMostBytes);
    const Json page = read_page(file);
    const Json json = Json::parse(read_file(folder.file(kind.name + ".json")));
    check_tiles(page, json.contains("diagnosis") ? json["diagnosis"] : json);  // of a loop: its last diagnosis
    check_sources(page);
    check_first_screen(page, kind.has_picture);
    check_tables(page, json);
    check_names(page);
    if (!kind.checks.empty()) check_in_browser("check_page.mjs", fmt::format("'{}' {}", file, kind.checks));
    pages += " '" + file + "'";
  }
  check_in_browser("check_boxes.mjs", pages);
}

void prepare(const TemporaryFolder& folder, const std::string& command) {
  const ProgramResult made = run_program(command + " --quiet", folder.path());
  INFO(command << '\n' << made.err);
  REQUIRE(made.status == 0);
}

/// A set of two warm-ups with an effect in it.
void write_effect_set(const TemporaryFolder& folder, const std::string& name, const std::string& more) {
  prepare(folder,
          "run speed_sweep --tire a50 --sensors source --set 'speeds_km_h=[80,120]' --set warm_up_min=10 --set "
          "settle_min=0 --write-set " +
              name + " " + more);
}

const std::string kExamples = std::string(ROLLRIG_SOURCE_DIR) + "/assets/examples/";
const std::string kQuick = " --tire a50 --fidelity quasi_static ";

}  // namespace

TEST_CASE("every kind of page of a run and of several runs", "[weekly]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("runs"));
  for (const char* file : {"skim_a40.toml", "skim_a40.golden.csv", "iso_28580_a50_quasi_static.toml"}) {
    fs::copy_file(fs::path(ROLLRIG_SOURCE_DIR) / "assets/regression" / file, folder.file(std::string("runs/") + file));
  }
  for (const char* design : {"sobol_indices", "morris"}) {
    prepare(folder, fmt::format("campaign new {0} iso_28580 {1} --design {0} --points 20 --draw "
                                "ambient_degC=uniform:20:30 --draw pressure_kPa=normal:250:5",
                                design, kQuick));
    prepare(folder, std::string("campaign run ") + design);
  }
  check_kinds(
      folder,
      {{"iso", "run iso_28580 --tire a50 --sensors source --uncertainty"},
       {"coastdown", "run coastdown --set pairs=2" + kQuick, "--charts 3 --animation --section"},
       {"multi_cycle", "run sae_j1634" + kQuick, "--charts 4 --animation --section"},
       {"setting", "run dyno_setting" + kQuick},
       {"skims", "run skim_series" + kQuick},
       {"loads", "run load_sweep" + kQuick},
       {"grid", "sweep iso_28580 --vary pressure_kPa=230:270:20 --vary ambient_degC=20:30:5" + kQuick, "--charts 3"},
       {"tires", "sweep iso_28580 --fidelity quasi_static --vary tire=a40,a50,a60"},
       {"bars", "sweep iso_28580 --fidelity quasi_static --vary tire=a40,a50 --vary pressure_kPa=230:270:20",
        "--charts 3"},
       {"single", "sweep iso_28580 --vary pressure_kPa=250" + kQuick, "", 0, false},
       {"regress", "regress runs", "--charts 1", 1},  // one of them has no golden
       {"sobol", "campaign sensitivity sobol_indices --result rrc_N_per_kN", "--charts 2"},
       {"morris", "campaign sensitivity morris --result rrc_N_per_kN"}});
}

TEST_CASE("every kind of page of a comparison and of a fit", "[weekly]") {
  const TemporaryFolder folder;
  for (const char* tire : {"a40", "a50"}) {
    prepare(folder, fmt::format("run iso_28580 --fidelity quasi_static --tire {0} --sensors source --uncertainty --out "
                                "run_{0} --write-set set_{0}",
                                tire));
    prepare(folder, fmt::format("run sae_j1634 --fidelity quasi_static --tire {0} --out drive_{0}", tire));
  }
  write_effect_set(folder, "set", "");
  check_kinds(
      folder,
      {{"results", "compare run_a40 run_a50", "--charts 3"},  // bars, waterfall, channels
       {"sets", "compare set_a40 set_a50", "--charts 2"},
       {"drives", "compare drive_a40 drive_a50"},
       {"numbers", "compare a40 a50 a60"},
       {"tire", "fit tire set", "--charts 3 --equations 5"},
       {"road_load", "fit road-load " + kExamples + "coastdown_bins.csv --mass 2203 --uncertainty", "--charts 2"},
       {"wltp", "fit road-load " + kExamples + "coastdown_bins.csv --mass 2203 --method wltp"},
       {"drum", "fit drum-coastdown " + kExamples + "drum_coastdown/coasts.toml"},
       {"j2452", "fit j2452 " + kExamples + "j2452_points.csv --maximum-load 6570 --base-pressure 240"},
       {"j1269", "fit j1269 " + kExamples + "j1269_points.csv --maximum-load 6570 --base-pressure 240"},
       {"align", "align " + kExamples + "alignment.csv --reference-machine drum_A --reference 1.003 -0.05"}});
}

TEST_CASE("every kind of page of a diagnosis and of a plan", "[weekly]") {
  const TemporaryFolder folder;
  write_effect_set(folder, "set", "--set effects.bearing_warmup.fall_per_K=0.03");
  std::string rig = read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/rigs/drum_2m.toml");
  const std::size_t name = rig.find("name");
  rig.replace(name, rig.find('\n', name) - name, "name = \"drum_B\"");
  write_file(folder.file("drum_B.toml"), rig);
  write_effect_set(folder, "set_B", "--rig ./drum_B.toml --seed 5 --set effects.torque_gain.gain_percent=3");
  fs::create_directory(folder.file("sets"));
  for (const char* copy : {"sets/one", "sets/two"}) fs::copy(folder.file("set"), folder.file(copy));
  const std::string only = " --only bearing_warmup,torque_gain";
  prepare(folder, "campaign new-diagnoses night sets" + only);
  prepare(folder, "campaign run night");
  check_kinds(folder, {{"diagnosis", "diagnose set" + only, "--charts 3"},
                       {"fleet", "diagnose sets" + only, "--charts 1"},
                       {"summary", "campaign summary night"},
                       {"pair", "diagnose set --against set_B" + only},
                       {"loop", "diagnose set --loop tests --hours 8" + only},
                       {"plan", "plan --rig drum --hours 8" + only}});
}

TEST_CASE("pages of a run, sweeps, a comparison and a fit", "[slow]") {  // others: weekly; diagnoses: browser_test.cpp
  const TemporaryFolder folder;
  check_kinds(folder,
              {{"coastdown", "run coastdown --set pairs=2" + kQuick},
               {"grid", "sweep iso_28580 --vary pressure_kPa=230:270:20 --vary ambient_degC=20:30:5" + kQuick},
               {"numbers", "compare a40 a50"},
               {"single", "sweep iso_28580 --vary pressure_kPa=250" + kQuick, "", 0, false},
               {"j2452", "fit j2452 " + kExamples + "j2452_points.csv --maximum-load 6570 --base-pressure 240"}});
}
