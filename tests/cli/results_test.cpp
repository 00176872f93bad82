// Every scenario's results in JSON, on the terminal, on the page, in docs/reference.md and as columns of a sweep: the
// same ones everywhere, with the same numbers.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "build_paths.h"
#include "tests/support/pseudo_terminal.h"
#include "tests/support/run_program.h"

using Catch::Contains;
using OrderedJson = nlohmann::ordered_json;
using rollrig::tests::read_file;
using rollrig::tests::run_in_terminal;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;

namespace {

/// What a run has to be told, so that it is short and has all that the scenario can find. A drum of
/// 1.707 m, where torque and force are not the same number.
std::string settings_of(const std::string& scenario) {
  const std::string rows = "--set 'program=" ROLLRIG_SOURCE_DIR "/assets/regression/";
  const std::string drum = "--set rig.drum.diameter_m=1.707 ";
  const std::string car = "--tire a50 --vehicle volvo_ex30 ";  // has a battery
  if (scenario == "sae_j1634") return car + "--set wheels=1 --set mid_min=5 --set end_min=5";
  if (scenario == "drive_cycle") return car + "--set wheels=1 --set repetitions=2 --set cycle=hwfet";
  if (scenario == "coastdown" || scenario == "dyno_setting") return "--tire a50 --set warm_up_min=1";
  if (scenario == "follow_roller") return "--tire a50 " + rows + "follow_roller_a50.csv'";
  if (scenario == "follow_road") return "--tire a50 " + rows + "follow_road_a50.csv'";
  if (scenario == "follow_drum") return "--tire a50 " + drum + rows + "follow_drum_a50.csv'";
  if (scenario == "iso_28580") return drum + "--tire c1_205_55r16 --set measurement_cycles=2 --set measurement_min=30";  // has a label
  return "--tire a50 " + drum;
}

/// A result in one level: the number of an object gets the key "tire_file.rrc_N_per_kN".
OrderedJson flatten_objects(const OrderedJson& result) {
  OrderedJson flat = OrderedJson::object();
  for (const auto& [key, value] : result.items()) {
    if (!value.is_object()) {
      flat[key] = value;
    } else {
      for (const auto& [member, inner] : value.items()) flat[key + "." + member] = inner;
    }
  }
  return flat;
}

/// Whether a key is of the record that sums up a list, such as "sections_total.distance_km". Its table is that of the
/// list, whose last row it is; a number without a sum is in the reference only.
bool is_of_total(const std::string& key) { return key.find("_total") != std::string::npos; }

/// Keys of a flat result, those of a list's records as "cycles[].load_N"; without those of totals.
std::set<std::string> list_keys(const OrderedJson& result) {
  std::set<std::string> keys;
  for (const auto& [key, value] : result.items()) {
    if (!is_of_total(key)) keys.insert(key);
    if (!value.is_array()) continue;
    for (const OrderedJson& record : value) {
      for (const auto& member : record.items()) keys.insert(key + "[]." + member.key());
    }
  }
  return keys;
}

/// Those that docs/reference.md lists under a scenario's heading.
std::set<std::string> read_reference(const std::string& scenario) {
  const std::string page = read_file(ROLLRIG_SOURCE_DIR "/docs/reference.md");
  const std::size_t heading = page.find("\n### " + scenario + "\n");
  REQUIRE(heading != std::string::npos);
  const std::size_t start = page.find("| result | meaning |", heading);
  std::istringstream rows(page.substr(start, page.find("\n#", start) - start));
  std::set<std::string> keys;
  for (std::string row; std::getline(rows, row);) {
    if (row.rfind("| `", 0) == 0) keys.insert(row.substr(3, row.find('`', 3) - 3));
  }
  return keys;
}

/// Lines and tables of the page's first section, in the terminal's spelling of units.
OrderedJson read_page(const std::string& path) {
  std::string html = std::regex_replace(read_file(path), std::regex("\u00b0C"), "degC");
  html = std::regex_replace(html, std::regex("\u00b2"), "2");
  const std::string mark = "id=\"payload\">";
  const std::size_t first = html.find(mark) + mark.size();
  const OrderedJson page = OrderedJson::parse(html.substr(first, html.find("</script>", first) - first));
  OrderedJson blocks = OrderedJson::array();
  for (const OrderedJson& block : page["sections"][0]["blocks"]) {
    if (block["type"] == "lines" || block["type"] == "table") blocks.push_back(block);
  }
  return blocks;
}

/// Numbers in a text; those of a remark in brackets, such as (k = 2), are none of the result's.
std::vector<std::string> find_numbers(std::string text) {
  text = std::regex_replace(text, std::regex("\\([a-z][^)]*\\)"), "");
  static const std::regex number("(^|[ (])([-+]?[0-9]+(\\.[0-9]+)?)(?![0-9a-z/])");
  std::vector<std::string> numbers;
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at) numbers.push_back((*at)[2]);
  return numbers;
}

