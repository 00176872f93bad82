#include "validation/generator/changes.h"

#include <algorithm>
#include <cmath>

#include "sim/core/error.h"
#include "validation/generator/known_set.h"

namespace rollrig::generator {
namespace {

constexpr std::size_t kBlockSamples = 10;

/// Index of the one whose name it is. Throws InputError where there is none.
template <class Named, class Get>
std::size_t find_index(const char* what, const std::string& name, const std::vector<Named>& all, Get&& get_name) {
  std::vector<std::string> names;
  for (const Named& one : all) names.emplace_back(get_name(one));
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) throw InputError(unknown_name(what, name, names));
  return static_cast<std::size_t>(at - names.begin());
}

/// Rows of a place that are compared.
std::vector<std::size_t> find_rows(const Place& place, const std::vector<bool>& samples) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < samples.size(); ++row) {
    const auto time_s = static_cast<double>(row);  // rows at 1 Hz
    if (samples[row] && time_s >= place.start_s && time_s < place.end_s) rows.push_back(row);
  }
  return rows;
}

Change average(const std::vector<double>& values, const std::vector<std::size_t>& rows, double floor) {
  Change change;
  for (std::size_t first = 0; first < rows.size(); first += kBlockSamples) {
    const std::size_t last = std::min(first + kBlockSamples, rows.size());
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i) sum += std::isnan(values[rows[i]]) ? 0.0 : values[rows[i]];
    const double mean = sum / static_cast<double>(last - first) / floor;
    ++change.blocks;
    change.mean += mean;
    change.rms += mean * mean;
  }
  if (change.blocks == 0) return change;
  change.mean /= static_cast<double>(change.blocks);
  change.rms = std::sqrt(change.rms / static_cast<double>(change.blocks));
  return change;
}

}  // namespace

std::vector<ChangeAt> find_changes(const SetOrder& order, const std::vector<Place>& places) {
  const KnownSet set(order);
  const KnownSet::Change raw = set.find_change();
  const KnownSet::Change left = set.find_change_after_retuning();
  std::vector<ChangeAt> changes;
  for (const Place& place : places) {
    const std::size_t r =
        find_index("run", place.run, set.lab().campaign.runs, [](const RunPlan& run) { return run.id; });
    const std::size_t i = find_index("channel", place.channel, set.lab().specimen.machine->channels,
                                     [](const Channel& channel) { return channel.name; });
    const std::vector<std::size_t> rows = find_rows(place, set.samples(r, i));
    const double floor = set.lab().sensors[i].floor();
    changes.push_back({average(raw[r][i], rows, floor), average(left[r][i], rows, floor)});
  }
  return changes;
}

}  // namespace rollrig::generator
