#include "comparison/compare_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "comparison/input_differences.h"
#include "comparison/match_runs.h"
#include "comparison/mean_difference.h"
#include "comparison/overlay.h"
#include "comparison/tire_document.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "sim/core/error.h"
#include "sim/core/json.h"

namespace rollrig::comparison {
namespace {

using diagnosis::RunPhase;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

/// Runs of all sets that belong together; the first is that of the reference.
struct RunGroup {
  std::vector<std::optional<std::size_t>> runs;

  bool is_complete() const {
    return std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.has_value(); });
  }
};

/// Samples of a channel in a phase, by the time since its beginning; without gaps.
struct PhaseSamples {
  std::vector<double> time_s;
  std::vector<double> values;  // in the unit of the channel's heading

  /// Between two samples on a straight line; none before the first and after the last.
  std::optional<double> find(double at_s) const {
    constexpr double kSlack_s = 1e-6;
    const auto next = std::lower_bound(time_s.begin(), time_s.end(), at_s - kSlack_s);
    if (next == time_s.end()) return std::nullopt;
    const auto i = static_cast<std::size_t>(next - time_s.begin());
    if (*next <= at_s + kSlack_s) return values[i];
    if (i == 0) return std::nullopt;
    const double share = (at_s - time_s[i - 1]) / (time_s[i] - time_s[i - 1]);
    return values[i - 1] + share * (values[i] - values[i - 1]);
  }
};

PhaseSamples find_samples(const MeasuredRun& run, const RunPhase& phase, const Quantity& channel) {
  PhaseSamples samples;
  if (!run.has(channel)) return samples;
  const Unit unit = channel.file_unit();
  const std::vector<double>& column = run.column(channel);
  for (std::size_t row = phase.first; row < phase.last; ++row) {
    if (!std::isfinite(column[row])) continue;
    samples.time_s.push_back(run.time_s[row] - run.time_s[phase.first]);
    samples.values.push_back(unit.from_si(column[row]));
  }
  return samples;
}

/// Means of two runs over the times that both have.
struct PairedMeans {
  double reference = 0.0;
  double other = 0.0;
  UncertainMean difference;
};

std::optional<PairedMeans> calc_paired_means(const PhaseSamples& reference, const PhaseSamples& other,
                                             const std::function<double(std::size_t, double)>& calc_sensors_sd) {
  std::vector<double> differences;
  PairedMeans means;
  double last_s = 0.0;
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    const std::optional<double> beside = other.find(reference.time_s[i]);
    if (!beside.has_value()) continue;
    means.reference += reference.values[i];
    means.other += *beside;
    differences.push_back(*beside - reference.values[i]);
    last_s = reference.time_s[i];
  }
  if (differences.size() < 2) return std::nullopt;
  const auto count = static_cast<double>(differences.size());
  means.reference /= count;
  means.other /= count;
  const bool is_one = std::all_of(differences.begin(), differences.end(), [](double one) { return one == 0.0; });
  const double interval_s = (last_s - reference.time_s.front()) / (count - 1.0);
  means.difference = calc_mean(differences, is_one ? 0.0 : calc_sensors_sd(differences.size(), interval_s));
  return means;
}

/// Standard uncertainty of the mean of a channel's sensor, in the unit of its heading.
double calc_channel_sd(const MeasurementSet& set, const Quantity& channel, std::size_t count, double interval_s) {
  const auto sensor = set.sensors.find(channel);
  if (sensor == set.sensors.end()) return 0.0;
  return calc_sensor_mean_sd(sensor->second, count, interval_s) / channel.file_unit().factor;
}

const RunPhase* find_phase(const std::vector<RunPhase>& phases, const std::string& name) {
  const auto found =
      std::find_if(phases.begin(), phases.end(), [&name](const RunPhase& phase) { return phase.name == name; });
  return found != phases.end() ? &*found : nullptr;
}

