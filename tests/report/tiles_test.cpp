// What a page says at a glance.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "models/quantities.h"
#include "report/blocks.h"
#include "report/list_pages.h"
#include "report/run_page.h"
#include "report/sensitivity_page.h"
#include "report/sweep_values.h"
#include "sim/core/text.h"

using namespace rollrig;
using scenarios::Headline;
using scenarios::JointLine;
using scenarios::Result;
using scenarios::ResultList;
using scenarios::ResultSheet;
using scenarios::Summary;

namespace {

struct Record {
  double load_N = 5000.0;

  void visit(ResultSheet& visit) const { visit(Result{"load_N", "load", ".0f", "load"}, load_N); }
};

struct Results {
  std::optional<double> sd = 4e-5;
  std::vector<Record> records{{4000.0}, {6000.0}};

  void visit(ResultSheet& visit) const {
    visit(Result{"rrc_N_per_kN", "RRc", ".3f", "coefficient"}, 5.2e-3);
    visit(Result{"rrc_sd_N_per_kN", "", ".3f", "its uncertainty"}, sd);
    visit(ResultList{"cycles", "Cycles", "each"}, records);
    visit(Headline{"RRc", "{rrc_N_per_kN} +- {rrc_sd_N_per_kN}", "at {cycles.last.load_N}"});
    visit(Headline{"Load of the first", "{cycles.first.load_N}", "RRc {rrc_N_per_kN}"});
    visit(
        Summary{"RRc is {rrc_N_per_kN} +- {rrc_sd_N_per_kN}, from {cycles.first.load_N} to {cycles.last.load_N}; then "
                "{cycles.last.load_N}."});
    visit(Summary{"RRc is {rrc_N_per_kN}."});
  }
};

}  // namespace

TEST_CASE("headlines have value, unit and note, and where the JSON has them", "[fast]") {
  const ResultSheet sheet = ResultSheet::of(Results{});
  REQUIRE(sheet.headlines.size() == 2);
  CHECK(sheet.headlines[0].value == "5.200 +- 0.040");
  CHECK(sheet.headlines[0].unit == "N/kN");
  CHECK(sheet.headlines[0].note == "at 6000 N");
  CHECK(sheet.headlines[1].keys == std::vector<std::string>{"cycles/0/load_N"});
  CHECK(sheet.json["/cycles/0/load_N"_json_pointer] == 4000.0);
  CHECK(sheet.headlines[1].note == "RRc 5.200 N/kN");
}

TEST_CASE("the sentence of a run has units behind its numbers, and leaves out what has no value", "[fast]") {
  // A unit serves two values side by side, but not those that words part.
  CHECK(ResultSheet::of(Results{}).summary == "RRc is 5.200 +- 0.040 N/kN, from 4000 to 6000 N; then 6000 N.");
  CHECK(ResultSheet::of(Results{std::nullopt, {}}).summary == "RRc is 5.200 N/kN.");
}

TEST_CASE("a headline without its value is left out, but its key is known", "[fast]") {
  const ResultSheet sheet = ResultSheet::of(Results{std::nullopt, {}});
  CHECK(sheet.headlines.empty());
  REQUIRE(sheet.headline_keys.size() == 2);
  CHECK(sheet.headline_keys[0].first == "rrc_N_per_kN");
}

