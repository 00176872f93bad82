// rollrig compare as a user meets it: results, measurement sets and tires side by side.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "build_paths.h"
#include "tests/cli/longest_line.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using namespace rollrig::tests;

namespace {

/// `rollrig <arguments>`, which must succeed.
ProgramResult run_well(const TemporaryFolder& folder, const std::string& arguments) {
  ProgramResult result = run_program(arguments, folder.path());
  INFO(arguments << '\n' << result.out << result.err);
  REQUIRE(result.status == 0);
  return result;
}

const std::string kQuick = "run iso_28580 --fidelity quasi_static --quiet ";

const json& find_named(const json& comparison, const std::string& name, const std::string& place = "") {
  for (const json& value : comparison["values"]) {
    if (value["name"] == name && (place.empty() || value.value("place", "") == place)) return value;
  }
  FAIL("no value " << name);
  return comparison;
}

json compare(const TemporaryFolder& folder, const std::string& arguments) {
  return json::parse(run_well(folder, "compare " + arguments + " --json -").out);
}

json read_payload(const std::string& html) {
  const std::string mark = "id=\"payload\">";
  const std::size_t first = html.find(mark) + mark.size();
  return json::parse(html.substr(first, html.find("</script>", first) - first));
}

}  // namespace

TEST_CASE("a result and its copy differ in nothing, with intervals of no width", "[fast]") {
  const TemporaryFolder folder;
  run_well(folder, kQuick + "--tire a50 --uncertainty --out a");
  fs::copy(folder.file("a"), folder.file("b"));
  const json comparison = compare(folder, "a b");
  CHECK(comparison["inputs"].empty());
  for (const json& value : comparison["values"]) {
    INFO(value.dump());
    CHECK(value["differences"][0]["difference"] == 0.0);
  }
  CHECK(find_named(comparison, "rrc_25degC_2m_N_per_kN")["differences"][0]["ci95"] == json({0.0, 0.0}));
  CHECK(comparison["waterfalls"][0]["steps"].empty());
}

TEST_CASE("two tires on one machine: differences of the files, intervals narrower than those of the results",
          "[fast]") {
  const TemporaryFolder folder;
  run_well(folder, kQuick + "--tire a50 --uncertainty --out a");
  run_well(folder, kQuick + "--tire a40 --set pressure_kPa=240 --uncertainty --out b");
  const ProgramResult shown = run_well(folder, "compare a b --out c");
  CHECK(longest_line(shown.out) <= 80);
  CHECK_THAT(shown.out, Contains("settings.pressure_kPa"));
  const json comparison = json::parse(read_file(folder.file("c/comparison.json")));
  const json a = json::parse(read_file(folder.file("a/result.json")));
  const json b = json::parse(read_file(folder.file("b/result.json")));
  const char* rrc = "rrc_25degC_2m_N_per_kN";
  const double difference = b["result"][rrc].get<double>() - a["result"][rrc].get<double>();
  const json& found = find_named(comparison, rrc)["differences"][0];
  CHECK(found["difference"].get<double>() == difference);
  const double width = found["ci95"][1].get<double>() - difference;
  const auto expanded = [](const json& of) {
    return of["uncertainty"]["budgets"][0]["expanded_uncertainty"].get<double>();
  };
  CHECK(width > 0.0);
  CHECK(width < std::hypot(expanded(a), expanded(b)));  // gain, load, speed and the like are one machine's
  const json& waterfall = comparison["waterfalls"][0];
  double reached_J = waterfall["start_J"];
  CHECK(reached_J == a["energy"]["terms_J"]["motor"].get<double>());
  for (const json& step : waterfall["steps"]) reached_J += step["energy_J"].get<double>();
  CHECK(reached_J == Approx(b["energy"]["terms_J"]["motor"].get<double>()).epsilon(1e-12));  // rounding of the sum
  CHECK_THAT(read_file(folder.file("c/differences.csv")), Catch::StartsWith("name,place,unit,reference,compared,"));
}

