#include "diagnosis/checks/sample_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "diagnosis/checks/interpolated.h"
#include "diagnosis/checks/plausibility.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/sample_selection.h"
#include "measurements/spikes.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

/// A force that never settles cannot be compared.
void check_force(const MeasurementSet& set, SetChecks& checks) {
  const Quantity& force = set.kind->traits.force;
  std::vector<std::size_t> without;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    if (set.runs[r].force_at_standstill) continue;  // its zero is
    const bool measured = set.runs[r].has_samples(force);
    if (measured && find_compared_rows(set, set.runs[r], force).empty()) without.push_back(r);
  }
  if (without.empty()) return;
  checks.warnings.push_back(fmt::format(
      "no {} of {} is compared: all of it is slower than {:.0f} km/h or within {:.0f} s of a change of load or "
      "acceleration",
      kind_of(set).force_channel(set).word, name_runs(set, without), measurements::kTrustedSpeed_m_s * 3.6,
      measurements::kSettling_s));
}

/// Between two rows inputs run straight, so that a step of speed or load may be off by half their distance: a clock
/// that is off by as little cannot be told from that.
void check_spacing(const MeasurementSet& set, SetChecks& checks) {
  constexpr double kWide_s = 1.9;  // Assumed: formats.md's examples have rows a second apart
  double widest_s = 0.0;
  for (const MeasuredRun& run : set.runs) widest_s = std::max(widest_s, measurements::calc_mean_interval_s(run));
  if (widest_s < kWide_s) return;
  checks.warnings.push_back(
      fmt::format("rows are up to {:.2g} s apart, and inputs are taken as straight between them: a clock_shift of up "
                  "to {:.2g} s may be of that",
                  widest_s, 0.5 * widest_s));
}

/// Rows of the number that a logger writes where it has no sample: that of a spike which no other sample of steady rows
/// comes near to, wherever it stands.
void add_placeholders(const std::vector<double>& values, const std::vector<bool>& is_steady,
                      std::vector<std::size_t>& spikes) {
  const std::set<std::size_t> alone(spikes.begin(), spikes.end());
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::isnan(values[row]) || !is_steady[row] || alone.count(row) > 0) continue;
    low = std::min(low, values[row]);
    high = std::max(high, values[row]);
  }
  std::set<double> placeholders;
  for (const std::size_t row : spikes) {
    if (values[row] < low || values[row] > high) placeholders.insert(values[row]);
  }
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::isnan(values[row]) || alone.count(row) > 0) continue;
    if (placeholders.count(values[row]) > 0) spikes.push_back(row);
  }
  std::sort(spikes.begin(), spikes.end());
}

/// Samples that stand alone are left out: spikes, and what a logger writes where it has no sample.
void check_spikes(const MeasurementSet& set, SetChecks& checks) {
  constexpr double kFar = 20.0;  // Assumed: standard deviations; what noise and physics never do
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    const MeasuredRun& run = set.runs[r];
    const std::vector<bool> steady = measurements::find_steady_rows(run.columns, run.time_s.size());
    const std::vector<bool> all(run.time_s.size(), true);
    for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
      const auto sensor = set.sensors.find(channel);
      if (!run.has(channel) || sensor == set.sensors.end()) continue;
      const std::vector<double>& values = run.column(channel);
      const std::vector<bool>& judged = measurements::carries_inertia(channel) ? steady : all;
      std::vector<std::size_t> rows =
          measurements::find_spikes(values, kFar, std::max(sensor->second.noise_sd, sensor->second.resolution), judged);
      if (rows.empty()) continue;
      add_placeholders(values, judged, rows);
      for (const std::size_t row : rows) checks.left_out.push_back({r, channel, row, row});
      checks.warnings.push_back(fmt::format(
          "{} of run {}: {} alone, far from those beside {} (the first in row {}: {:.6g}): spikes, or what a logger "
          "writes for no sample; left out",
          channel.header(), run.id, rows.size() == 1 ? "a sample stands" : fmt::format("{} samples stand", rows.size()),
          rows.size() == 1 ? "it" : "them", rows.front() + 1, channel.file_unit().from_si(values[rows.front()])));
    }
  }
}

