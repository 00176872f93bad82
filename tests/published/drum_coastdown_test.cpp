// Real coast-downs of a bicycle-size tire, where they are present: ROLLRIG_MEASURED_DATA.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "build_paths.h"
#include "estimation/drum_deceleration/drum_coastdown.h"

namespace fs = std::filesystem;
using namespace rollrig;

namespace {

/// Folder of the measured coast-downs, or empty with a message.
std::string find_data() {
  const char* folder = std::getenv("ROLLRIG_MEASURED_DATA");
  const fs::path data = fs::path(folder != nullptr ? folder : "") / "drum_coastdown";
  if (folder != nullptr && fs::exists(data)) return data.string();
  WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
  return {};
}

const estimation::SpeedPoint& at(const estimation::DrumCoastdownFit& fit, double speed_m_s) {
  for (const auto& point : fit.points) {
    if (std::abs(point.speed_m_s - speed_m_s) < 1e-6) return point;
  }
  throw std::logic_error("no such speed");
}

}  // namespace

TEST_CASE("measured drum coast-downs: pressure exponent, directions, drum alone", "[published]") {
  const std::string data = find_data();
  if (data.empty()) return;
  const auto set = estimation::read_coast_set(ROLLRIG_SOURCE_DIR "/tests/published/drum_coastdown/set.toml", data);
  REQUIRE(set.runs.size() == 20);
  const auto fit = estimation::fit_drum_coastdown(set);
  const auto& point = at(fit, 18.0);

  // README of the data: -0.47 to -0.51 at 18 m/s. The interval holds the scatter of the five pressures about the law.
  CHECK(point.pressure_exponent->value > -0.51);
  CHECK(point.pressure_exponent->value < -0.47);
  CHECK(point.pressure_exponent->lower < -0.51);
  CHECK(point.pressure_exponent->upper > -0.47);
  CHECK(point.pressure_exponent->upper < 0.0);

  // README: net deceleration at 18 m/s for 40 to 80 psi
  const double published_net_m_s2[] = {0.116, 0.104, 0.0888, 0.0864, 0.0841};
  REQUIRE(point.levels.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    INFO(point.levels[i].pressure_Pa);
    CHECK(point.levels[i].net_m_s2.lower < published_net_m_s2[i]);
    CHECK(point.levels[i].net_m_s2.upper > published_net_m_s2[i]);
    CHECK_FALSE(point.levels[i].in_range_left_out);
  }

  // README: drum alone at 22, 18, 14, 10, 6 m/s, repeatable to 2 to 4 %
  const std::pair<double, double> published_drum[] = {
      {22.0, 0.0951}, {18.0, 0.0684}, {14.0, 0.0463}, {10.0, 0.0292}, {6.0, 0.0170}};
  for (const auto& [speed_m_s, deceleration_m_s2] : published_drum) {
    const auto& drum = at(fit, speed_m_s);
    INFO(speed_m_s);
    CHECK(drum.drum_alone_m_s2->value == Approx(deceleration_m_s2).epsilon(0.06));
    CHECK(drum.drum_repeatability->value < 0.04);
    CHECK(drum.drum_repeatability->upper > 0.02);
  }

  REQUIRE(point.direction_ratio.has_value());
  CHECK(std::abs(point.direction_ratio->value) < 0.02);
  CHECK(point.direction_ratio->lower < 0.0);
  CHECK(point.direction_ratio->upper > 0.0);

  // The resonance near 10 m/s, found in the hardest tire and not with the tire lifted
  bool hardest = false;
  for (const auto& found : fit.resonances) {
    CHECK(found.state == estimation::CoastState::kLoaded);
    CHECK(found.resonance.peak_m_s > 7.0);
    CHECK(found.resonance.peak_m_s < 11.0);
    if (found.pressure_Pa > 540e3) hardest = true;
  }
  CHECK(hardest);
}
