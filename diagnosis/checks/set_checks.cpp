#include "diagnosis/checks/set_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "diagnosis/checks/plausibility.h"
#include "diagnosis/checks/repairs.h"
#include "diagnosis/checks/tire_checks.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/sample_selection.h"
#include "measurements/spikes.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr double kOdd = 0.3;      // tolerances of plausibility.h from which a mistake is looked for
constexpr double kOutside = 2.0;  // from which none is needed to doubt the set; effects of unlikely size stay below

std::string join(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

void require_noise(const MeasurementSet& set) {
  for (const auto& [channel, sensor] : set.sensors) {
    if (sensor.noise_sd > 0.0 || sensor.drift_sd > 0.0 || sensor.resolution > 0.0) continue;
    throw InputError({"a sensor has no noise at all, so that nothing would be within it", set.path, 0,
                      fmt::format("[sensors.{}]", channel), "0", "noise_sd, drift_sd or resolution above 0", ""});
  }
}

/// Warns of numbers that the files do not give.
void check_assumed(const MeasurementSet& set, SetChecks& checks) {
  if (!set.assumed_sensors.empty()) {
    checks.warnings.push_back(fmt::format("the set describes no sensor of {}: the noise of a usual one is assumed",
                                          join(set.assumed_sensors)));
  }
  if (!set.tire.has_thermal || !set.tire.has_rolling_resistance) {
    checks.warnings.push_back(fmt::format(
        "tire {} has no [rolling_resistance] or no [thermal]: effects that need them take values of its class",
        set.tire.name));
  }
}

/// A force that never settles cannot be compared.
void check_force(const MeasurementSet& set, SetChecks& checks) {
  const ForceChannel force = kind_of(set).force_channel(set);
  std::vector<std::size_t> without;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    if (set.runs[r].force_at_standstill) continue;  // its zero is
    const bool measured = set.runs[r].has_samples(force.name);
    if (measured && find_compared_rows(set, set.runs[r], force.name).empty()) without.push_back(r);
  }
  if (without.empty()) return;
  checks.warnings.push_back(fmt::format(
      "no {} of {} is compared: all of it is slower than {:.0f} km/h or within {:.0f} s of a change of load or "
      "acceleration",
      force.word, name_runs(set, without), measurements::kTrustedSpeed_m_s * 3.6, measurements::kSettling_s));
}

/// Between two rows inputs run straight, so that a step of speed or load may be off by half their distance: a clock
/// that is off by as little cannot be told from that.
void check_spacing(const MeasurementSet& set, SetChecks& checks) {
  constexpr double kWide_s = 1.9;  // Assumed: formats.md's examples have rows a second apart
  double widest_s = 0.0;
  for (const MeasuredRun& run : set.runs) {
    const double mean_s = (run.time_s.back() - run.time_s.front()) / static_cast<double>(run.time_s.size() - 1);
    widest_s = std::max(widest_s, mean_s);
  }
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
    for (const std::string& channel : measurements::measured_channels(set.kind)) {
      const auto sensor = set.sensors.find(channel);
      if (!run.has(channel) || sensor == set.sensors.end()) continue;
      const std::vector<double>& values = run.columns.at(channel);
      const std::vector<bool>& judged = measurements::carries_inertia(channel) ? steady : all;
      std::vector<std::size_t> rows =
          measurements::find_spikes(values, kFar, std::max(sensor->second.noise_sd, sensor->second.resolution), judged);
      if (rows.empty()) continue;
      add_placeholders(values, judged, rows);
      for (const std::size_t row : rows) checks.left_out.push_back({r, channel, row, row});
      checks.warnings.push_back(fmt::format(
          "{} of run {}: {} alone, far from those beside {} (the first in row {}: {:.6g}): spikes, or what a logger "
          "writes for no sample; left out",
          channel, run.id, rows.size() == 1 ? "a sample stands" : fmt::format("{} samples stand", rows.size()),
          rows.size() == 1 ? "it" : "them", rows.front() + 1, unit_of_key(channel).from_si(values[rows.front()])));
    }
  }
}

/// A run of next to no samples shows no gap, whatever acts.
void check_amount(const MeasurementSet& set, SetChecks& checks) {
  const std::vector<std::string> channels = measurements::measured_channels(set.kind);
  std::vector<std::size_t> few;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    std::size_t most = 0;
    for (const std::string& channel : channels) {
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
      const auto same_samples = [&](const std::string& channel) {
        return set.runs[a].has(channel) && set.runs[b].has(channel) &&
               are_same(set.runs[a].columns.at(channel), set.runs[b].columns.at(channel));
      };
      const std::vector<std::string> channels = measurements::measured_channels(set.kind);
      if (std::none_of(channels.begin(), channels.end(), same_samples)) continue;
      checks.warnings.push_back(
          fmt::format("{} hold the same samples: they are no test of each other", name_runs(set, {a, b})));
    }
  }
}