TEST_CASE("a sweep says its first result's range and its sensitivity", "[fast]") {
  Json sweep = {{"scenario", "iso_28580"}, {"points", Json::array()}};
  for (const int pressure_kPa : {230, 250, 270}) {
    for (const int ambient_degC : {20, 25, 30}) {
      const double rrc = 5.0 - 0.005 * (pressure_kPa - 250) - 0.04 * (ambient_degC - 25);
      sweep["points"].push_back(
          {{"set", {{"pressure_kPa", std::to_string(pressure_kPa)}, {"ambient_degC", std::to_string(ambient_degC)}}},
           {"result", {{"drum_torque_Nm", 40.0 + rrc}, {"rrc_25degC_2m_N_per_kN", rrc}, {"rrc_N_per_kN", 2.0 * rrc}}}});
    }
  }
  sweep["sensitivities"] = report::list_sensitivities(sweep, {"rrc_25degC_2m_N_per_kN"});
  const report::Page page = report::make_sweep_page(sweep, {}, "");
  const std::vector<report::Block>& blocks = page.sections.front().blocks;
  REQUIRE(blocks.size() == 5);  // sentence, tiles, map, two charts: RRc as tested goes with the corrected one
  CHECK(
      blocks[0]["text"] ==
      "RRc at 25 °C, 2 m drum is lowest with pressure 270 kPa, ambient 30 °C, 4.7 N/kN, and highest with pressure 230 "
      "kPa, ambient 20 °C, 5.3 N/kN: -1.00 % per 10 kPa of pressure and -0.80 % per K of ambient.");
  const Json& tiles = blocks[1]["tiles"];
  CHECK(tiles[0]["label"] == "Lowest RRc at 25 °C, 2 m drum");
  CHECK(tiles[0]["value"] == "4.7");
  CHECK(tiles[0]["note"] == "pressure 270 kPa, ambient 30 °C");
  CHECK(tiles[1]["value"] == "5.3");
  CHECK(tiles[1]["note"] == "pressure 230 kPa, ambient 20 °C");
  std::map<std::string, std::string> by_unit;
  for (const Json& tile : tiles) by_unit[tile["unit"]] = tile["value"];
  CHECK(by_unit["% per 10 kPa"] == "-1.00");  // 100 x 10 x 0.005 / 5
  CHECK(by_unit["% per K"] == "-0.80");       // 100 x 0.04 / 5
  CHECK(blocks[2]["type"] == "map");
  CHECK(blocks[3]["y"]["label"] == "RRc at 25 °C, 2 m drum");
  for (const Json& column : page.sections.back().blocks.front()["columns"]) {
    CHECK(column["label"].get<std::string>().find('_') == std::string::npos);  // no raw key
  }
}

TEST_CASE("a sweep in which nothing changes has tiles, too", "[fast]") {
  const Json point = {{"set", {{"pressure_kPa", "250"}}},
                      {"result", {{"rrc_25degC_2m_N_per_kN", 5.2}, {"drum_torque_Nm", 47.0}}}};
  Json sweep = {{"scenario", "iso_28580"}, {"points", {point}}, {"sensitivities", Json::array()}};
  const Json single = report::make_sweep_page(sweep, {}, "").sections.front().blocks[1]["tiles"];
  CHECK(single[0]["label"] == "RRc at 25 °C, 2 m drum");
  CHECK(single[0]["value"] == "5.2");
  CHECK(single[0]["note"] == "pressure 250 kPa");
  CHECK(single[0]["from"] == Json::array({"/points/0/result/rrc_25degC_2m_N_per_kN"}));
  sweep["points"].push_back(point);
  sweep["points"][1]["set"]["pressure_kPa"] = "260";
  const Json equal = report::make_sweep_page(sweep, {"drum_torque_Nm"}, "").sections.front().blocks[1]["tiles"];
  REQUIRE(equal.size() == 1);
  CHECK(equal[0]["value"] == "47");
  CHECK(equal[0]["note"] == "the same in all 2 runs");
}

