// The animation's bodies are where the multibody rig had them.
#include "report/run_page.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenarios/run/run_spec.h"

using namespace rollrig;

namespace {

scenarios::RunSpec make_spec(const std::string& scenario, const std::vector<std::string>& settings) {
  ConfigTable document = scenarios::make_run_document(scenario);
  document.entries["tire"] = ConfigValue{std::string("a50"), {"test", 0}, "a50"};
  for (const std::string& setting : settings) scenarios::set_run_value(document, setting);
  return scenarios::read_run_spec(document, "");
}

/// Value of a series {t, y} at a time that it has.
double value_at(const Json& series, double time_s) {
  std::size_t after = 1;
  while (after + 1 < series["t"].size() && series["t"][after].get<double>() < time_s) ++after;
  const auto t = [&](std::size_t i) { return series["t"][i].get<double>(); };
  const auto y = [&](std::size_t i) { return series["y"][i].get<double>(); };
  return y(after - 1) + (time_s - t(after - 1)) / (t(after) - t(after - 1)) * (y(after) - y(after - 1));
}

/// Value of the last row {row, y} at or before one.
double find_recorded(const Json& recorded, std::size_t row) {
  std::size_t at = 0;
  while (at + 1 < recorded["row"].size() && recorded["row"][at + 1] <= row) ++at;
  return recorded["y"][at];
}

}  // namespace

TEST_CASE("the drum's animation has the recorded heights and angles", "[fast]") {
  const scenarios::RunSpec spec = make_spec("warm_up", {"warm_up_min=5", "load_N=5400", "speed_km_h=80"});
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  const Json block = report::make_animation(spec, outcome.recording);
  REQUIRE(block["machine"] == "drum");
  const Json& wheel = block["wheels"][0];
  const auto& tire = spec.tire.values;
  const double loaded_m = tire.geometry.outer_diameter_m / 2.0 - 5400.0 / tire.stiffness.vertical_N_per_m;
  CHECK(value_at(wheel["axle_height_m"], 200.0) == Approx(1.0 + loaded_m).margin(1e-5));
  const double speed_m_s = 80.0 / 3.6;
  const auto turned = [&](const char* of) { return value_at(wheel[of], 200.0) - value_at(wheel[of], 100.0); };
  CHECK(turned("surface_angle_rad") == Approx(100.0 * speed_m_s).epsilon(1e-3));
  CHECK(turned("angle_rad") == Approx(100.0 * speed_m_s / loaded_m).epsilon(2e-3));
}

TEST_CASE("without bodies the animation follows from speed and load, alike", "[fast]") {
  const std::vector<std::string> settings{"warm_up_min=5"};
  scenarios::RunSpec spec = make_spec("warm_up", settings);
  const Json with_bodies = report::make_animation(spec, scenarios::run_scenario(spec, {}).recording);
  spec.fidelity = scenarios::Fidelity::kQuasiStatic;
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  CHECK(outcome.recording.poses.empty());
  const Json without = report::make_animation(spec, outcome.recording);
  for (const double time_s : {50.0, 250.0}) {
    CHECK(value_at(without["wheels"][0]["axle_height_m"], time_s) ==
          Approx(value_at(with_bodies["wheels"][0]["axle_height_m"], time_s)).margin(1e-4));
  }
}

TEST_CASE("on the road the vehicle moves on, its axles carry it at the loaded radius", "[fast]") {
  const scenarios::RunSpec spec = make_spec("coastdown", {"warm_up_min=1"});
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  const Json block = report::make_animation(spec, outcome.recording);
  REQUIRE(block["machine"] == "road");
  REQUIRE(block["wheels"].size() == 2);
  const double radius_m = spec.tire.values.geometry.outer_diameter_m / 2.0;
  for (const Json& wheel : block["wheels"]) {
    const double sunk_m = radius_m - value_at(wheel["axle_height_m"], 60.0);
    CHECK(sunk_m == Approx(find_recorded(wheel["load_N"], outcome.recording.row_at(60.0)) /
                           spec.tire.values.stiffness.vertical_N_per_m)
                        .margin(2e-4));
  }
  const double way_m = value_at(block["position_m"], 60.0) - value_at(block["position_m"], 50.0);
  CHECK(way_m == Approx(10.0 * 80.0 / 3.6).epsilon(2e-3));
}
