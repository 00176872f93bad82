#include "comparison/run_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::comparison {
namespace {

using diagnosis::RunPhase;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

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

/// Standard uncertainty of the zero of a channel's sensor, likewise.
double find_zero_sd(const MeasurementSet& set, const Quantity& channel) {
  const auto sensor = set.sensors.find(channel);
  return sensor == set.sensors.end() ? 0.0 : sensor->second.offset_sd / channel.file_unit().factor;
}

const RunPhase* find_phase(const std::vector<RunPhase>& phases, const std::string& name) {
  const auto found =
      std::find_if(phases.begin(), phases.end(), [&name](const RunPhase& phase) { return phase.name == name; });
  return found != phases.end() ? &*found : nullptr;
}

/// The difference of two independent means, with the larger coverage factor.
UncertainMean subtract_means(const UncertainMean& a, const UncertainMean& b) {
  UncertainMean difference;
  difference.mean = a.mean - b.mean;
  if (a.sd.has_value() && b.sd.has_value()) difference.sd = std::hypot(*a.sd, *b.sd);
  difference.coverage_factor = std::max(a.coverage_factor, b.coverage_factor);
  return difference;
}

/// The name of a phase without its load: "80 km/h" of "80 km/h 5.4 kN"; all of another name.
std::string drop_load(const std::string& name) {
  constexpr std::string_view kUnit = "km/h";
  const std::size_t at = name.find(kUnit);
  return at == std::string::npos ? name : name.substr(0, at + kUnit.size());
}

/// The load in the name of a phase: "5.4 kN" of "80 km/h 5.4 kN"; empty where it has none.
std::string find_load(const std::string& name) {
  const std::size_t end = drop_load(name).size();
  return end + 1 < name.size() ? name.substr(end + 1) : "";
}

/// "5.4 and 6.9 kN" of loads, each once; an empty one is left out.
std::string join_loads(const std::vector<std::string>& loads) {
  std::vector<std::string> different;
  for (const std::string& load : loads) {
    if (load.empty() || std::find(different.begin(), different.end(), load) != different.end()) continue;
    different.push_back(load);
  }
  constexpr std::string_view kUnit = " kN";
  for (std::size_t i = 0; i + 1 < different.size(); ++i) {
    std::string& load = different[i];
    const bool has_unit = load.size() > kUnit.size() && load.compare(load.size() - kUnit.size(), 3, kUnit) == 0;
    if (has_unit) load.erase(load.size() - kUnit.size());
  }
  return fmt::format("{}", fmt::join(different, " and "));
}

/// Phases of one list whose name is not in another list; the key of each is its name without the load.
std::map<std::string, std::vector<std::size_t>> list_alone(const std::vector<RunPhase>& phases,
                                                           const std::vector<RunPhase>& others) {
  std::map<std::string, std::vector<std::size_t>> alone;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    if (find_phase(others, phases[i].name) == nullptr) alone[drop_load(phases[i].name)].push_back(i);
  }
  return alone;
}

/// Gives phases of a run that differ from those of the reference in their load alone the names that the reference has
/// for them. Returns what was renamed: {from, to}. Two runs may have such phases in another number: these keep their
/// names.
RenamedPhases name_as(const std::vector<RunPhase>& reference, std::vector<RunPhase>& phases) {
  RenamedPhases renamed;
  const auto alone = list_alone(phases, reference);
  for (const auto& [kind, of_reference] : list_alone(reference, phases)) {
    const auto own = alone.find(kind);
    if (own == alone.end() || own->second.size() != of_reference.size()) continue;
    for (std::size_t i = 0; i < of_reference.size(); ++i) {
      const std::string from = std::exchange(phases[own->second[i]].name, reference[of_reference[i]].name);
      renamed.emplace_back(from, phases[own->second[i]].name);
    }
  }
  return renamed;
}

bool is_skim(const RunPhase& phase) { return phase.name.rfind("skim", 0) == 0; }

}  // namespace

bool RunGroup::is_complete() const {
  return std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.has_value(); });
}

std::string name_less_skim(const Quantity& force) {
  return fmt::format("{}_less_skim_{}", force.name(), force.unit_suffix());
}

GroupComparison::GroupComparison(const std::vector<MeasurementSet>& sets, const RunGroup& group)
    : sets_(sets), group_(group) {
  for (std::size_t i = 0; i < sets.size(); ++i) {
    phases_.push_back(has(i) ? diagnosis::kind_of(sets[i]).find_phases(sets[i], run(i)) : std::vector<RunPhase>());
    renamed_.push_back(i > 0 ? name_as(phases_.front(), phases_.back()) : RenamedPhases());
  }
}

std::vector<std::string> GroupComparison::describe_loads(const std::vector<std::string>& names) const {
  std::vector<std::string> sentences;
  for (std::size_t i = 1; i < names.size(); ++i) {
    for (const auto& [own, of_reference] : renamed_[i]) {
      sentences.push_back(fmt::format("run {}: the loads differ; {} of {} is compared with {} of {}", run(0).id, own,
                                      names[i], of_reference, names.front()));
    }
  }
  return sentences;
}

std::string GroupComparison::name_place(const RunPhase& phase) const {
  const std::vector<std::string> loads = list_loads(phase);
  if (loads.empty()) return fmt::format("{}, {}", run(0).id, phase.name);
  return fmt::format("{}, {}, {}", run(0).id, drop_load(phase.name), join_loads(loads));
}

