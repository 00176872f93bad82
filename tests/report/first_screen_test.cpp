// What pages of comparisons and of several sets say on top.
#include <catch2/catch.hpp>
#include <cmath>

#include "report/comparison_page.h"
#include "report/diagnosis_page.h"
#include "tests/diagnosis/hand_made.h"

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
  CHECK_FALSE(tiles[0].contains("tone"));  // nothing explained is nothing good
  CHECK(tiles[1]["tone"] == "good");
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
