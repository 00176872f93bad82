// A waterfall leads from its first value to its last.
#include <catch2/catch.hpp>
#include <cmath>

#include "report/blocks.h"

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

TEST_CASE("a waterfall whose steps lead elsewhere is refused", "[fast]") {
  const std::vector<report::WaterfallBar> steps = {{"load", 0.5}};
  CHECK_THROWS_AS(report::make_waterfall({}, {"a", 1.0}, steps, {"b", 1.6}), std::logic_error);
  CHECK_THROWS_AS(report::make_waterfall({}, {"a", 1.0}, steps, {"b", std::nan("")}), std::logic_error);
  CHECK_THROWS_AS(report::make_waterfall({}, {"a", std::nan("")}, steps, {"b", 1.5}), std::logic_error);
}