/// Whether a text is a value, to the digits that it shows.
bool shows(const std::string& text, const OrderedJson& value) {
  if (value.is_null()) return text == "-";
  if (value.is_boolean()) return text == (value.get<bool>() ? "yes" : "no");
  if (value.is_string()) return text == value.get<std::string>();
  if (find_numbers(text) != std::vector<std::string>{text}) return false;
  const std::size_t point = text.find('.');
  const auto decimals = point == std::string::npos ? 0.0 : static_cast<double>(text.size() - point - 1);
  return std::abs(std::stod(text) - value.get<double>()) <= 0.50001 * std::pow(10.0, -decimals);
}

/// Remarks for a person: no results, but inputs beside them.
const std::set<std::string> kRemarks{"Wheels simulated", "Program", "tire N (simulated)", "tire degC"};

/// Every number of the lines is one of the result's, and every single one of the result's is on a line.
void check_lines(const OrderedJson& result, const OrderedJson& lines) {
  std::set<std::string> unseen;
  for (const auto& [key, value] : result.items()) {
    if (!value.is_array() && !is_of_total(key)) unseen.insert(key);
  }
  for (const OrderedJson& line : lines) {
    if (kRemarks.count(line["label"].get<std::string>()) > 0) continue;
    const std::string text = line["value"];
    std::vector<std::string> shown = find_numbers(text);
    if (shown.empty()) shown.push_back(text);
    const bool begins_with_setting = line["label"].get<std::string>().rfind("Pressure set / ", 0) == 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      bool found = begins_with_setting && i == 0;
      for (const auto& [key, value] : result.items()) {
        if (value.is_array() || !shows(shown[i], value)) continue;
        unseen.erase(key);
        found = true;
      }
      INFO(line.dump());
      CHECK(found);
    }
  }
  CHECK(unseen == std::set<std::string>{});
}

/// Keys of the records that a table shows; none where it has a column that is none of theirs.
std::set<std::string> find_shown(const OrderedJson& table, const OrderedJson& records) {
  std::set<std::string> seen;
  if (table["rows"].size() < records.size()) return {};
  for (std::size_t i = 0; i < table["columns"].size(); ++i) {
    if (kRemarks.count(table["columns"][i]["label"].get<std::string>()) > 0) continue;
    bool is_known = false;
    for (const auto& member : records[0].items()) {
      bool is_shown = true;
      for (std::size_t row = 0; row < records.size(); ++row) {
        is_shown = is_shown && shows(table["rows"][row][i], records[row][member.key()]);
      }
      if (is_shown) seen.insert(member.key());
      is_known = is_known || is_shown;
    }
    if (!is_known) return {};
  }
  return seen;
}

/// Every table shows records of one list, and all that these hold is in a table.
void check_tables(const OrderedJson& result, const OrderedJson& tables) {
  std::set<std::string> unseen;
  for (const std::string& key : list_keys(result)) {
    if (key.find("[].") != std::string::npos) unseen.insert(key);
  }
  for (const OrderedJson& table : tables) {
    std::set<std::string> shown;
    for (const auto& [key, value] : result.items()) {
      if (!value.is_array() || !shown.empty()) continue;
      shown = find_shown(table, value);
      for (const std::string& member : shown) unseen.erase(key + "[]." + member);
    }
    INFO(table.dump());
    CHECK(!shown.empty());
  }
  CHECK(unseen == std::set<std::string>{});
}

/// All numbers of a result, at any depth; a flag is 1 or 0.
std::vector<double> list_numbers(const OrderedJson& result) {
  std::vector<double> numbers;
  if (result.is_number()) numbers.push_back(result.get<double>());
  if (result.is_boolean()) numbers.push_back(result.get<bool>() ? 1.0 : 0.0);
  if (!result.is_structured()) return numbers;
  for (const OrderedJson& inner : result) {
    for (const double number : list_numbers(inner)) numbers.push_back(number);
  }
  return numbers;
}

