// Rows merged where the machine holds still: which, and that a simulation of fewer rows says the same.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/comparison/prepared_set.h"
#include "measurements/merged_rows.h"
#include "measurements/resimulation.h"
#include "tests/support/drum_sets.h"
#include "tests/support/machines.h"

using namespace rollrig;
using measurements::MeasuredRun;
using measurements::MergedRun;
namespace quantities = models::quantities;

namespace {

/// An hour at 1 Hz: standstill for 10 min, then 80 km/h, the load doubled half an hour after the start, in air that
/// warms.
MeasuredRun make_run() {
  MeasuredRun run;
  run.id = "a";
  run.cold_pressure_Pa = 250e3;
  run.initial_tire_temperature_K = 298.15;
  for (int row = 0; row <= 3600; ++row) {
    const double time_s = row;
    run.time_s.push_back(time_s);
    run.columns[quantities::kSpeed].push_back(row < 600 ? 0.0 : std::min(22.0, 0.5 * (time_s - 600.0)));
    run.columns[quantities::kLoad].push_back(row < 1800 ? 2000.0 : 4000.0);
    run.columns[quantities::kAmbient].push_back(298.15 + 1e-3 * time_s);
    run.columns[quantities::kLinerTemperature].push_back(row % 2 == 0 ? time_s : std::nan(""));
  }
  return run;
}

std::vector<std::size_t> count_rows(const MergedRun& merged) {
  std::vector<std::size_t> counts(merged.run.time_s.size(), 0);
  for (const std::size_t row : merged.row_of) ++counts[row];
  return counts;
}

}  // namespace

TEST_CASE("rows are merged from 2 min after a change to 10 s before the next, longer and longer", "[fast]") {
  const MeasuredRun run = make_run();
  constexpr double kLongest_s = 60.0;
  const MergedRun merged = measurements::merge_steady_rows(run, *tests::kDrum, {}, kLongest_s);
  const std::vector<std::size_t> counts = count_rows(merged);
  REQUIRE(merged.row_of.size() == run.time_s.size());
  CHECK(merged.run.time_s.size() < 1000);
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const double time_s = run.time_s[row];
    double since_s = time_s;  // the last change: standstill, the ramp of 44 s, speed, load
    for (const double change_s : {600.0, 644.0, 1800.0}) {
      if (time_s >= change_s) since_s = time_s - change_s;
    }
    double until_s = 3600.0 - time_s;
    for (const double change_s : {1800.0, 600.0}) {
      if (time_s < change_s) until_s = change_s - time_s;
    }
    const std::size_t count = counts[merged.row_of[row]];
    INFO("at " << time_s << " s, " << count << " rows are merged");
    if (since_s < 118.0 || until_s < 10.0) CHECK(count == 1);
    CHECK(static_cast<double>(count) <= std::min(kLongest_s, std::max(10.0, 0.1 * since_s)) + 1.0);
    if (since_s > 130.0 && until_s > 80.0) CHECK(count >= 10);
  }
}

TEST_CASE("a merged row has the mean time, the mean inputs and the mean of the samples that are there", "[fast]") {
  const MeasuredRun run = make_run();
  const MergedRun merged = measurements::merge_steady_rows(run, *tests::kDrum, {}, 60.0);
  const std::vector<double>& bounds_s = merged.run.mean_bounds_s;
  REQUIRE(bounds_s.size() == merged.run.time_s.size() + 1);
  CHECK(bounds_s.front() == run.time_s.front());
  CHECK(bounds_s.back() == run.time_s.back());
  const std::vector<std::size_t> counts = count_rows(merged);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double time_s = merged.run.time_s[i];
    CHECK(bounds_s[i] < bounds_s[i + 1]);
    CHECK(merged.run.column(quantities::kAmbient)[i] == Approx(298.15 + 1e-3 * time_s));
    if (counts[i] == 1) continue;
    CHECK(bounds_s[i + 1] - bounds_s[i] == Approx(static_cast<double>(counts[i])));
    CHECK(0.5 * (bounds_s[i] + bounds_s[i + 1]) == Approx(time_s));
    CHECK(std::abs(merged.run.column(quantities::kLinerTemperature)[i] - time_s) <= 0.5);
  }
}