TEST_CASE("results without a budget have differences without an interval, and the text says why", "[fast]") {
  const TemporaryFolder folder;
  run_well(folder, kQuick + "--tire a50 --out a");
  run_well(folder, kQuick + "--tire a40 --out b");
  const ProgramResult shown = run_well(folder, "compare a b");
  CHECK_THAT(flatten(shown.out), Contains("a was run without --uncertainty"));
  const json found = find_named(compare(folder, "a b"), "rrc_N_per_kN")["differences"][0];
  CHECK(found["ci95"].is_null());
  CHECK(found["sd"].is_null());
}

TEST_CASE("three results are compared with the first", "[fast]") {
  const TemporaryFolder folder;
  for (const char* tire : {"a40", "a50", "a60"}) {
    run_well(folder, kQuick + "--tire " + tire + " --out " + tire + "_result");
  }
  const json comparison = compare(folder, "a40_result a50_result a60_result");
  CHECK(comparison["names"].size() == 3);
  CHECK(find_named(comparison, "rrc_N_per_kN")["differences"].size() == 2);
  CHECK(comparison["waterfalls"].size() == 2);
}

TEST_CASE("a set whose torque has a gain shows it less skim, where the zeros of the sessions cancel", "[fast]") {
  const TemporaryFolder folder;
  const std::string made = kQuick + "--tire a50 --sensors source --set warm_up_min=20 ";
  run_well(folder, made + "--seed 1 --write-set plain");
  run_well(folder, made + "--seed 2 --set effects.torque_gain.gain_percent=3 --write-set gained");
  const json comparison = compare(folder, "plain gained");
  const json& torque = find_named(comparison, "drum_torque_less_skim_Nm");
  INFO(torque.dump());
  const json& found = torque["differences"][0];
  const double truth = 0.03 * torque["values"][0].get<double>();
  // Within the interval of 95 %, or half as far again: seeds are fixed, and one interval in twenty misses.
  const double half_width = found["ci95"][1].get<double>() - found["difference"].get<double>();
  CHECK(std::abs(found["difference"].get<double>() - truth) < 1.5 * half_width);
  CHECK(found["ci95"][0].get<double>() > 0.0);  // the gain is seen
  CHECK(comparison["message"].get<std::string>().find("drum torque less skim") != std::string::npos);
}

TEST_CASE("sets of different loads are compared in their loaded phases", "[fast]") {
  const TemporaryFolder folder;
  const std::string made = kQuick + "--tire a50 --sensors source --set warm_up_min=20 ";
  run_well(folder, made + "--seed 1 --write-set heavy");
  run_well(folder, made + "--seed 2 --set load_N=4000 --write-set light");
  const json comparison = compare(folder, "heavy light");
  const json& torque = find_named(comparison, "drum_torque_less_skim_Nm");
  INFO(torque.dump());
  CHECK_THAT(torque["place"].get<std::string>(), Contains("kN"));
  CHECK(torque["differences"][0]["ci95"][1].get<double>() < 0.0);  // less load, less torque
  const double by_load_percent = 100.0 * (4000.0 / 6865.0 - 1.0);  // the tire's loss goes with about its load
  CHECK(torque["differences"][0]["percent"].get<double>() == Approx(by_load_percent).epsilon(0.3));
  CHECK_THAT(comparison["warnings"].dump(), Contains("the loads differ"));
  CHECK_FALSE(comparison["warnings"].dump().find("the phases differ") != std::string::npos);
  // Neither the place of the value nor the sentence says the load of one set for both.
  CHECK_THAT(torque["place"].get<std::string>(), Contains("80 km/h, 6.9 and 4.0 kN"));
  CHECK_THAT(comparison["message"].get<std::string>(), Contains("at different loads: heavy 6.9 kN, light 4.0 kN"));
  // The loss goes with the load to the power 1.1 or so: less load, less loss for it, by far less than the load.
  CHECK_THAT(comparison["message"].get<std::string>(), Catch::Matches(".*; for its load it is 1[0-4]\\.\\d % lower.*"));
}

