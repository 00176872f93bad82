#include "diagnosis/checks/stuck_sensors.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr std::size_t kStuckSamples = 30;
constexpr double kStuck_s = 60.0;
constexpr double kStuckNoises = 6.0;

void find_stuck_rows(const MeasurementSet& set, std::size_t r, const Quantity& channel,
                     const std::vector<double>& expected, Stuck& stuck) {
  const MeasuredRun& run = set.runs[r];
  const std::vector<std::size_t> rows = find_compared_rows(set, run, channel);
  if (rows.empty()) return;
  const std::vector<double>& measured = run.column(channel);
  const models::SensorParameters& sensor = set.sensors.at(channel);
  const Unit unit = channel.file_unit();
  for (std::size_t first = 0, last = 0; first < rows.size(); first = last + 1) {
    double lowest = expected[rows[first]];
    double highest = lowest;
    for (last = first; last + 1 < rows.size() && measured[rows[last + 1]] == measured[rows[first]];) {
      ++last;
      lowest = std::min(lowest, expected[rows[last]]);
      highest = std::max(highest, expected[rows[last]]);
    }
    const double from_s = run.time_s[rows[first]];
    const double to_s = run.time_s[rows[last]];
    const bool moves = highest - lowest > kStuckNoises * (sensor.noise_sd + sensor.resolution);
    if (last - first + 1 < kStuckSamples || to_s - from_s < kStuck_s || !moves) continue;
    stuck.rows.push_back({r, channel, rows[first], rows[last]});
    stuck.warnings.push_back(
        fmt::format("{} of run {} stands at {:.6g} {} from {:.0f} to {:.0f} s, where it should move by {:.2g}: a stuck "
                    "sensor? Those samples are left out",
                    channel.header(), run.id, unit.from_si(measured[rows[first]]), unit.symbol, from_s, to_s,
                    (highest - lowest) / unit.factor));
  }
}

}  // namespace

Stuck find_stuck(const MeasurementSet& set, const BaselineRuns& baseline) {
  Stuck stuck;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    if (!baseline.misfits[r].failure.empty()) continue;
    for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
      if (set.runs[r].has(channel)) {
        find_stuck_rows(set, r, channel, baseline.recordings[r].channel(channel), stuck);
      }
    }
  }
  return stuck;
}

}  // namespace rollrig::diagnosis
