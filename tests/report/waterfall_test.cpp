// A waterfall leads from its first value to its last.
#include <catch2/catch.hpp>
#include <cmath>

#include "report/blocks.h"
#include "report/comparison_page.h"
#include "report/diagnosis_page.h"

using namespace rollrig;

TEST_CASE("the steps of a waterfall lead from its first value to its last", "[fast]") {
  const std::vector<report::WaterfallBar> steps = {{"load", 0.1 + 0.2}, {"pressure", -1.0, {{-1.5, -0.5}}}};
  const Json block =
      report::make_waterfall({"Loss", "J"}, {"measured", 5.0}, steps, {"simulated", 4.3}, "In this order.");
  CHECK(block["type"] == "waterfall");
  CHECK(block["unit"] == "J");
  CHECK(block["steps"][1] == Json({{"name", "pressure"}, {"value", -1.0}, {"low", -1.5}, {"high", -0.5}}));
  const double sum = block["start"]["value"].get<double>() + block["steps"][0]["value"].get<double>() +
                     block["steps"][1]["value"].get<double>();
  CHECK(sum == Approx(block["end"]["value"].get<double>()));
}

TEST_CASE("what rounding leaves is no step of a waterfall", "[fast]") {
  const Json block =
      report::make_waterfall({"Energy", "kJ"}, {"a", 1.0}, {{"load", 0.5}, {"rest", -9e-13}}, {"b", 1.5});
  CHECK(block["steps"][1]["value"] == 0.0);
  EnergyWaterfall waterfall{"b", "motor", 1000.0, {{"tire_loss", 500.0}, {"not closed", -9e-10}}, 1500.0};
  const std::vector<EnergyStep> shown = report::list_shown_steps(waterfall);
  REQUIRE(shown.size() == 1);
  CHECK(shown[0].name == "tire loss");
}

TEST_CASE("a waterfall whose steps lead elsewhere is refused", "[fast]") {
  const std::vector<report::WaterfallBar> steps = {{"load", 0.5}};
  CHECK_THROWS_AS(report::make_waterfall({}, {"a", 1.0}, steps, {"b", 1.6}), std::logic_error);
  CHECK_THROWS_AS(report::make_waterfall({}, {"a", 1.0}, steps, {"b", std::nan("")}), std::logic_error);
  CHECK_THROWS_AS(report::make_waterfall({}, {"a", std::nan("")}, steps, {"b", 1.5}), std::logic_error);
}

TEST_CASE("the gap's waterfalls show what each step takes, in the force's unit and in noise floors", "[fast]") {
  Gap gap;
  CHECK(report::make_gap_waterfalls(gap).empty());  // of an answer without steps
  const auto add = [&gap](const char* name, double floors, double force_N) {
    gap.steps.push_back(
        {name, floors, std::nullopt, {{"liner_temperature_degC", "degC", 0.3}, {"drum_torque_Nm", "N", force_N}}});
  };
  add("as calibrated", 6.0, 2.0);
  add("recalibrated", 3.5, 1.5);
  add("bearing_warmup", 1.0, 0.5);
  add("load_exponent", 0.25, 0.125);
  const std::vector<report::Block> blocks = report::make_gap_waterfalls(gap);
  REQUIRE(blocks.size() == 2);
  CHECK(blocks[0]["unit"] == "N");
  CHECK(blocks[0]["start"]["value"] == 2.0);
  CHECK(blocks[0]["steps"][1] == Json({{"name", "bearing warmup"}, {"value", -1.0}}));
  CHECK(blocks[0]["end"]["value"] == 0.125);
  CHECK(blocks[1]["unit"] == "noise floors");
  CHECK(blocks[1]["steps"].size() == 3);
  CHECK(blocks[1]["steps"][0]["value"] == -2.5);
  CHECK_THAT(blocks[0]["caption"].get<std::string>(), Catch::Contains("the order matters"));
}
