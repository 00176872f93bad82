// What the sliders show is what the command line computes, and no request names a file.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include <algorithm>

#include "rollrig/run.h"
#include "serve/live_run.h"
#include "serve/refusal.h"
#include "sim/core/error.h"

using namespace rollrig;
using serve::carry_out_live;
using serve::Shelf;

namespace {

const Shelf& shelf() {
  static const Shelf made({});
  return made;
}

Json make_request() { return {{"scenario", "iso_28580"}, {"tire", "a50"}}; }

/// The first table of lines of the page, where a person reads the result.
Json find_lines(const Json& answer) {
  for (const Json& section : answer["page"]["sections"]) {
    for (const Json& block : section["blocks"]) {
      if (block["type"] == "lines") return block["lines"];
    }
  }
  return {};
}

std::string value_of(const Json& answer, const std::string& label) {
  for (const Json& line : find_lines(answer)) {
    if (line["label"] == label) return line["value"].get<std::string>();
  }
  return "";
}

}  // namespace

TEST_CASE("a live run gives the numbers of rollrig run", "[fast]") {
  Json request = make_request();
  request["settings"] = {{"pressure_kPa", 233.5}, {"ambient_degC", 18.0}};
  request["effects"] = {{"bearing_warmup", {{"fall_per_K", 0.03}}}};
  const Json answer = carry_out_live(request, shelf());
  RunInput input;
  input.scenario_or_file = "iso_28580";
  input.tire = "a50";
  input.fidelity = "quasi_static";
  input.settings = {"pressure_kPa=233.5", "ambient_degC=18", "effects.bearing_warmup.fall_per_K=0.03"};
  const RunResult result = Run(input).carry_out();
  const auto rrc = std::find_if(result.values.begin(), result.values.end(),
                                [](const ResultValue& value) { return value.name == "rrc_N_per_kN"; });
  REQUIRE(rrc != result.values.end());
  CHECK(value_of(answer, "RRc") == fmt::format("{:.3f} N/kN", *rrc->number));
  CHECK(answer["settings"]["pressure_kPa"] == 233.5);
  CHECK(answer["settings"]["speed_km_h"] == 80.0);
}

TEST_CASE("every scenario that is offered runs with its defaults", "[slow]") {
  const Json choices = shelf().make_choices();
  CHECK(choices["scenarios"].size() >= 10);
  for (const Json& scenario : choices["scenarios"]) {
    INFO(scenario["name"]);
    const Json answer = carry_out_live({{"scenario", scenario["name"]}, {"tire", "a50"}}, shelf());
    CHECK(answer["page"]["sections"].size() >= 4);
    for (const Json& setting : scenario["settings"]) {
      INFO(setting["key"]);
      CHECK(answer["settings"].contains(setting["key"].get<std::string>()));
    }
  }
}

TEST_CASE("a number that is not allowed is an error that names its key", "[fast]") {
  Json request = make_request();
  request["settings"] = {{"pressure_kPa", 5.0}};
  try {
    carry_out_live(request, shelf());
    FAIL("nothing was thrown");
  } catch (const InputError& error) {
    CHECK(error.problem().key == "[settings] pressure_kPa");  // by which the page finds the control
    CHECK_THAT(error.problem().allowed, Catch::Contains(">= 50 and <= 1000"));
  }
}

TEST_CASE("no request names a file", "[fast]") {
  const auto refuses = [](const Json& request) {
    INFO(request.dump());
    try {
      carry_out_live(request, shelf());
    } catch (const InputError& error) {
      CHECK(error.problem().file.rfind("/", 0) != 0);  // none was opened
      return true;
    } catch (const serve::Refusal&) {
      return true;
    }
    return false;
  };
  for (const char* path : {"/etc/passwd", "../../etc/passwd", "./a50.toml", "assets/tires/a50.toml"}) {
    CHECK(refuses({{"scenario", "iso_28580"}, {"tire", path}}));
    CHECK(refuses({{"scenario", path}, {"tire", "a50"}}));
    CHECK(refuses({{"scenario", "iso_28580"}, {"tire", "a50"}, {"rig", path}}));
    CHECK(refuses({{"scenario", "follow_drum"}, {"tire", "a50"}, {"settings", {{"program", path}}}}));
    CHECK(refuses({{"scenario", "iso_28580"}, {"tire", "a50"}, {"settings", {{"method", path}}}}));
    CHECK(refuses({{"scenario", "drive_cycle"}, {"tire", "a50"}, {"settings", {{"cycle", path}}}}));
    CHECK(refuses({{"scenario", "iso_28580"}, {"tire", "a50"}, {"sensors", path}, {"settings", {{"x", path}}}}));
  }
}

TEST_CASE("a request of another form is refused", "[fast]") {
  for (const Json& request :
       {Json(1), Json::array(), Json{{"scenario", 1}}, Json{{"scenario", "iso_28580"}, {"tire", Json::array()}},
        Json{{"scenario", "iso_28580"}, {"tire", "a50"}, {"settings", "a"}},
        Json{{"scenario", "iso_28580"}, {"tire", "a50"}, {"settings", {{"a.b", 1}}}},
        Json{{"scenario", "iso_28580"}, {"tire", "a50"}, {"settings", {{"load_N", {1, 2}}}}},
        Json{{"scenario", "iso_28580"}, {"tire", "a50"}, {"effects", {{"windage", 1}}}}}) {
    INFO(request.dump());
    CHECK_THROWS_AS(carry_out_live(request, shelf()), serve::Refusal);
  }
}
