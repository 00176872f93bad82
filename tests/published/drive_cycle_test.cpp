// The source's drive cycle: Tables 4.2, 4.4, 4.5 and 5.1. What is fitted, predicted and not reproduced is said
// in the README.md of each folder beside this file.
#include <catch2/catch.hpp>

#include <cmath>

#include "build_paths.h"
#include "models/tire/rolling_resistance.h"
#include "sim/core/schema.h"
#include "tests/support/drum_fixture.h"
#include "tools/tire_drive.h"
#include "tools/virtual_tests.h"

using namespace rollrig;

namespace {

const std::string kFolder = ROLLRIG_SOURCE_DIR "/tests/published";
const std::vector<std::string> kTires{"a40", "a50", "a60"};

/// The sections of a case's run file.
Json run_sections(const std::string& tire) {
  const std::string path = kFolder + "/table_4_4_and_4_5/" + tire + ".toml";
  const scenarios::RunSpec spec = scenarios::read_run_spec(read_config(path), kFolder + "/table_4_4_and_4_5");
  return scenarios::run_scenario(spec, {}).result["sections"];
}

}  // namespace

TEST_CASE("Tables 4.4 and 4.5 within 0.5 points rms over each tire's eight sections (fitted)", "[published]") {
  for (const std::string& tire : kTires) {
    const std::vector<double> published = tools::read_published_tire(kFolder, tire).sections();
    const Json sections = run_sections(tire);
    REQUIRE(sections.size() == published.size());
    double squares = 0.0;
    for (std::size_t i = 0; i < published.size(); ++i) {
      const double points = sections[i]["difference_percent"].get<double>() - 100.0 * published[i];
      squares += points * points / static_cast<double>(published.size());
    }
    INFO(tire << " " << std::sqrt(squares));
    CHECK(std::sqrt(squares) <= 0.5);
  }
}

TEST_CASE("over City 3 a40 and a50 cool by about 10 and 7 degC (§4.4.3, fitted)", "[published]") {
  // a60's 5 degC are not reproduced: see table_4_4_and_4_5/README.md and docs/published.md.
  for (const auto& [tire, fall_K] : {std::pair{"a40", 10.0}, std::pair{"a50", 7.0}}) {
    const Json city_3 = run_sections(tire)[4];
    INFO(tire);
    const double found_K =
        city_3["temperature_start_degC"].get<double>() - city_3["temperature_end_degC"].get<double>();
    CHECK(found_K == Approx(fall_K).margin(2.0));  // the model's own error of temperature (§6)
  }
}

TEST_CASE("Table 5.1 within 0.35 Wh/km in every cell (predicted)", "[published]") {
  const ConfigTable published = read_config(kFolder + "/table_5_1/expected.toml");
  for (const std::string& tire : kTires) {
    TableReader reader(*published.find(tire)->as_table(), "[" + tire + "]");
    const auto source = [&reader](const char* key) { return reader.number({key, any_number(), ""}); };
    const tools::EnergyRow row = tools::make_energy_row(tools::drive_source_test(tire));
    INFO(tire);
    constexpr double kBar_Wh_per_km = 0.35;
    CHECK(row.city == Approx(source("city")).margin(kBar_Wh_per_km));
    CHECK(row.highway == Approx(source("highway")).margin(kBar_Wh_per_km));
    CHECK(row.overall == Approx(source("overall")).margin(kBar_Wh_per_km));
    CHECK(row.iso == Approx(source("iso")).margin(kBar_Wh_per_km));
    // What the bar on the overall loss is in the last column.
    CHECK(row.difference == Approx(source("difference_percent")).margin(kBar_Wh_per_km / source("overall")));
  }
}

TEST_CASE("Table 4.2: the source's ISO column, and the order of the tires in the model's", "[published]") {
  std::map<std::string, tools::HighwayEnergy> energy;
  for (const std::string& tire : kTires) energy[tire] = tools::find_highway_energy(tools::drive_dyno_setting(tire));
  // Closed form of the ISO column: 66 km of tires; the stretches below 20 km/h (0.5 %) do not count here.
  CHECK(energy["a40"].iso_Wh - energy["a50"].iso_Wh == Approx(71.8).epsilon(0.02));
  CHECK(energy["a60"].iso_Wh - energy["a50"].iso_Wh == Approx(39.9).epsilon(0.02));
  // The model's column is shown in docs/published.md as it comes out. What the source concludes from it:
  // the loss that a warming tire adds makes the differences larger than the ISO coefficients do.
  CHECK(energy["a40"].model_Wh - energy["a50"].model_Wh > energy["a40"].iso_Wh - energy["a50"].iso_Wh);
  CHECK(energy["a60"].model_Wh - energy["a50"].model_Wh > energy["a60"].iso_Wh - energy["a50"].iso_Wh);
}

TEST_CASE("a50 with A and B of Figure 3.13: z and f alone bring Tables 4.4 and 4.5 to a few points", "[published]") {
  const std::vector<double> published = tools::read_published_tire(kFolder, "a50").sections();
  const tools::CoolingFit fit = tools::fit_cooling_to_figure_3_13(published, 18040.0);
  CHECK(fit.rest_conductance_W_per_K > 0.0);
  CHECK(fit.speed_conductance_W_s_per_m_K > 0.0);
  CHECK(fit.rms < 0.02);  // a trial of the source's numbers came to 1.5 points
}

TEST_CASE("the law of every tire is positive and rises with speed from standstill to 150 km/h", "[published]") {
  for (const std::string& tire : kTires) {
    const models::TireParameters<double> p = tests::read_asset_tire(tire).values;
    double last_A = 0.0, last_B = 0.0;
    for (double km_h = 0.0; km_h <= 150.0; km_h += 5.0) {
      INFO(tire << " at " << km_h << " km/h");
      const auto c = models::calc_loss_coefficients(p, km_h / 3.6, 5400.0);
      CHECK(c.A_N > 0.0);
      CHECK(c.B_per_K > 0.0);
      CHECK(c.A_N >= last_A);
      CHECK(c.B_per_K >= last_B);
      last_A = c.A_N;
      last_B = c.B_per_K;
    }
  }
}