TEST_CASE("panels over time show no ramp where a row of a minute ends, nothing that is zero and nothing twice",
          "[fast]") {
  namespace quantities = models::quantities;
  sim::Recording<double> recording;
  recording.phases = {{"soak", -600.0, 0.0}, {"run-up", 0.0, 60.0}, {"load", 60.0, 300.0}};
  std::vector<double> speed_m_s, load_N, torque_Nm, zero, loss_N;
  for (double time_s = -600.0; time_s <= 300.0; time_s += time_s < 0.0 ? 60.0 : 1.0) {
    recording.time_s.push_back(time_s);
    recording.phase.push_back(time_s < 0.0 ? 0 : time_s < 60.0 ? 1 : 2);
    speed_m_s.push_back(std::clamp(time_s / 3.0, 0.0, 20.0));
    load_N.push_back(time_s < 60.0 ? 200.0 : 6000.0);
    torque_Nm.push_back(time_s < 0.0 ? 0.0 : time_s < 60.0 ? 180.0 : 50.0 - 0.01 * time_s);
    zero.push_back(0.0);
    loss_N.push_back(torque_Nm.back());
  }
  recording.channels = {{quantities::kSpeed},
                        {quantities::kLoad},
                        {quantities::kDrumTorque},
                        {quantities::kLossForce},
                        {quantities::kSpindleForce}};
  recording.values = {speed_m_s, load_N, torque_Nm, zero, loss_N};
  const report::Block block = report::make_times(recording);
  std::map<std::string, Json> panels;
  for (const Json& panel : block["panels"]) panels[panel["label"]] = panel;
  CHECK(panels.count("Loss") == 0);
  CHECK_THAT(block["caption"].get<std::string>(), Catch::Contains("Loss is 0 throughout"));
  const Json& torque = panels.at("Drum torque");
  const Json& t = torque["series"][0]["t"];
  for (std::size_t i = 0; i < t.size(); ++i) {  // in the last minute of the soak it stands
    if (t[i] < -1.0) CHECK(torque["series"][0]["y"][i] == 0.0);
    if (t[i] == 0.0) CHECK(t[i - 1] == -1.0);
  }
  // What is drawn and no row is said, so that it is not saved as one.
  CHECK(torque["series"][0]["held"] == Json::array({-1.0}));
  for (const Json& panel : block["panels"]) {
    for (const Json& series : panel["series"]) {
      const Json held = series.value("held", Json::array());
      for (const Json& time_s : series["t"]) {
        const bool is_row = std::count(recording.time_s.begin(), recording.time_s.end(), time_s.get<double>()) == 1;
        CHECK(is_row == (std::count(held.begin(), held.end(), time_s) == 0));
      }
    }
  }
  REQUIRE(torque.contains("scale"));  // 180 N m of the run-up lie beyond
  CHECK(torque["scale"][1].get<double>() < 51.0);
  CHECK(torque["scale"][0].get<double>() > 46.0);
}

TEST_CASE("a sweep whose curve bends says the range of its slopes, and no single one", "[fast]") {
  Json sweep = {{"scenario", "iso_28580"}, {"points", Json::array()}};
  for (const int speed_km_h : {60, 80, 100}) {  // 5.0, 5.2 and 5.2: +2 % and 0 % per 10 km/h, about
    sweep["points"].push_back({{"set", {{"speed_km_h", std::to_string(speed_km_h)}}},
                               {"result", {{"rrc_25degC_2m_N_per_kN", speed_km_h == 60 ? 5.0 : 5.2}}}});
  }
  sweep["sensitivities"] = report::list_sensitivities(sweep, {"rrc_25degC_2m_N_per_kN"});
  const report::Page page = report::make_sweep_page(sweep, {}, "");
  const Json& tiles = page.sections.front().blocks[1]["tiles"];
  REQUIRE(tiles.size() == 3);
  CHECK(tiles[2]["value"] == "+0.00 to +1.95");  // 100 x 10 x 0.01 / 5.133
  CHECK(tiles[2]["unit"] == "% per 10 km/h");
}

TEST_CASE("a sweep of tires says which is lowest and in what the tests differ", "[fast]") {
  Json sweep = {{"scenario", "iso_28580"}, {"points", Json::array()}, {"sensitivities", Json::array()}};
  for (const auto& [tire, rrc, load_N] : {std::tuple("a40", 5.941, 5570.0), {"a50", 5.204, 6865.0}}) {
    sweep["points"].push_back(
        {{"set", {{"tire", tire}}}, {"result", {{"rrc_25degC_2m_N_per_kN", rrc}, {"load_N", load_N}}}});
  }
  const Json lead = report::make_sweep_page(sweep, {}, "").sections.front().blocks.front();
  CHECK(lead["text"] ==
        "RRc at 25 °C, 2 m drum is lowest with tire a50, 5.204 N/kN, and highest with tire a40, 5.941 N/kN.");
  CHECK(lead["more"] == "The tests differ in their load: a40 5570 N, a50 6865 N.");
}

