#include "comparison/compare_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "comparison/input_differences.h"
#include "comparison/match_runs.h"
#include "comparison/run_group.h"
#include "comparison/tire_document.h"
#include "sim/core/error.h"
#include "sim/core/json.h"

namespace rollrig::comparison {
namespace {

using diagnosis::RunPhase;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

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

/// Rows of the phase of a place.
std::size_t count_rows(const std::string& place, const std::vector<GroupComparison>& groups) {
  for (const GroupComparison& group : groups) {
    for (const RunPhase& phase : group.phases(0)) {
      if (place == group.name_place(phase)) return phase.last - phase.first;
    }
  }
  return 0;
}

/// "at different loads: a 5.6 kN, b 6.9 kN" of the phase of a place; empty where the loads are the same.
std::string describe_loads_at(const std::string& place, const std::vector<GroupComparison>& groups,
                              const std::vector<std::string>& names) {
  for (const GroupComparison& group : groups) {
    for (const RunPhase& phase : group.phases(0)) {
      if (place != group.name_place(phase)) continue;
      const std::vector<std::string> loads = group.list_loads(phase);
      std::vector<std::string> of_sets;
      for (std::size_t i = 0; i < loads.size(); ++i) {
        if (!loads[i].empty()) of_sets.push_back(fmt::format("{} {}", names[i], loads[i]));
      }
      return of_sets.empty() ? "" : fmt::format("at different loads: {}", fmt::join(of_sets, ", "));
    }
  }
  return "";
}

/// ", for its load 13.3 % lower" of the force of a second set: that over its load beside that of the reference.
std::string describe_over_load(const ComparedValue& value, const std::vector<GroupComparison>& groups) {
  if (value.differences.size() != 1) return "";
  const std::optional<double> percent = value.differences.front().percent;
  for (const GroupComparison& group : groups) {
    for (const RunPhase& phase : group.phases(0)) {
      if (value.place != group.name_place(phase)) continue;
      const std::optional<double> first_N = group.calc_mean_load_N(0, phase), second_N = group.calc_mean_load_N(1, phase);
      if (!percent || !first_N || !second_N || !(*first_N > 0.0 && *second_N > 0.0)) return "";
      const double ratio = (1.0 + *percent / 1e2) * *first_N / *second_N;
      return fmt::format("; for its load it is {:.1f} % {}", 1e2 * std::abs(ratio - 1.0), ratio < 1.0 ? "lower" : "higher");
    }
  }
  return "";
}

/// The force channel in the longest phase, less skim where a run has one; none where nothing is compared.
std::optional<std::size_t> find_main_mean(const std::vector<ComparedValue>& values, const Quantity& force,
                                          const std::vector<GroupComparison>& groups) {
  const auto is_less_skim = [&force](const ComparedValue& value) { return value.name == name_less_skim(force); };
  const bool has_skim = std::any_of(values.begin(), values.end(), is_less_skim);
  std::optional<std::size_t> chosen;
  std::size_t most = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_asked = has_skim ? is_less_skim(values[i]) : values[i].name == force.header();
    if (!is_asked || !values[i].differences.front().value.has_value()) continue;
    const std::size_t length = count_rows(values[i].place, groups);
    if (length <= most) continue;
    most = length;
    chosen = i;
  }
  return chosen.has_value() || values.empty() ? chosen : std::optional<std::size_t>(0);
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
    for (std::string& sentence : of_groups.back().describe_loads(names)) {
      comparison.warnings.push_back(std::move(sentence));
    }
    if (!group.is_complete()) continue;
    std::vector<OverlaidRun> runs;
    for (std::size_t i = 0; i < sets.size(); ++i) runs.push_back(of_groups.back().lay(i));
    compared.overlays.push_back(overlay_runs(runs, names, of_groups.back().run(0).id, comparison.warnings));
  }
  comparison.method.push_back(
      "means over the times of a phase that both runs have, from its beginning; the difference sample by sample. Its "
      "interval of 95 % is from the means of eight blocks about a straight line, and not narrower than noise and drift "
      "by the sets' sensors make it. It contains the zeros of the sensors (offset_sd), which differ from session to "
      "session; in what is less skim they cancel. Runs are taken to be independent of each other");
  const std::optional<std::size_t> main = find_main_mean(comparison.values, sets.front().kind->traits.force, of_groups);
  if (main.has_value()) {
    choose_main(*main, compared);
    const std::string loads = describe_loads_at(comparison.values[*main].place, of_groups, names);
    if (!loads.empty()) {
      comparison.message += ", " + loads + describe_over_load(comparison.values[*main], of_groups);
    }
  } else {
    comparison.message = "no run of one set belongs to a run of another";
  }
  return compared;
}

}  // namespace rollrig::comparison
