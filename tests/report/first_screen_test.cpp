// What pages of comparisons and of several sets say on top.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "build_paths.h"
#include "report/comparison_page.h"
#include "report/diagnosis_page.h"
#include "report/machine_pair_page.h"
#include "sim/core/json.h"
#include "tests/diagnosis/hand_made.h"
#include "tests/support/run_program.h"

using namespace rollrig;

namespace {

ComparedValue make_compared(const std::string& name, const std::string& unit, double a, double b) {
  ComparedValue value{name, "", comparison::label_result(name), unit, "", {a, b}, {}};
  value.differences = {comparison::subtract(b, a, unit)};
  return value;
}

/// Two runs on a drum: a run-up that needs 180 N m, then 50 N m under load, of which the first row is half of both.
comparison::Overlay make_drum_overlay() {
  comparison::Overlay overlay;
  overlay.phases = {{"run-up", 0.0, 60.0}, {"load", 60.0, 300.0}};
  comparison::OverlayLine speed, load, torque;
  for (double time_s = 0.0; time_s <= 300.0; time_s += 1.0) {
    for (comparison::OverlayLine* line : {&speed, &load, &torque}) line->time_s.push_back(time_s);
    const bool is_loaded = time_s >= 60.0;
    speed.values.push_back(is_loaded ? 80.0 : time_s * 80.0 / 60.0);
    load.values.push_back(is_loaded ? 5570.0 : 200.0);
    torque.values.push_back(time_s == 60.0 ? 115.0 : is_loaded ? 50.0 - 0.01 * (time_s - 60.0) : 180.0);
  }
  overlay.panels = {{"speed_km_h", {speed, speed}}, {"load_N", {load, load}}, {"drum_torque_Nm", {torque, torque}}};
  return overlay;
}

Json find_block(const report::Page& page, const char* type) {
  for (const report::Section& section : page.sections) {
    for (const report::Block& block : section.blocks) {
      if (block["type"] == type) return block;
    }
  }
  return nullptr;
}

diagnosis::Fleet make_fleet(const std::vector<diagnosis::Diagnosis>& diagnoses) {
  diagnosis::Fleet fleet;
  for (const diagnosis::Diagnosis& one : diagnoses) {
    fleet.members.push_back({"sets/" + one.set, "drum_2m", "a50", one, "", std::nullopt});
  }
  return fleet;
}

/// The blocks of the first section of the page that a command writes.
Json read_first_blocks(const std::string& command) {
  const tests::TemporaryFolder folder;
  const tests::ProgramResult result = tests::run_program(command + " --html page.html", folder.path());
  INFO(result.err);
  REQUIRE(result.status == 0);
  const std::string html = tests::read_file(folder.file("page.html"));
  const std::string mark = "id=\"payload\">";
  const std::size_t first = html.find(mark) + mark.size();
  const Json page = Json::parse(html.substr(first, html.find("</script>", first) - first));
  Json blocks = page["sections"][0]["blocks"];
  blocks.push_back({{"type", "subtitle"}, {"text", page["subtitle"]}});
  return blocks;
}

Json find_in(const Json& blocks, const char* type) {
  for (const Json& block : blocks) {
    if (block["type"] == type) return block;
  }
  return nullptr;
}

const std::string kExampleFolder = std::string(ROLLRIG_SOURCE_DIR) + "/assets/examples/";

}  // namespace

TEST_CASE("a comparison says in which conditions its tests differ, and its main value has a bar", "[fast]") {
  comparison::Compared compared;
  Comparison& comparison = compared.comparison;
  comparison.names = {"a", "b"};
  comparison.values = {make_compared("load_N", "N", 5570.0, 6865.0), make_compared("speed_km_h", "km/h", 80.0, 80.0),
                       make_compared("economy.combined.dc_consumption_Wh_per_km", "Wh/km", 112.6, 109.6),
                       make_compared("usable_energy_kWh", "kWh", 38.0, 36.8)};
  comparison::choose_main(2, compared);
  const report::Page page = report::make_comparison_page(compared);
  const Json lead = find_block(page, "lead");
  CHECK(lead["more"] == "The tests differ in their load: a 5570 N, b 6865 N.");
  const Json bars = find_block(page, "bars");
  REQUIRE(bars["categories"].size() == 2);
  CHECK(bars["categories"][0] == "Economy combined: DC consumption");
}

TEST_CASE("panels of a comparison on a drum are scaled by the load, and its phases have their own rows", "[fast]") {
  comparison::Compared compared;
  compared.comparison.names = {"a", "b"};
  compared.overlays = {make_drum_overlay()};
  const Json panels = find_block(report::make_comparison_page(compared), "times")["panels"];
  const Json& torque = panels[2];
  REQUIRE(torque.contains("scale"));
  CHECK(torque["scale"][1].get<double>() <= 50.0);
  CHECK(torque["scale"][0].get<double>() > 47.0);
  CHECK(torque["series"][0]["phases"][1][2] == 49.99);  // the most under load; 115 N m lie in both phases
}