TEST_CASE("a sweep over ambient says why the value at 25 degC depends on it", "[fast]") {
  for (const char* axis : {"ambient_degC", "pressure_kPa"}) {
    Json sweep = {{"scenario", "iso_28580"}, {"points", Json::array()}, {"sensitivities", Json::array()}};
    for (const auto& [value, rrc] : {std::pair("20", 5.3), {"30", 5.1}}) {
      sweep["points"].push_back({{"set", {{axis, value}}}, {"result", {{"rrc_25degC_2m_N_per_kN", rrc}}}});
    }
    const std::string more = report::make_sweep_page(sweep, {}, "").sections.front().blocks.front().value("more", "");
    CHECK((more.find("still depends on the ambient temperature") != std::string::npos) ==
          (std::string(axis) == "ambient_degC"));
  }
}

TEST_CASE("runs without a golden are no runs that differ, and have no bar", "[fast]") {
  Json regression = {{"runs", Json::array()}};
  const auto add = [&](const char* name, const char* status, int compared, double share) {
    regression["runs"].push_back({{"name", name},
                                  {"status", status},
                                  {"compared", compared},
                                  {"worst_share_of_tolerance", share},
                                  {"worst", compared > 0 ? "motor_power_W at 1082 s" : ""},
                                  {"problems", Json::array()}});
  };
  add("new_one", "no golden", 0, 0.0);
  add("skim", "same", 410, 2e-5);
  const std::vector<report::Block> blocks = report::make_regress_page(regression).sections.front().blocks;
  CHECK(blocks[0]["text"] ==
        "No run differs; 1 of 2 runs give the values of their stored results; 1 has no stored result yet.");
  CHECK(blocks[0]["tone"] == "doubt");
  REQUIRE(blocks[1]["tiles"].size() == 2);
  CHECK(blocks[1]["tiles"][0]["tone"] == "good");
  CHECK(blocks[1]["tiles"][1]["tone"] == "doubt");
  REQUIRE(blocks[2]["type"] == "bars");
  CHECK(blocks[2]["categories"] == Json::array({"skim"}));
  CHECK(blocks[2]["least_end"] == 1.0);  // the limit is on the axis: a share of 2e-5 is no tall bar
  add("changed", "differs", 410, 3.0);
  const Json worse = report::make_regress_page(regression).sections.front().blocks[0];
  CHECK(worse["tone"] == "bad");
  CHECK_THAT(worse["text"].get<std::string>(), Catch::EndsWith("; 1 has no stored result yet; differs: 1."));
}

TEST_CASE("a sensitivity says which factor matters and how much, and its map is in the document", "[fast]") {
  const auto index = [](double value) {
    return Json{{"value", value}, {"low_95", 0.7 * value}, {"high_95", 1.2 * value}};
  };
  Json sensitivity = {{"result", "rrc_N_per_kN"},
                      {"mean", 5.2},
                      {"sd", 0.19},
                      {"factors",
                       {{{"key", "ambient_degC"}, {"first", index(0.967)}, {"total", index(0.978)}},
                        {{"key", "pressure_kPa"}, {"first", index(0.0044)}, {"total", index(0.0131)}}}}};
  const std::vector<report::FactorScatter> scatters{
      {"ambient_degC", {20.0, 20.0, 30.0, 30.0}, {5.4, 5.2, 5.0, 4.8}},
      {"pressure_kPa", {240.0, 260.0, 240.0, 260.0}, {5.4, 5.2, 5.0, 4.8}}};
  sensitivity["over_two_factors"] = report::make_factor_means(scatters);
  CHECK(sensitivity["over_two_factors"]["means"] == Json::parse("[[5.4, 5.0], [5.2, 4.8]]"));
  CHECK(sensitivity["over_two_factors"]["down"]["ranges"] == Json::array({"240", "260"}));
  const Table table{"", {"factor", "alone", "with interactions"}, {{"ambient_degC", "", ""}, {"pressure_kPa", "", ""}}};
  const report::Page page = report::make_sensitivity_page(sensitivity, table, "", scatters);
  const std::vector<report::Block>& blocks = page.sections.front().blocks;
  CHECK(blocks[0]["text"] ==
        "RRc depends most on ambient: it accounts for 98 % of the variance (95 % interval 68 to 100 %); pressure 1.3 %, "
        "with interactions.");
  REQUIRE(blocks[1]["tiles"].size() == 3);
  CHECK(blocks[1]["tiles"][0]["value"] == "97.8 %");
  CHECK(blocks[2]["type"] == "bars");
}