std::vector<std::string> GroupComparison::list_loads(const RunPhase& phase) const {
  std::vector<std::string> loads{find_load(phase.name)};
  bool differ = false;
  for (std::size_t i = 1; i < phases_.size(); ++i) {
    const RenamedPhases& renamed = renamed_[i];
    const auto own =
        std::find_if(renamed.begin(), renamed.end(), [&](const auto& one) { return one.second == phase.name; });
    differ = differ || own != renamed.end();
    const bool is_there = find_phase(phases_[i], phase.name) != nullptr;
    loads.push_back(own != renamed.end() ? find_load(own->first) : is_there ? loads.front() : "");
  }
  return differ ? loads : std::vector<std::string>();
}

std::optional<double> GroupComparison::calc_mean_load_N(std::size_t set, const RunPhase& phase) const {
  if (!has(set) || !run(set).has(models::quantities::kLoad)) return std::nullopt;
  const RunPhase* own = set == 0 ? &phase : find_phase(phases_[set], phase.name);
  if (own == nullptr || own->first == own->last) return std::nullopt;
  const std::vector<double>& load_N = run(set).column(models::quantities::kLoad);
  double sum_N = 0.0, rows = 0.0;
  for (std::size_t row = own->first; row < own->last; ++row) {
    if (!std::isfinite(load_N[row])) continue;
    sum_N += load_N[row];
    rows += 1.0;
  }
  return rows > 0.0 ? std::optional<double>(sum_N / rows) : std::nullopt;
}

void GroupComparison::add_values(Comparison& comparison) const {
  for (const RunPhase& phase : phases_.front()) {
    for (const Quantity& channel : measurements::measured_channels(*sets_.front().kind)) {
      const std::optional<ComparedValue> value =
          make_value(phase, channel, [&](std::size_t i) { return find_means_with_zeros(i, phase, channel); });
      if (value.has_value()) comparison.values.push_back(*value);
    }
    const std::optional<ComparedValue> less_skim = make_less_skim(phase);
    if (less_skim.has_value()) comparison.values.push_back(*less_skim);
  }
}

OverlaidRun GroupComparison::lay(std::size_t set) const {
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

std::optional<PairedMeans> GroupComparison::find_means(std::size_t other, const RunPhase& phase,
                                                       const Quantity& channel) const {
  const RunPhase* beside = find_phase(phases_[other], phase.name);
  if (beside == nullptr) return std::nullopt;
  const auto calc_sd = [&](std::size_t count, double interval_s) {
    return std::hypot(calc_channel_sd(sets_.front(), channel, count, interval_s),
                      calc_channel_sd(sets_[other], channel, count, interval_s));
  };
  return calc_paired_means(find_samples(run(0), phase, channel), find_samples(run(other), *beside, channel), calc_sd);
}

std::optional<PairedMeans> GroupComparison::find_means_with_zeros(std::size_t other, const RunPhase& phase,
                                                                  const Quantity& channel) const {
  std::optional<PairedMeans> means = find_means(other, phase, channel);
  const bool is_one = means.has_value() && means->difference.sd == 0.0;  // the same data: no zeros between them
  if (!means.has_value() || is_one) return means;
  const double zeros_sd = std::hypot(find_zero_sd(sets_.front(), channel), find_zero_sd(sets_[other], channel));
  means->difference = add_zeros(means->difference, zeros_sd);
  return means;
}

std::optional<ComparedValue> GroupComparison::make_value(const RunPhase& phase, const Quantity& channel,
                                                         const FindMeans& find) const {
  ComparedValue value;
  value.name = channel.header();
  value.place = name_place(phase);
  value.label = fmt::format("mean {}", plain_name(channel.header()));
  value.unit = channel.file_unit().symbol;
  value.doc = "mean over the times of the phase that both runs have";
  value.values.resize(sets_.size());
  value.differences.resize(sets_.size() - 1);
  bool has_any = false;
  for (std::size_t i = 1; i < sets_.size(); ++i) {
    const std::optional<PairedMeans> means = has(i) ? find(i) : std::nullopt;
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

const RunPhase* GroupComparison::find_skim(const RunPhase& loaded) const {
  constexpr double kSame_m_s = 1.0 / kKmhPerMs;
  if (is_skim(loaded)) return nullptr;
  for (const RunPhase& phase : phases_.front()) {
    if (is_skim(phase) && std::abs(calc_speed_m_s(phase) - calc_speed_m_s(loaded)) < kSame_m_s) return &phase;
  }
  return nullptr;
}

double GroupComparison::calc_speed_m_s(const RunPhase& phase) const {
  const std::vector<double>& speed_m_s = run(0).column(models::quantities::kSpeed);
  double sum_m_s = 0.0;
  for (std::size_t row = phase.first; row < phase.last; ++row) sum_m_s += speed_m_s[row];
  return sum_m_s / static_cast<double>(phase.last - phase.first);
}

std::optional<ComparedValue> GroupComparison::make_less_skim(const RunPhase& phase) const {
  const Quantity& force = sets_.front().kind->traits.force;
  const RunPhase* skim = find_skim(phase);
  if (skim == nullptr) return std::nullopt;
  std::optional<ComparedValue> value = make_value(phase, force, [&](std::size_t i) {
    std::optional<PairedMeans> loaded = find_means(i, phase, force);
    const std::optional<PairedMeans> idle = find_means(i, *skim, force);
    if (!loaded.has_value() || !idle.has_value()) return std::optional<PairedMeans>();
    loaded->reference -= idle->reference;
    loaded->other -= idle->other;
    loaded->difference = subtract_means(loaded->difference, idle->difference);
    return loaded;
  });
  if (!value.has_value()) return value;
  value->name = name_less_skim(force);
  value->label = fmt::format("mean {} less skim", plain_name(force.header()));
  value->doc = "mean over the phase less that in skim at its speed: the zero of the sensor cancels";
  return value;
}

}  // namespace rollrig::comparison