/// Channels that lie outside all that an effect can make, and their levels.
std::string describe_misfit(const MeasurementSet& set, const std::vector<std::size_t>& runs,
                            const std::vector<RunMisfit>& misfits) {
  std::vector<std::string> parts;
  for (const std::string& channel : measurements::measured_channels(set.kind)) {
    std::vector<std::size_t> outside;
    double ratio = 1.0;
    for (const std::size_t r : runs) {
      for (const ChannelMisfit& at : misfits[r].channels) {
        if (at.channel != channel || at.rms <= kOutside) continue;
        ratio = outside.empty() ? at.ratio : ratio;
        outside.push_back(r);
      }
    }
    if (outside.empty()) continue;
    parts.push_back(
        fmt::format("{} of {} ({:.2g} of the simulated, on average)", channel, name_runs(set, outside), ratio));
  }
  return join(parts);
}

/// Throws for the first run that cannot be simulated, with the mistake that would explain it.
void require_simulated(const MeasurementSet& set, const std::vector<RunMisfit>& misfits,
                       const std::optional<Repair>& repair) {
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    if (misfits[r].failure.empty()) continue;
    throw InputError({fmt::format("run '{}' cannot be simulated: {}", set.runs[r].id, misfits[r].failure),
                      set.runs[r].file, 0, "", "",
                      repair.has_value() ? "it looks as if " + repair->text : "inputs that such a test can have", ""});
  }
}

void report_repair(const MeasurementSet& set, const Repair& repair, SetChecks& checks) {
  checks.suspicion = fmt::format("in {} it looks as if {}", name_runs(set, repair.runs), repair.text);
  checks.doubt = checks.suspicion + ": no cause is named until that is mended";
  checks.warnings.push_back(checks.doubt);
}

/// Whether no sensor of these runs stands still once the mistake is undone.
bool moves_without(const Repair& repair, MeasurementSet set, const std::vector<std::size_t>& runs, int threads) {
  for (const std::size_t r : runs) repair.undo(set.runs[r]);
  const Stuck left = find_stuck(set, replay_all(set, threads));
  return std::none_of(left.rows.begin(), left.rows.end(), [&runs](const DoubtfulRows& rows) {
    return std::find(runs.begin(), runs.end(), rows.run) != runs.end();
  });
}

/// A column that stands still where it should not: another's under its heading, or a stuck sensor.
void check_stuck(const MeasurementSet& set, const Replays& replays, int threads, SetChecks& checks) {
  const Stuck stuck = find_stuck(set, replays);
  if (stuck.rows.empty()) return;
  std::vector<std::size_t> runs;
  for (const DoubtfulRows& rows : stuck.rows) {
    if (runs.empty() || runs.back() != rows.run) runs.push_back(rows.run);
  }
  const std::optional<Repair> repair = find_repair(set, runs, Mistakes::kExchanges, threads);
  if (repair.has_value() && moves_without(*repair, set, runs, threads)) {
    report_repair(set, *repair, checks);
    return;
  }
  checks.left_out.insert(checks.left_out.end(), stuck.rows.begin(), stuck.rows.end());
  checks.warnings.insert(checks.warnings.end(), stuck.warnings.begin(), stuck.warnings.end());
}

/// Where all sensors stand still nothing is left to diagnose.
void require_rest(const MeasurementSet& kept, const SetChecks& checks) {
  const std::vector<std::string> channels = measurements::measured_channels(kept.kind);
  for (const MeasuredRun& run : kept.runs) {
    const auto is_left = [&](const std::string& channel) { return !find_compared_rows(kept, run, channel).empty(); };
    if (checks.left_out.empty() || std::any_of(channels.begin(), channels.end(), is_left)) return;
  }
  const DoubtfulRows& first = checks.left_out.front();
  throw InputError({"every measured channel stands still where it should move: stuck sensors, or no measurement at all",
                    kept.runs[first.run].file, 0, first.channel, "", "samples of a sensor that works", ""});
}