TEST_CASE("an elementary effect has one sign in sentence, tile and bar, and says from where to where", "[fast]") {
  const auto effect = [](double size, double mean) {
    return Json{{"mean_size", {{"value", size}, {"low_95", 0.9 * size}, {"high_95", 1.1 * size}}}, {"mean", mean}};
  };
  Json sensitivity = {{"result", "rrc_N_per_kN"}, {"factors", {effect(0.32, -0.32), effect(0.1, 0.02)}}};
  sensitivity["factors"][0]["key"] = "ambient_degC";
  sensitivity["factors"][1]["key"] = "pressure_kPa";
  const std::vector<double> results(4, 5.0);
  const std::vector<report::FactorScatter> scatters{{"ambient_degC", {28.75, 21.25, 23.75, 26.25}, results},
                                                    {"pressure_kPa", {240.0, 240.0, 260.0, 260.0}, results}};
  const Table table{"", {"factor"}, {{"ambient_degC"}, {"pressure_kPa"}}};
  const report::Page page = report::make_sensitivity_page(sensitivity, table, "", scatters);
  const std::vector<report::Block>& blocks = page.sections.front().blocks;
  CHECK(blocks[0]["text"] ==
        "RRc depends most on ambient: on average, -0.32 N/kN as it rises by 5 °C; pressure 0.1 N/kN up or "
        "down.");
  CHECK(blocks[1]["tiles"][0]["value"] == "-0.32");
  CHECK(blocks[1]["tiles"][0]["note"] == "mean change as it rises by 5 °C (95 %: -0.352 to -0.288)");
  CHECK(blocks[1]["tiles"][1]["value"] == "0.1");  // the mean of changes that go either way hides them
  CHECK(blocks[2]["series"][0]["values"] == Json({-0.32, 0.1}));
  CHECK(blocks[2]["series"][0]["low"][0] == Approx(-0.352));
  CHECK(blocks[2]["series"][0]["high"][0] == Approx(-0.288));
}

TEST_CASE("a share of the variance is drawn from 0 to 100 %, and a note says where that was not its estimate",
          "[fast]") {
  const auto index = [](double low, double value, double high) {
    return Json{{"value", value}, {"low_95", low}, {"high_95", high}};
  };
  Json sensitivity = {{"result", "rrc_N_per_kN"},
                      {"factors",
                       {{{"key", "ambient_degC"}, {"first", index(0.5, 0.9, 1.5)}, {"total", index(0.6, 0.9, 1.3)}},
                        {{"key", "pressure_kPa"}, {"first", index(-0.1, 0.1, 0.2)}, {"total", index(0.0, 0.1, 0.2)}}}}};
  const Table table{"", {"factor"}, {{"ambient_degC"}, {"pressure_kPa"}}};
  const auto make_bars = [&] {
    return report::make_sensitivity_page(sensitivity, table, "", {}).sections.front().blocks[2];
  };
  const report::Block clipped = make_bars();
  CHECK(clipped["series"][0]["high"][0] == 100.0);
  CHECK(clipped["series"][0]["low"][1] == 0.0);
  CHECK_THAT(clipped["caption"].get<std::string>(), Catch::Contains("beyond 0 or 100 %"));
  sensitivity["factors"][0]["first"] = sensitivity["factors"][0]["total"] = index(0.8, 0.9, 1.0);
  sensitivity["factors"][1]["first"] = index(0.0, 0.1, 0.2);
  CHECK_THAT(make_bars()["caption"].get<std::string>(), !Catch::Contains("beyond"));
}
