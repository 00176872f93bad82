// Times through speed bins of an electric car, measured by others: read where they are, else skipped.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "build_paths.h"
#include "estimation/road_load/coastdown_file.h"
#include "estimation/road_load/road_load_checks.h"

namespace fs = std::filesystem;
using namespace rollrig;

namespace {

std::string find_file() {
  const char* folder = std::getenv("ROLLRIG_MEASURED_DATA");
  const fs::path file = fs::path(folder != nullptr ? folder : ROLLRIG_SOURCE_DIR "/../shared/data/measured") /
                        "road_coastdown_bins" / "ioniq_2026-01-16.csv";
  return fs::exists(file) ? file.string() : std::string();
}

/// The value that came with the data, per unit of effective mass; "about" (README of the measured data).
double given_m_s2(double v) { return 0.065 + 2.4e-4 * v * v; }

/// Largest relative deviation from it from 40 to 95 km/h.
double worst_deviation(const char* name, const estimation::RoadLoadFit& fit) {
  double worst = 0.0;
  double at = 0.0;
  for (double km_h = 40.0; km_h <= 95.0; km_h += 1.0) {
    const double v = km_h / 3.6;
    const double deviation = fit.force_N(v) / given_m_s2(v) - 1.0;
    if (std::abs(deviation) > std::abs(worst)) {
      worst = deviation;
      at = km_h;
    }
  }
  std::cout << fmt::format("{:<44} {:+.2f} % at {:.0f} km/h, sd there {:.2f} %\n", name, 100.0 * worst, at,
                           100.0 * fit.force_sd_N(at / 3.6) / given_m_s2(at / 3.6));
  return std::abs(worst);
}

estimation::CoastdownData session_of(const estimation::CoastdownData& data, const std::string& begins_with) {
  estimation::CoastdownData part;
  for (const auto& run : data.runs) {
    if (run.session.rfind(begins_with, 0) == 0) part.runs.push_back(run);
  }
  return part;
}

}  // namespace

TEST_CASE("measured bins: force per unit of mass as given, drift of the sessions", "[fast]") {
  const std::string file = find_file();
  if (file.empty()) {
    WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
    return;
  }
  const auto coastdowns = estimation::read_coastdowns(file);
  CHECK(coastdowns.data.runs.size() == 60);
  CHECK_FALSE(coastdowns.is_trace);

  // The session in which high and low speeds take turns: the one that has both of them in the same state.
  const estimation::CoastdownData interleaved = session_of(coastdowns.data, "intercalado");
  REQUIRE(interleaved.runs.size() == 20);
  CHECK(worst_deviation("interleaved session, A, B, C", estimation::fit_road_load(interleaved, {})) < 0.02);

  // All three. The given value has no B.
  estimation::RoadLoadFitOptions without_B;
  const double none = std::numeric_limits<double>::infinity();
  without_B.bounds = estimation::RoadLoadBounds{{-none, 0.0, -none}, {none, 0.0, none}};
  CHECK(worst_deviation("three sessions, B held at 0", estimation::fit_road_load(coastdowns.data, without_B)) < 0.02);

  // With B free the curve bends by 3 % where no session has data (55 to 70 km/h): beyond 2 %, within its own
  // standard deviation, since the sessions differ from each other by more than their noise.
  const estimation::RoadLoadFit fit = estimation::fit_road_load(coastdowns.data, {});
  CHECK(worst_deviation("three sessions, A, B, C", fit) < 0.035);
  for (double km_h = 40.0; km_h <= 95.0; km_h += 5.0) {
    const double v = km_h / 3.6;
    CHECK(std::abs(fit.force_N(v) - given_m_s2(v)) < 2.0 * fit.force_sd_N(v));
  }
  CHECK(fit.scatter.session_force_N.value_or(0.0) > 0.0);

  const auto drifts = estimation::find_session_drifts(coastdowns.data, fit);
  REQUIRE(drifts.size() == 3);
  for (const auto& drift : drifts) {
    std::cout << fmt::format("{:<44} coast times {:+.1f} % ({:+.1f} to {:+.1f}) over {} runs\n", drift.session,
                             100.0 * drift.time_change, 100.0 * drift.lower_95, 100.0 * drift.upper_95, drift.runs);
  }
  // "Coast times drift by 3 to 4 % over the session": the session of high speeds
  CHECK(drifts[0].time_change == Approx(0.035).margin(0.01));
  CHECK(drifts[0].lower_95 > 0.0);
}