/// Whether a run's loss is next to nothing of the simulated, as in a unit a thousand times as large. Of a vehicle on
/// the road the force need not be a loss.
bool lacks_loss(const MeasurementSet& set, const RunMisfit& misfit) {
  constexpr double kLeast = 0.15;  // Assumed: no effect takes so much of a loss
  if (set.kind == measurements::SetKind::kRoad) return false;
  const std::string force = kind_of(set).force_channel(set).name;
  return std::any_of(misfit.channels.begin(), misfit.channels.end(),
                     [&force](const ChannelMisfit& at) { return at.channel == force && at.ratio < kLeast; });
}

/// Columns and units.
void check_plausibility(const MeasurementSet& kept, const Replays& replays, int threads, SetChecks& checks) {
  const std::vector<RunMisfit>& misfits = replays.misfits;
  std::vector<std::size_t> odd;
  for (std::size_t r = 0; r < kept.runs.size(); ++r) {
    if (misfits[r].worst() > kOdd || lacks_loss(kept, misfits[r])) odd.push_back(r);
  }
  if (odd.empty()) return;
  const std::optional<Repair> repair = find_repair(kept, odd, Mistakes::kAll, threads);
  require_simulated(kept, misfits, repair);
  if (repair.has_value()) {
    report_repair(kept, *repair, checks);
    return;
  }
  const std::string outside = describe_misfit(kept, odd, misfits);
  if (outside.empty()) return;
  checks.suspicion = fmt::format(
      "further from the simulation than any effect of the catalog: {}. Check tire, rig, columns and units", outside);
  checks.doubt = checks.suspicion + "; no cause is named";
  checks.warnings.push_back(checks.doubt);
}

}  // namespace

SetChecks check_set(const MeasurementSet& set, int threads) {
  kind_of(set).make_context(set);  // throws where the files lack what the kind needs
  require_noise(set);
  SetChecks checks;
  check_assumed(set, checks);
  for (std::string& missing : find_missing_samples(set)) checks.warnings.push_back(std::move(missing));
  check_force(set, checks);
  check_amount(set, checks);
  check_runs(set, checks);
  check_spacing(set, checks);
  check_spikes(set, checks);
  Replays replays = replay_all(set, threads);
  check_stuck(set, replays, threads, checks);
  if (checks.is_implausible()) return checks;
  const MeasurementSet kept = leave_out(set, checks.left_out);
  for (std::size_t r = 0; r < kept.runs.size(); ++r) {
    const bool simulated = replays.misfits[r].failure.empty();
    if (simulated) replays.misfits[r] = calc_misfit(kept, kept.runs[r], replays.recordings[r]);
  }
  require_rest(kept, checks);
  check_plausibility(kept, replays, threads, checks);
  if (checks.is_implausible()) return checks;
  const std::vector<std::string> of_tire = check_tire(kept, replays, threads);
  checks.warnings.insert(checks.warnings.end(), of_tire.begin(), of_tire.end());
  return checks;
}

std::vector<std::string> find_missing_samples(const MeasurementSet& set) {
  const std::vector<std::string> channels = measurements::measured_channels(set.kind);
  std::vector<std::string> sentences;
  std::vector<std::size_t> empty;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    const auto is_measured = [&](const std::string& channel) { return set.runs[r].has_samples(channel); };
    if (std::none_of(channels.begin(), channels.end(), is_measured)) empty.push_back(r);
  }
  if (empty.size() == set.runs.size()) {
    throw InputError({"nothing was measured: no run has a sample of any measured channel", set.path, 0, "[[run]]", "",
                      "samples of one of " + join(channels), ""});
  }
  if (!empty.empty()) {
    sentences.push_back(fmt::format("{} measured nothing, and tells nothing: no sample of {}", name_runs(set, empty),
                                    fmt::join(channels, ", ")));
  }
  for (const std::string& channel : channels) {
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
      sentences.push_back(fmt::format("{} has no sample in {}", channel, name_runs(set, without)));
    }
    if (!anywhere && without.empty() && channel != "gas_temperature_degC") {
      sentences.push_back(fmt::format("{} was not measured: effects that show in it alone cannot be seen", channel));
    }
  }
  return sentences;
}

MeasurementSet leave_out(MeasurementSet set, const std::vector<DoubtfulRows>& rows) {
  for (const DoubtfulRows& at : rows) {
    std::vector<double>& values = set.runs[at.run].columns.at(at.channel);
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(at.first_row),
              values.begin() + static_cast<std::ptrdiff_t>(at.last_row) + 1, std::nan(""));
  }
  return set;
}

}  // namespace rollrig::diagnosis