/// A run of next to no samples shows no gap, whatever acts.
void check_amount(const MeasurementSet& set, SetChecks& checks) {
  const std::vector<Quantity> channels = measurements::measured_channels(*set.kind);
  std::vector<std::size_t> few;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    std::size_t most = 0;
    for (const Quantity& channel : channels) {
      most = std::max(most, find_compared_rows(set, set.runs[r], channel).size());
    }
    if (most > 0 && most < kFewSamples) few.push_back(r);
  }
  if (few.empty()) return;
  checks.warnings.push_back(
      fmt::format("hardly any data in {}: no channel has {} samples that are compared. That no gap "
                  "is seen there says next to nothing",
                  name_runs(set, few), kFewSamples));
}

/// Whether two columns hold the same numbers, which are not all one number.
bool are_same(const std::vector<double>& a, const std::vector<double>& b) {
  std::set<double> numbers;
  if (a.size() != b.size()) return false;
  for (std::size_t row = 0; row < a.size(); ++row) {
    if (std::isnan(a[row]) != std::isnan(b[row])) return false;
    if (std::isnan(a[row])) continue;
    if (a[row] != b[row]) return false;
    numbers.insert(a[row]);
  }
  return numbers.size() > 1;
}

void check_runs(const MeasurementSet& set, SetChecks& checks) {
  if (set.runs.size() == 1) {
    checks.warnings.emplace_back(
        "there is one run only: how far the gap shrinks on a run that the fit did not see cannot be judged");
  }
  for (std::size_t a = 0; a < set.runs.size(); ++a) {
    for (std::size_t b = a + 1; b < set.runs.size(); ++b) {
      const auto same_samples = [&](const Quantity& channel) {
        return set.runs[a].has(channel) && set.runs[b].has(channel) &&
               are_same(set.runs[a].column(channel), set.runs[b].column(channel));
      };
      const std::vector<Quantity> channels = measurements::measured_channels(*set.kind);
      if (std::none_of(channels.begin(), channels.end(), same_samples)) continue;
      checks.warnings.push_back(
          fmt::format("{} hold the same samples: they are no test of each other", name_runs(set, {a, b})));
    }
  }
}

}  // namespace

void check_samples(const MeasurementSet& set, SetChecks& checks) {
  for (std::string& missing : find_missing_samples(set)) checks.warnings.push_back(std::move(missing));
  check_force(set, checks);
  check_amount(set, checks);
  check_runs(set, checks);
  check_spacing(set, checks);
  check_spikes(set, checks);
  const Interpolated interpolated = find_interpolated(set);
  checks.left_out.insert(checks.left_out.end(), interpolated.rows.begin(), interpolated.rows.end());
  checks.warnings.insert(checks.warnings.end(), interpolated.warnings.begin(), interpolated.warnings.end());
}

std::vector<std::string> find_missing_samples(const MeasurementSet& set) {
  const std::vector<Quantity> channels = measurements::measured_channels(*set.kind);
  std::vector<std::string> sentences;
  std::vector<std::size_t> empty;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    const auto is_measured = [&](const Quantity& channel) { return set.runs[r].has_samples(channel); };
    if (std::none_of(channels.begin(), channels.end(), is_measured)) empty.push_back(r);
  }
  if (empty.size() == set.runs.size()) {
    throw InputError({"nothing was measured: no run has a sample of any measured channel", set.path, 0, "[[run]]", "",
                      fmt::format("samples of one of {}", fmt::join(list_headers(channels), ", ")), ""});
  }
  if (!empty.empty()) {
    sentences.push_back(fmt::format("{} measured nothing, and tells nothing: no sample of {}", name_runs(set, empty),
                                    fmt::join(list_headers(channels), ", ")));
  }
  for (const Quantity& channel : channels) {
    std::vector<std::size_t> without;
    bool anywhere = false;
    for (std::size_t r = 0; r < set.runs.size(); ++r) {
      if (set.runs[r].has_samples(channel)) {
        anywhere = true;
      } else if (set.runs[r].has(channel) && std::find(empty.begin(), empty.end(), r) == empty.end()) {
        without.push_back(r);
      }
    }
    if (!without.empty()) {
      sentences.push_back(fmt::format("{} has no sample in {}", channel.header(), name_runs(set, without)));
    }
    const models::TireChannel* of_tire = models::find_tire_channel(channel);
    const bool is_expected = of_tire != nullptr ? of_tire->is_expected : channel == set.kind->traits.force;
    if (!anywhere && without.empty() && is_expected) {
      sentences.push_back(
          fmt::format("{} was not measured: effects that show in it alone cannot be seen", channel.header()));
    }
  }
  return sentences;
}

}  // namespace rollrig::diagnosis