/// One group of runs with the phases of each.
class GroupComparison {
 public:
  GroupComparison(const std::vector<MeasurementSet>& sets, const RunGroup& group) : sets_(sets), group_(group) {
    for (std::size_t i = 0; i < sets.size(); ++i) {
      phases_.push_back(has(i) ? diagnosis::kind_of(sets[i]).find_phases(sets[i], run(i)) : std::vector<RunPhase>());
    }
  }

  bool has(std::size_t set) const { return group_.runs[set].has_value(); }
  const MeasuredRun& run(std::size_t set) const { return sets_[set].runs[*group_.runs[set]]; }
  const std::vector<RunPhase>& phases(std::size_t set) const { return phases_[set]; }

  /// A value for each channel and phase of the reference that another run has as well.
  void add_values(Comparison& comparison) const {
    for (const RunPhase& phase : phases_.front()) {
      for (const Quantity& channel : measurements::measured_channels(*sets_.front().kind)) {
        const std::optional<ComparedValue> value = make_value(phase, channel);
        if (value.has_value()) comparison.values.push_back(*value);
      }
    }
  }

  OverlaidRun lay(std::size_t set) const {
    const MeasuredRun& own = run(set);
    OverlaidRun overlaid{own.time_s, std::vector<std::size_t>(own.time_s.size()), {}, {}};
    for (std::size_t p = 0; p < phases_[set].size(); ++p) {
      const RunPhase& phase = phases_[set][p];
      const std::size_t end = std::min(phase.last, own.time_s.size() - 1);
      overlaid.phases.push_back({phase.name, own.time_s[phase.first], own.time_s[end]});
      std::fill(overlaid.phase.begin() + static_cast<std::ptrdiff_t>(phase.first),
                overlaid.phase.begin() + static_cast<std::ptrdiff_t>(phase.last), p);
    }
    for (const auto& [channel, values] : own.columns) {
      const Unit unit = channel.file_unit();
      std::vector<double> shown;
      for (const double value : values) shown.push_back(unit.from_si(value));
      if (own.has_samples(channel)) overlaid.channels.emplace_back(channel.header(), std::move(shown));
    }
    return overlaid;
  }

 private:
  std::optional<ComparedValue> make_value(const RunPhase& phase, const Quantity& channel) const {
    const PhaseSamples reference = find_samples(run(0), phase, channel);
    ComparedValue value;
    value.name = channel.header();
    value.place = fmt::format("{}, {}", run(0).id, phase.name);
    value.label = fmt::format("mean {}", plain_name(channel.header()));
    value.unit = channel.file_unit().symbol;
    value.doc = "mean over the times of the phase that both runs have";
    value.values.resize(sets_.size());
    value.differences.resize(sets_.size() - 1);
    bool has_any = false;
    for (std::size_t i = 1; i < sets_.size(); ++i) {
      const RunPhase* beside = find_phase(phases_[i], phase.name);
      if (beside == nullptr) continue;
      const auto calc_sd = [&](std::size_t count, double interval_s) {
        return std::hypot(calc_channel_sd(sets_.front(), channel, count, interval_s),
                          calc_channel_sd(sets_[i], channel, count, interval_s));
      };
      const std::optional<PairedMeans> means =
          calc_paired_means(reference, find_samples(run(i), *beside, channel), calc_sd);
      if (!means.has_value()) continue;
      has_any = true;
      if (!value.values.front().has_value()) value.values.front() = means->reference;
      value.values[i] = means->other;
      Difference& difference = value.differences[i - 1];
      difference = subtract(means->other, means->reference, value.unit);
      difference.value = means->difference.mean;
      if (means->difference.sd.has_value()) {
        add_interval(*means->difference.sd, means->difference.coverage_factor, difference);
      } else {
        add_reason("too few samples", difference);
      }
    }
    return has_any ? std::optional(value) : std::nullopt;
  }

  const std::vector<MeasurementSet>& sets_;
  const RunGroup& group_;
  std::vector<std::vector<RunPhase>> phases_;
};

