#include "diagnosis/study.h"

#include <utility>

#include "diagnosis/comparison/machine_key.h"

namespace rollrig::diagnosis {
namespace {

constexpr const char* kOfTire = "tire.";

/// Whether a number is the same on all machines: one of the tire, unless a machine's file gives it, as the conductances
/// by [tire_cooling].
bool is_shared(const PreparedSet& set, const std::string& key) {
  if (key.rfind(kOfTire, 0) != 0) return set.machine_count() == 1;
  models::Context<double> first = set.context();
  for (std::size_t machine = 1; machine < set.machine_count(); ++machine) {
    models::Context<double> other = set.context(machine);
    if (estimation::find_parameter(first, key) != estimation::find_parameter(other, key)) return false;
  }
  return true;
}

/// Those of the first machine's set, and of the others what is not shared.
std::vector<estimation::FreeParameter> join_base_parameters(const PreparedSet& set, TireBelief belief) {
  std::vector<estimation::FreeParameter> joined;
  for (std::size_t machine = 0; machine < set.machine_count(); ++machine) {
    for (auto& base : find_base_parameters(set.source(machine), set.context(machine), belief)) {
      const bool shared = is_shared(set, base.key);
      if (shared && machine > 0) continue;
      if (!shared) {
        base.key = name_on_machine(base.key, machine);
        base.prior_correlations.clear();
      }
      joined.push_back(std::move(base));
    }
  }
  return joined;
}

std::map<std::string, rollrig::SdSource> join_sd_sources(const PreparedSet& set, TireBelief belief) {
  std::map<std::string, rollrig::SdSource> joined;
  for (std::size_t machine = 0; machine < set.machine_count(); ++machine) {
    for (const auto& [key, source] : find_sd_sources(set.source(machine), set.context(machine), belief)) {
      joined[is_shared(set, key) ? key : name_on_machine(key, machine)] = source;
    }
  }
  return joined;
}

}  // namespace

Study::Study(const measurements::MeasurementSet& measured, StudySettings with)
    : Study(std::vector<measurements::MeasurementSet>{measured}, std::move(with)) {}

Study::Study(std::vector<measurements::MeasurementSet> measured, StudySettings with)
    : settings(std::move(with)),
      set(std::move(measured)),
      base(join_base_parameters(set, settings.belief)),
      sd_sources(join_sd_sources(set, settings.belief)),
      discrepancy(set) {}

}  // namespace rollrig::diagnosis
