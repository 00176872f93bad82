// The source's drive cycle: Tables 4.2, 4.4, 4.5 and 5.1. What is fitted, predicted and not reproduced is said
// in the README.md of each folder beside this file.
#include <catch2/catch.hpp>

#include <cmath>

#include "build_paths.h"
#include "sim/core/schema.h"
#include "tests/support/drum_fixture.h"
#include "tools/figure_3_13.h"
#include "tools/published_numbers.h"
#include "tools/tire_drive.h"

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

TEST_CASE("the scenario gives Tables 4.4 and 4.5, both sides of the ratio true losses", "[published]") {
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
    // In the calibration, 0.6 over all: there the coefficient is that of the virtual ISO test, here that of the file.
    CHECK(std::sqrt(squares) <= 0.9);
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
  CHECK(fit.rms < 0.025);  // a trial that mixed true and reported losses came to 1.5 points
}