std::vector<RunGroup> group_runs(const std::vector<MeasurementSet>& sets, const std::vector<std::string>& names,
                                 std::vector<std::string>& warnings) {
  std::vector<RunGroup> groups(sets.front().runs.size());
  for (std::size_t run = 0; run < groups.size(); ++run) groups[run].runs.emplace_back(run);
  for (std::size_t i = 1; i < sets.size(); ++i) {
    const std::vector<std::optional<std::size_t>> matches = match_runs(sets.front().runs, sets[i].runs);
    std::vector<bool> is_taken(sets[i].runs.size(), false);
    for (std::size_t run = 0; run < groups.size(); ++run) {
      groups[run].runs.push_back(matches[run]);
      if (matches[run].has_value()) is_taken[*matches[run]] = true;
      if (!matches[run].has_value()) {
        warnings.push_back(
            fmt::format("run {} of {} has no counterpart in {}", sets.front().runs[run].id, names.front(), names[i]));
      }
    }
    for (std::size_t run = 0; run < is_taken.size(); ++run) {
      if (is_taken[run]) continue;
      warnings.push_back(
          fmt::format("run {} of {} has no counterpart in {}", sets[i].runs[run].id, names[i], names.front()));
    }
  }
  return groups;
}

Json describe_run(const MeasuredRun& run) {
  const RunConditions conditions = find_conditions(run);
  return {{"id", run.id},
          {"initial_tire_temperature_degC", run.initial_tire_temperature_K - kZeroCelsius_K},
          {"cold_pressure_kPa", run.cold_pressure_Pa * 1e-3},
          {"mean_speed_km_h", fmt::format("{:.1f}", conditions.speed_m_s * kKmhPerMs)},
          {"mean_load_N", fmt::format("{:.0f}", conditions.load_N)},
          {"mean_ambient_degC", fmt::format("{:.1f}", conditions.ambient_K - kZeroCelsius_K)},
          {"duration_s", fmt::format("{:.0f}", conditions.duration_s)}};
}

/// What a set says of tire, machine, sensors and runs. `groups` give the runs the names of those of the reference.
Json describe_set(const std::vector<MeasurementSet>& sets, std::size_t i, const std::vector<RunGroup>& groups) {
  const MeasurementSet& set = sets[i];
  Json json = {{"tire", make_tire_document(set.tire)}};
  if (set.rig.has_value()) {
    json["rig"] = {{"name", set.rig->name}};
    rigs::RigFile::visit_tables(*set.rig,
                                [&json](const char* name, const auto& table, rigs::RigFile::Presence presence) {
                                  if (presence != rigs::RigFile::Presence::kOptional)
                                    json["rig"][name] = make_number_document(table);
                                });
  }
  if (set.vehicle.has_value()) json["vehicle"] = {{"name", set.vehicle->name}};
  for (const auto& [channel, sensor] : set.sensors) {
    const double factor = channel.file_unit().factor;
    json["sensors"][channel.header()] = {{"offset_sd", sensor.offset_sd / factor},
                                         {"drift_sd", sensor.drift_sd / factor},
                                         {"drift_time_s", sensor.drift_time_s},
                                         {"noise_sd", sensor.noise_sd / factor},
                                         {"resolution", sensor.resolution / factor}};
  }
  for (const RunGroup& group : groups) {
    if (!group.runs[i].has_value()) continue;
    json["runs"][sets.front().runs[*group.runs.front()].id] = describe_run(set.runs[*group.runs[i]]);
  }
  return json;
}

