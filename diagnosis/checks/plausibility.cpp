#include "diagnosis/checks/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnosis/kinds/measurement_kind.h"
#include "models/corner.h"
#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr double kUncompared = 1.05;  // just outside

/// The tolerance of a channel as a function of row and simulated value. Column and kind are looked up once, not for
/// each row.
std::function<double(std::size_t row, double simulated)> make_tolerance_law(const MeasurementSet& set,
                                                                            const MeasuredRun& run,
                                                                            const Quantity& channel) {
  if (channel == set.kind->traits.force) {
    return [&set, &kind = kind_of(set)](std::size_t, double simulated) {
      return kind.calc_force_tolerance(set, simulated);
    };
  }
  if (const std::optional<ReferenceTolerance> reference = find_reference_tolerance(channel)) {
    return [tolerance = *reference](std::size_t, double simulated) {
      return tolerance.fixed_SI + tolerance.share * std::abs(simulated);
    };
  }
  const models::ChannelFamily& family = models::get_tire_channel(channel).family;
  const bool is_pressure = family.rest == models::ChannelFamily::Rest::kColdPressure;
  const std::vector<double>* ambient_K = is_pressure ? nullptr : &run.column(models::quantities::kAmbient);
  return [&family, &run, ambient_K](std::size_t row, double simulated) {
    const double rest = ambient_K == nullptr ? run.cold_pressure_Pa : (*ambient_K)[row];
    return family.tolerance_SI + family.share_of_rise * std::abs(simulated - rest);
  };
}

/// Standard deviation of one sample from the noise and drift of its sensor.
double calc_noise(const MeasurementSet& set, const Quantity& channel) {
  const auto sensor = set.sensors.find(channel);
  return sensor == set.sensors.end() ? 0.0 : std::hypot(sensor->second.noise_sd, sensor->second.drift_sd);
}

ChannelMisfit calc_channel_misfit(const MeasurementSet& set, const MeasuredRun& run, const Quantity& channel,
                                  const std::vector<double>& simulated, const std::vector<std::size_t>& rows) {
  const std::vector<double>& measured = run.column(channel);
  const Unit unit = channel.file_unit();
  ChannelMisfit misfit{channel, rows.size()};
  const double noise = calc_noise(set, channel);
  const auto calc_tolerance = make_tolerance_law(set, run, channel);
  double squares = 0.0;
  double noise_squares = 0.0;
  double measured_sum = 0.0;
  double simulated_sum = 0.0;
  for (const std::size_t row : rows) {
    const double tolerance = calc_tolerance(row, simulated[row]);
    const double off = std::abs(measured[row] - simulated[row]) / tolerance;
    noise_squares += noise * noise / (tolerance * tolerance);
    const double held = std::isfinite(off) ? std::min(off, kLargestMisfit) : kLargestMisfit;
    squares += held * held;
    measured_sum += unit.from_si(measured[row]);
    simulated_sum += unit.from_si(simulated[row]);
  }
  if (rows.empty()) {
    misfit.rms = run.has_samples(channel) ? kUncompared : 0.0;
    return misfit;
  }
  misfit.rms = std::sqrt(std::max(0.0, squares - noise_squares) / static_cast<double>(rows.size()));
  misfit.ratio = measured_sum / simulated_sum;
  return misfit;
}

/// Simulates a run again. Returns its misfit, or the reason why it cannot be simulated; fills `recording` where it can.
RunMisfit try_baseline(const MeasurementSet& set, const MeasuredRun& run, sim::Recording<double>& recording) {
  try {
    recording = resimulate_baseline(set, run);
    return calc_misfit(set, run, recording);
  } catch (const RunFailure& failure) {
    return {{}, failure.what()};
  }
}

}  // namespace

std::optional<ReferenceTolerance> find_reference_tolerance(const Quantity& channel) {
  if (channel == models::quantities::kContactLoad) return ReferenceTolerance{500.0, 0.1};
  if (channel == models::quantities::kSpeedReading) return ReferenceTolerance{0.5, 0.15};
  return std::nullopt;
}

sim::Recording<double> resimulate_baseline(const MeasurementSet& set, const MeasuredRun& run) {
  models::Corner<double> corner(measurements::make_context(set), {});
  sim::Recording<double> recording = measurements::Resimulation(run, *set.kind).simulate(set, run, corner);
  for (std::size_t c = 0; c < recording.channels.size(); ++c) {
    const std::vector<double>& values = recording.values[c];
    if (std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) continue;
    throw RunFailure(recording.channels[c].quantity.header() + " does not stay finite");
  }
  return recording;
}

std::vector<std::size_t> find_compared_rows(const MeasurementSet& set, const MeasuredRun& run,
                                            const Quantity& channel) {
  if (!run.has(channel)) return {};
  return kind_of(set).find_compared_rows(run, channel);
}

double RunMisfit::worst() const {
  if (!failure.empty()) return kLargestMisfit;
  double worst = 0.0;
  for (const ChannelMisfit& channel : channels) worst = std::max(worst, channel.rms);
  return worst;
}

double RunMisfit::sum_of_squares() const {
  constexpr double kChannels =
      4.0;  // Assumed: a run that cannot be simulated counts as so many with the largest misfit
  if (!failure.empty()) return kLargestMisfit * kLargestMisfit * kChannels;
  double sum = 0.0;
  for (const ChannelMisfit& channel : channels) sum += channel.rms * channel.rms;
  return sum;
}

RunMisfit calc_misfit(const MeasurementSet& set, const MeasuredRun& run, const sim::Recording<double>& simulated) {
  RunMisfit misfit;
  for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
    if (!run.has(channel)) continue;
    misfit.channels.push_back(
        calc_channel_misfit(set, run, channel, simulated.channel(channel), find_compared_rows(set, run, channel)));
  }
  return misfit;
}

RunMisfit calc_misfit(const MeasurementSet& set, const MeasuredRun& run, const sim::Recording<double>& simulated,
                      const QuantityMap<std::vector<std::size_t>>& rows) {
  RunMisfit misfit;
  for (const auto& [channel, all] : rows) {
    if (!run.has(channel)) continue;
    const std::vector<double>& measured = run.column(channel);
    std::vector<std::size_t> there;
    for (const std::size_t row : all) {
      if (!std::isnan(measured[row])) there.push_back(row);
    }
    misfit.channels.push_back(calc_channel_misfit(set, run, channel, simulated.channel(channel), there));
  }
  return misfit;
}

RunMisfit calc_misfit(const MeasurementSet& set, const MeasuredRun& run) {
  sim::Recording<double> recording;
  return try_baseline(set, run, recording);
}

BaselineRuns resimulate_baseline(const MeasurementSet& set, int threads) {
  BaselineRuns baseline{std::vector<sim::Recording<double>>(set.runs.size()), std::vector<RunMisfit>(set.runs.size())};
  parallel_for(set.runs.size(), threads,
               [&](std::size_t r) { baseline.misfits[r] = try_baseline(set, set.runs[r], baseline.recordings[r]); });
  return baseline;
}

std::string name_runs(const MeasurementSet& set, const std::vector<std::size_t>& runs) {
  if (runs.size() > 1 && runs.size() == set.runs.size()) return "all runs";
  std::vector<std::string> ids;
  for (const std::size_t r : runs) ids.push_back(set.runs[r].id);
  std::sort(ids.begin(), ids.end());
  return (ids.size() == 1 ? "run " : "runs ") + fmt::format("{}", fmt::join(ids, ", "));
}

}  // namespace rollrig::diagnosis