TEST_CASE("a merged row begins where it is told to", "[fast]") {
  const MeasuredRun run = make_run();
  const MergedRun merged = measurements::merge_steady_rows(run, *tests::kDrum, {2503, 2507, 3001}, 600.0);
  for (const std::size_t cut : {2503U, 2507U, 3001U}) CHECK(merged.row_of[cut] == merged.row_of[cut - 1] + 1);
  CHECK(merged.row_of[2504] == merged.row_of[2503]);
}

TEST_CASE("rows of a speed that moves, of a weight that is hung on the sensor, and of a vehicle are not merged",
          "[fast]") {
  MeasuredRun drifting = make_run();
  for (std::size_t row = 644; row < drifting.time_s.size(); ++row)
    drifting.column(quantities::kSpeed)[row] += 1e-5 * static_cast<double>(row);
  const MergedRun held = measurements::merge_steady_rows(make_run(), *tests::kDrum, {}, 60.0);
  const MergedRun moving = measurements::merge_steady_rows(drifting, *tests::kDrum, {}, 60.0);
  CHECK(moving.row_of.back() - moving.row_of[644] == 3600 - 644);
  CHECK(held.row_of.back() - held.row_of[644] < 700);
  MeasuredRun hung = make_run();
  hung.columns[quantities::kHungTorque].assign(hung.time_s.size(), 0.0);
  for (std::size_t row = 3000; row < 3300; ++row) hung.column(quantities::kHungTorque)[row] = 50.0;
  const MergedRun with_weight = measurements::merge_steady_rows(hung, *tests::kDrum, {}, 60.0);
  for (std::size_t row = 3000; row < 3100; ++row) CHECK(with_weight.row_of[row + 1] == with_weight.row_of[row] + 1);
  const MergedRun vehicle = measurements::merge_steady_rows(make_run(), *tests::kDyno, {}, 60.0);
  CHECK(vehicle.run.time_s == make_run().time_s);
  CHECK(vehicle.run.mean_bounds_s.empty());
}

TEST_CASE("means over blocks are those of a simulation of all rows, whatever acts", "[fast]") {
  const measurements::MeasurementSet set = tests::simulate_campaign(tests::make_short_campaign());
  const diagnosis::PreparedSet prepared(set);
  for (const char* id : {"", "bearing_warmup", "torque_zero_drift", "clock_shift", "gas_heat_transfer", "cavity_volume",
                         "tread_liner_lag", "rim_heat", "rubber_memory", "slow_leak"}) {
    INFO(id);
    std::vector<models::ActiveEffect> effects;
    if (*id != '\0') effects = {tests::make_effect_at(id, 0.8)};
    models::Corner<double> corner(measurements::make_context(set), effects);
    std::size_t fewer = 0;
    for (std::size_t r = 0; r < prepared.runs().size(); ++r) {
      const diagnosis::PreparedRun& run = prepared.runs()[r];
      const measurements::Resimulation of_all_rows(run.measured, *set.kind);
      const auto all = of_all_rows.simulate(prepared.source(), run.measured, corner);
      const auto merged = run.resimulation.simulate(prepared.source(), run.simulated.run, corner);
      fewer += run.measured.time_s.size() > 2 * run.simulated.run.time_s.size() ? 1 : 0;
      for (const diagnosis::Series& series : prepared.series()) {
        if (series.run != r) continue;
        const std::vector<double>& of_all = all.channel(prepared.channels()[series.channel]);
        const std::vector<double>& of_merged = merged.channel(prepared.channels()[series.channel]);
        for (std::size_t k = 0; k < series.size(); ++k) {
          const double mean = series.mean_over(series.blocks[k], [&of_all](std::size_t row) { return of_all[row]; });
          CHECK(std::abs(series.mean_of_simulated(k, of_merged) - mean) < 0.02 * series.floor);
        }
      }
    }
    CHECK(fewer > 0);
  }
}
