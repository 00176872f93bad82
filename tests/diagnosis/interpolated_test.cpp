// Stretches that were not measured but interpolated are found and left out; what only looks straight is not.
#include "diagnosis/checks/interpolated.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/diagnosis/checked_sets.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/support/fit_study.h"

using Catch::Contains;
using namespace rollrig;
using diagnosis::find_interpolated;
using diagnosis::Interpolated;
using measurements::MeasuredRun;
using measurements::MeasurementSet;
using tests::short_set;

namespace {

/// A drive whose recorded speed scatters as that of a logger does, with hundredths of km/h and tenths of a newton.
MeasurementSet make_logged_trips() {
  MeasurementSet set = tests::add_noise(tests::make_road_set({}, 2), 3);
  for (MeasuredRun& run : set.runs) {
    std::vector<double>& speed_m_s = run.columns.at("speed_km_h");
    for (std::size_t row = 0; row < speed_m_s.size(); ++row) {
      const double km_h = speed_m_s[row] * 3.6 + 0.2 * std::sin(1.7 * static_cast<double>(row * row));
      if (speed_m_s[row] > 0.0) speed_m_s[row] = std::abs(std::round(100.0 * km_h) / 100.0) / 3.6;
    }
    for (double& force_N : run.columns.at("traction_force_N")) force_N = std::round(10.0 * force_N) / 10.0;
  }
  return set;
}

/// Rows in the middle of a run in which the force has samples.
diagnosis::SmoothRows find_driven(const MeasuredRun& run, std::size_t count) {
  const std::vector<double>& force_N = run.columns.at("traction_force_N");
  for (std::size_t first = 300, row = 300; row < force_N.size(); ++row) {
    if (std::isnan(force_N[row])) first = row + 1;
    if (row - first + 1 == count) return {first, row};
  }
  FAIL("no stretch of " << count << " rows");
  return {};
}

void draw_line(std::vector<double>& values, const diagnosis::SmoothRows& rows, double step) {
  const double from = values[rows.first];
  const double rise = (values[rows.last] - from) / static_cast<double>(rows.last - rows.first);
  for (std::size_t row = rows.first + 1; row < rows.last; ++row) {
    values[row] = std::round((from + rise * static_cast<double>(row - rows.first)) / step) * step;
  }
}

/// A cubic that leaves and arrives with a slope.
void draw_cubic(std::vector<double>& values, const diagnosis::SmoothRows& rows, double step, double bulge) {
  const double from = values[rows.first];
  const double rise = values[rows.last] - from;
  for (std::size_t row = rows.first + 1; row < rows.last; ++row) {
    const double x = static_cast<double>(row - rows.first) / static_cast<double>(rows.last - rows.first);
    const double value = from + rise * x + bulge * x * (1.0 - x) * (0.3 - x);
    values[row] = std::round(value / step) * step;
  }
}

}  // namespace

TEST_CASE("nothing is interpolated in sets as they are measured", "[fast]") {
  CHECK(find_interpolated(short_set()).rows.empty());
  CHECK(find_interpolated(make_logged_trips()).rows.empty());
  CHECK(find_interpolated(tests::make_road_set({}, 2)).rows.empty());
  CHECK(find_interpolated(tests::add_noise(tests::make_road_set({}, 2), 5)).rows.empty());
  CHECK(find_interpolated(tests::make_dyno_set({}, 1)).rows.empty());
  CHECK(find_interpolated(tests::add_noise(tests::make_dyno_set({}, 1), 5)).rows.empty());
}

TEST_CASE("a line through speed and force is found, and all that was measured there is left out", "[fast]") {
  MeasurementSet set = make_logged_trips();
  MeasuredRun& run = set.runs[1];
  const diagnosis::SmoothRows rows = find_driven(run, 60);
  draw_line(run.columns.at("speed_km_h"), rows, 0.01 / 3.6);
  draw_line(run.columns.at("traction_force_N"), rows, 0.1);
  const Interpolated found = find_interpolated(set);
  REQUIRE(found.rows.size() == 1);
  CHECK(found.rows[0].run == 1);
  CHECK(found.rows[0].channel == models::quantities::kTractionForce);
  CHECK(std::abs(static_cast<double>(found.rows[0].first_row) - static_cast<double>(rows.first)) <= 1.0);
  CHECK(std::abs(static_cast<double>(found.rows[0].last_row) - static_cast<double>(rows.last)) <= 1.0);
  REQUIRE(found.warnings.size() == 1);
  CHECK_THAT(found.warnings[0], Contains("speed_km_h, traction_force_N of run " + run.id) && Contains("interpolated") &&
                                    Contains("state of the tires is carried on"));
}

TEST_CASE("a cubic is found as well as a line", "[fast]") {
  MeasurementSet set = make_logged_trips();
  MeasuredRun& run = set.runs[0];
  const diagnosis::SmoothRows rows = find_driven(run, 60);
  draw_cubic(run.columns.at("traction_force_N"), rows, 0.1, 2000.0);
  const Interpolated found = find_interpolated(set);
  REQUIRE(found.rows.size() == 1);
  CHECK_THAT(found.warnings[0], Contains("traction_force_N of run " + run.id) && !Contains("state of the tires"));
}

TEST_CASE("where the inputs are unknown for longer than the tire remembers the run ends", "[fast]") {
  MeasurementSet set = make_logged_trips();
  MeasuredRun& run = set.runs[0];
  const diagnosis::SmoothRows driven = find_driven(run, 60);
  const diagnosis::SmoothRows rows{driven.first, driven.first + 400};
  std::vector<double>& force_N = run.columns.at("traction_force_N");
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    if (std::isnan(force_N[row])) force_N[row] = 300.0;
  }
  draw_line(run.columns.at("speed_km_h"), rows, 0.01 / 3.6);
  draw_line(force_N, rows, 0.1);
  const Interpolated found = find_interpolated(set);
  REQUIRE(found.rows.size() == 1);
  CHECK(found.rows[0].last_row == run.time_s.size() - 1);
  CHECK_THAT(found.warnings[0], Contains("to the end of the run"));
}

TEST_CASE("interpolated torque on a drum is found although speed and load are straight by themselves", "[fast]") {
  MeasurementSet set = short_set();
  MeasuredRun& run = set.runs[0];
  std::vector<double>& torque_Nm = run.columns.at("drum_torque_Nm");
  std::size_t first = torque_Nm.size() / 2;
  while (std::isnan(torque_Nm[first])) ++first;
  draw_line(torque_Nm, {first, first + 90}, 1e-6);
  const Interpolated found = find_interpolated(set);
  REQUIRE(found.rows.size() == 1);
  CHECK_THAT(found.warnings[0], Contains("drum_torque_Nm of run " + run.id));
}