/// All numbers of the one row of a table.
std::multiset<double> read_numbers(const std::string& csv) {
  std::multiset<double> numbers;
  std::istringstream fields(csv.substr(csv.find('\n') + 1));
  for (std::string field; std::getline(fields, field, ',');) {
    if (field.find_first_of("0123456789") != std::string::npos) numbers.insert(std::stod(field));
  }
  return numbers;
}

/// What the terminal and the page say are the same words, in the same order.
void check_same_words(const std::string& terminal, const OrderedJson& blocks) {
  std::string words;
  for (const OrderedJson& block : blocks) {
    if (block["type"] == "lines") {
      for (const OrderedJson& line : block["lines"]) {
        words += line["label"].get<std::string>() + " " + line["value"].get<std::string>() + " ";
      }
      continue;
    }
    words += block["caption"].get<std::string>() + " ";
    for (const OrderedJson& column : block["columns"]) words += column["label"].get<std::string>() + " ";
    for (const OrderedJson& row : block["rows"]) {
      for (const OrderedJson& cell : row) words += cell.get<std::string>() + " ";
    }
  }
  CHECK_THAT(rollrig::tests::flatten(terminal), Contains(rollrig::tests::flatten(words) + " energy balance: error"));
}

}  // namespace

TEST_CASE("JSON, terminal, page, reference and sweep agree on every scenario's results", "[slow]") {
  const OrderedJson scenarios = OrderedJson::parse(run_program("list --json -").out)["scenarios"];
  CHECK(scenarios.size() >= 14);
  for (const OrderedJson& scenario : scenarios) {
    const std::string name = scenario["name"];
    DYNAMIC_SECTION(name) {
      const TemporaryFolder folder;
      const std::string options = name + " --fidelity quasi_static " + settings_of(name);
      const auto run = run_program("run " + options + " --json run.json --html run.html", folder.path());
      INFO(run.err << run.out);
      REQUIRE(run.status == 0);
      const OrderedJson nested = OrderedJson::parse(read_file(folder.file("run.json")))["result"];
      const OrderedJson result = flatten_objects(nested);
      std::set<std::string> listed = read_reference(name);
      for (const auto& member : result.items()) {
        if (is_of_total(member.key())) CHECK(listed.count(member.key()) == 1);
      }
      for (auto at = listed.begin(); at != listed.end();) at = is_of_total(*at) ? listed.erase(at) : std::next(at);
      // A test has a label class, or says why not.
      if (result.contains("label_class") && !result["label_class"].is_null()) listed.erase("why_no_label");
      CHECK(list_keys(result) == listed);
      const OrderedJson blocks = read_page(folder.file("run.html"));
      REQUIRE(!blocks.empty());
      OrderedJson tables = OrderedJson::array();
      for (const OrderedJson& block : blocks) {
        if (block["type"] == "lines") check_lines(result, block["lines"]);
        if (block["type"] == "table") tables.push_back(block);
      }
      check_tables(result, tables);
      check_same_words(run_in_terminal("run " + options, 400).shown, blocks);

      const std::string pressure_kPa = name == "iso_28580" ? "210" : "250";  // there is no label at another pressure
      REQUIRE(run_program("sweep " + options + " --vary pressure_kPa=" + pressure_kPa + " --out sweep", folder.path())
                  .status == 0);
      const std::string csv = read_file(folder.file("sweep/sweep.csv"));
      std::string columns = "pressure_kPa";
      for (const auto& [key, value] : nested.items())
        columns += value.is_number() || value.is_boolean() ? "," + key : "";
      CHECK_THAT(csv, Catch::StartsWith(columns));
      std::multiset<double> found = read_numbers(csv);
      const OrderedJson swept = OrderedJson::parse(read_file(folder.file("sweep/sweep.json")))["points"][0]["result"];
      for (const double number : list_numbers(swept)) {
        INFO(number);
        const auto at = std::find_if(found.begin(), found.end(), [number](double each) {
          return std::abs(each - number) <= 1e-11 * std::abs(number);
        });
        CHECK(at != found.end());
        if (at != found.end()) found.erase(at);
      }
      CHECK(found == std::multiset<double>{std::stod(pressure_kPa)});  // the pressure that is set
    }
  }
}