TEST_CASE("a folder of sets says whether a cause was found, and has no empty chart", "[fast]") {
  const report::Page none = report::make_fleet_page(make_fleet({tests::make_no_gap(), tests::make_no_gap()}));
  const Json lead = find_block(none, "lead");
  CHECK(lead["text"] ==
        "No cause was found in any of 2 sets, and none is needed: the simulation meets all measurements.");
  const Json tiles = find_block(none, "tiles")["tiles"];
  CHECK(tiles[0]["label"] == "No gap");  // what was found stands first
  CHECK(tiles[0]["tone"] == "good");
  CHECK_FALSE(tiles[1].contains("tone"));  // nothing explained is nothing good
  const Json headings = find_block(none, "table")["columns"];
  const auto has_heading = [&headings](const char* label) {
    return std::any_of(headings.begin(), headings.end(), [label](const Json& one) { return one["label"] == label; });
  };
  CHECK(has_heading("gap, noise floors"));
  CHECK(has_heading("gap with the cause, noise floors"));
  CHECK(find_block(none, "bars").is_null());
  const report::Page one = report::make_fleet_page(make_fleet({tests::make_no_gap(), tests::make_explained()}));
  CHECK(find_block(one, "lead")["text"] ==
        "A cause was found in 1 of 2 sets: bearing warmup in 1 set. No gap in 1 set.");
  CHECK(find_block(one, "tiles")["tiles"][0]["tone"] == "good");
  CHECK(find_block(one, "bars")["categories"].size() == 2);
}

TEST_CASE("a set has the same probability on its own page and among others", "[fast]") {
  for (diagnosis::Diagnosis found : {tests::make_no_gap(), tests::make_explained()}) {
    if (found.verdict == Verdict::kNoGap) found.nothing_detectable = 0.991;
    const Json own = report::make_verdict(found).blocks[1]["tiles"][1]["value"];
    const Json table = find_block(report::make_fleet_page(make_fleet({found})), "table");
    std::size_t column = 0;
    while (table["columns"][column]["label"] != "probability") ++column;
    CHECK(table["rows"][0][column] == own);
  }
}

TEST_CASE("a difference and its interval have the same decimals, and bars that look alike are one", "[fast]") {
  comparison::Compared compared;
  Comparison& comparison = compared.comparison;
  comparison.names = {"a", "b"};
  comparison.values = {make_compared("rrc_N_per_kN", "N/kN", 5.945, 5.2072),
                       make_compared("rolling_resistance_N", "N", 33.1, 35.733),
                       make_compared("force_method_N", "N", 33.1, 35.7347)};
  comparison::add_interval(0.02875, 2.0, comparison.values[0].differences[0]);
  comparison::choose_main(0, compared);
  CHECK(comparison.message ==
        "RRc of b is 0.738 N/kN lower than that of a (-12.4 %; 95 % interval -0.795 to -0.680 N/kN)");
  const report::Page page = report::make_comparison_page(compared);
  CHECK_THAT(find_block(page, "tiles")["tiles"][1]["note"].get<std::string>(),
             Catch::Contains("-0.738 N/kN to a") && Catch::Contains("-0.795 to -0.680"));
  CHECK(find_block(page, "bars")["categories"].size() == 2);  // the force method and rolling resistance are one
}

TEST_CASE("two machines that differ in an unknown effect: the first screen says in what, and not in RRc", "[fast]") {
  PairFindings findings;
  findings.verdict = PairVerdict::kUnexplained;
  findings.probability = {{"agree", 0.0}, {"unknown", 1.0}};
  findings.difference = {-0.107, -0.432, 0.218};
  Location first;
  first.channel = "drum_torque_Nm";
  first.run = "A: speed-120";
  first.phase = "120 km/h 5.4 kN";
  first.size = -1.3;
  first.unit = "N";
  Location second = first;
  second.run = "B: speed-80";
  second.size = 1.9;
  findings.where = {first, second};
  const report::Page page = report::make_machine_pair_page(findings);
  const Json lead = page.sections.front().blocks.front();
  const std::string text = lead["text"];
  CHECK(text == "Machines A and B differ in an unknown effect, probability 100 %; no compared effect explains the difference.");
  CHECK(lead["more"] == "No difference in RRc itself is shown: RRc on A minus that on B is -0.107 +- 0.325 N/kN (95 %).");
  const Json bars = find_block(page, "bars");
  CHECK(bars["series"][0]["values"] == Json({1.9, -1.3}));  // the largest first
  CHECK(bars["unit"] == "N");
}

TEST_CASE("a road load by a procedure says on its first screen which checks failed", "[fast]") {
  const Json blocks =
      read_first_blocks("fit road-load " + kExampleFolder + "coastdown_bins.csv --mass 2203 --method wltp");
  CHECK_THAT(find_in(blocks, "lead")["text"].get<std::string>(),
             Catch::EndsWith("2 of 7 checks of the standard failed: reference speeds, statistical precision."));
  const std::string note = find_in(blocks, "tiles")["tiles"].back()["note"];
  CHECK_THAT(note, Catch::Contains("statistical precision (3.57 % at 90 km/h; limit: <= 3 %)"));
  CHECK(find_in(blocks, "subtitle")["text"] == "coastdown_bins.csv, 6 runs");
}

TEST_CASE("points and law at one condition of SAE J2452 look alike, and no two conditions do", "[fast]") {
  const Json blocks = read_first_blocks("fit j2452 " + kExampleFolder + "j2452_points.csv");
  const Json series = find_in(blocks, "curves")["series"];
  REQUIRE(series.size() == 8);
  std::size_t points = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    CHECK(series[i]["style"] == i / 2);
    if (series[i]["kind"] == "points") points += series[i]["x"].size();
  }
  CHECK(points == 30);
  CHECK(find_in(blocks, "subtitle")["text"] == "30 points at 4 conditions of load and pressure");
}