TEST_CASE("bars of a comparison show no quantity twice", "[fast]") {
  const TemporaryFolder folder;
  // Of a drum with a radius of 1 m, torques and forces have the same numbers.
  run_well(folder, kQuick + "--tire a50 --uncertainty --out a");
  run_well(folder, kQuick + "--tire a40 --uncertainty --out b");
  run_well(folder, "compare a b --html page.html");
  const json page = read_payload(read_file(folder.file("page.html")));
  const json& blocks = page["sections"][0]["blocks"];
  const auto bars =
      std::find_if(blocks.begin(), blocks.end(), [](const json& block) { return block["type"] == "bars"; });
  REQUIRE(bars != blocks.end());
  std::vector<double> shown = (*bars)["series"][0]["values"];
  std::sort(shown.begin(), shown.end());
  INFO(bars->dump());
  CHECK(shown.size() >= 2);
  CHECK(std::adjacent_find(shown.begin(), shown.end()) == shown.end());
}

TEST_CASE("a damaged result is named, whichever it is", "[fast]") {
  const TemporaryFolder folder;
  run_well(folder, kQuick + "--tire a50 --out good");
  for (const char* member : {"terms_J", "phases"}) {
    const std::string bad = std::string("bad_") + member;
    fs::copy(folder.file("good"), folder.file(bad));
    json result = json::parse(read_file(folder.file(bad + "/result.json")));
    (std::string(member) == "phases" ? result : result["energy"])[member] = {{"a", "a text"}};
    write_file(folder.file(bad + "/result.json"), result.dump());
    const ProgramResult refused = run_program("compare good " + bad, folder.path());
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains("damaged") && Contains(bad + "/result.json"));
  }
}

TEST_CASE("runs without a counterpart are listed", "[fast]") {
  const TemporaryFolder folder;
  const std::string made =
      "run speed_sweep --fidelity quasi_static --quiet --tire a50 --sensors source --set "
      "warm_up_min=5 --set settle_min=0 --set 'speeds_km_h=";
  run_well(folder, made + "[60,80]' --write-set one");
  run_well(folder, made + "[60,100]' --write-set other");
  const ProgramResult shown = run_well(folder, "compare one other");
  CHECK(longest_line(shown.out) <= 80);
  CHECK_THAT(shown.out, Contains("warning"));
}

TEST_CASE("tires are compared by their numbers and by a test of each", "[fast]") {
  const TemporaryFolder folder;
  const ProgramResult shown = run_well(folder, "compare a40 a50 --html page.html");
  CHECK(longest_line(shown.out) <= 80);
  const json comparison = compare(folder, "a40 a50 --scenario skim");
  const json& loss = find_named(comparison, "bounded.loss_N");
  CHECK(loss["differences"][0]["sd"].get<double>() > 0.6295788);  // that of a40 alone
  const json& rrc = find_named(comparison, "rrc_25degC_2m_N_per_kN", "iso_28580");
  run_well(folder, kQuick + "--tire a40 --out a40_result");
  const json result = json::parse(read_file(folder.file("a40_result/result.json")));
  CHECK(rrc["values"][0].get<double>() == Approx(result["result"]["rrc_25degC_2m_N_per_kN"].get<double>()));
  CHECK(rrc["differences"][0]["sd"].get<double>() > 0.0);
}

TEST_CASE("a comparison of tires does not depend on the number of threads", "[fast]") {
  const TemporaryFolder folder;
  run_well(folder, "compare a40 a50 --threads 1 --json one.json");
  run_well(folder, "compare a40 a50 --threads 2 --json two.json");
  CHECK(read_file(folder.file("one.json")) == read_file(folder.file("two.json")));
}

TEST_CASE("a tire and its copy do not differ, and surely so", "[fast]") {
  const TemporaryFolder folder;
  fs::copy(fs::path(ROLLRIG_SOURCE_DIR) / "assets/tires/a40.toml", folder.file("copy.toml"));
  const json comparison = compare(folder, "a40 copy.toml");
  for (const json& value : comparison["values"]) {
    INFO(value.dump());
    if (value["values"][0].is_number()) CHECK(value["differences"][0]["difference"] == 0.0);
    if (!value["differences"][0]["ci95"].is_null()) CHECK(value["differences"][0]["sd"] == 0.0);
  }
}