/// What the intervals do not hold: the zeros of the sensors, which are the same over a whole session.
void describe_offsets(const std::vector<MeasurementSet>& sets, Comparison& comparison) {
  std::string text;
  for (const Quantity& channel : measurements::measured_channels(*sets.front().kind)) {
    const bool is_used = std::any_of(comparison.values.begin(), comparison.values.end(),
                                     [&](const ComparedValue& value) { return value.name == channel.header(); });
    const auto a = sets.front().sensors.find(channel);
    const auto b = sets[1].sensors.find(channel);
    if (!is_used || a == sets.front().sensors.end() || b == sets[1].sensors.end()) continue;
    const double sd = std::hypot(a->second.offset_sd, b->second.offset_sd) / channel.file_unit().factor;
    const std::string symbol = channel.file_unit().symbol == "degC" ? "K" : channel.file_unit().symbol;
    text += fmt::format("{}{} {:.2g} {}", text.empty() ? "" : ", ", plain_name(channel.header()), sd, symbol);
  }
  if (text.empty()) return;
  comparison.method.push_back(
      "not included: the zeros of the sensors, which are one for a session. Those of two sessions differ with a "
      "standard deviation, by the sets' files, of " +
      text);
}

/// The force channel in the longest phase.
void add_set_message(const std::vector<MeasurementSet>& sets, Comparison& comparison,
                     const std::vector<GroupComparison>& groups) {
  const std::string force = sets.front().kind->traits.force.header();
  const ComparedValue* chosen = nullptr;
  std::size_t most = 0;
  for (const ComparedValue& value : comparison.values) {
    if (value.name != force || !value.differences.front().value.has_value()) continue;
    for (const GroupComparison& group : groups) {
      for (const RunPhase& phase : group.phases(0)) {
        if (value.place != fmt::format("{}, {}", group.run(0).id, phase.name)) continue;
        if (phase.last - phase.first <= most) continue;
        most = phase.last - phase.first;
        chosen = &value;
      }
    }
  }
  if (chosen == nullptr && !comparison.values.empty()) chosen = &comparison.values.front();
  if (chosen == nullptr) {
    comparison.message = "no run of one set belongs to a run of the other";
    return;
  }
  for (std::size_t i = 1; i < comparison.names.size(); ++i) {
    comparison.message += (i > 1 ? ". " : "") + describe_difference(comparison, *chosen, i);
  }
}

void require_one_kind(const std::vector<MeasurementSet>& sets) {
  for (const MeasurementSet& set : sets) {
    if (set.kind == sets.front().kind) continue;
    throw InputError({"sets of different kinds of machine have nothing to compare", set.path, 0, "", set.kind->set_word,
                      fmt::format("{}, as the first of the sets", sets.front().kind->set_word), ""});
  }
}

}  // namespace

Compared compare_sets(const std::vector<MeasurementSet>& sets, const std::vector<std::string>& names) {
  require_one_kind(sets);
  Compared compared;
  Comparison& comparison = compared.comparison;
  comparison.kind = ComparedKind::kSets;
  comparison.names = names;
  const std::vector<RunGroup> groups = group_runs(sets, names, comparison.warnings);
  std::vector<Json> documents;
  for (std::size_t i = 0; i < sets.size(); ++i) documents.push_back(describe_set(sets, i, groups));
  std::vector<const Json*> pointers;
  for (const Json& document : documents) pointers.push_back(&document);
  comparison.inputs = find_different_inputs(pointers, {});
  std::vector<GroupComparison> of_groups;
  for (const RunGroup& group : groups) {
    of_groups.emplace_back(sets, group);
    of_groups.back().add_values(comparison);
    if (!group.is_complete()) continue;
    std::vector<OverlaidRun> runs;
    for (std::size_t i = 0; i < sets.size(); ++i) runs.push_back(of_groups.back().lay(i));
    compared.overlays.push_back(overlay_runs(runs, names, of_groups.back().run(0).id, comparison.warnings));
  }
  comparison.method.push_back(
      "means over the times of a phase that both runs have, from its beginning; the difference sample by sample. Its "
      "interval of 95 % is from the means of eight blocks about a straight line, and not narrower than noise and drift "
      "by the sets' sensors make it. Runs are taken to be independent of each other");
  describe_offsets(sets, comparison);
  add_set_message(sets, comparison, of_groups);
  return compared;
}

}  // namespace rollrig::comparison
