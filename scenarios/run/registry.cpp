#include <algorithm>
#include <array>
#include <mutex>
#include <optional>

#include "estimation/road_load/road_load_doubts.h"
#include "scenarios/run/run_spec.h"
#include "scenarios/run/scenario.h"
#include "scenarios/run/tire_validity.h"
#include "sim/core/error.h"

namespace rollrig::scenarios {

// Named one by one, since the linker drops objects of a static library that nothing refers to.
#define ROLLRIG_SCENARIO(name) \
  namespace name {             \
  Scenario make();             \
  }
#include "scenarios/scenarios.def"
#undef ROLLRIG_SCENARIO

namespace {

/// The tires of a run, each once: that of the run, where an axle of the vehicle takes it, and those of axles.
std::vector<const models::TireFile*> list_tires(const RunSpec& spec) {
  if (!spec.vehicle.has_value()) return {&spec.tire};
  std::vector<const models::TireFile*> tires;
  for (const rigs::VehicleAxle& axle : spec.vehicle->axles) {
    const models::TireFile* tire = &rigs::tire_of(axle, spec.tire);
    if (std::find(tires.begin(), tires.end(), tire) == tires.end()) tires.push_back(tire);
  }
  return tires;
}

void warn_of_tires(const RunSpec& spec, Outcome& outcome) {
  if (spec.baseline == models::Baseline::kConstantRrc || !has_tire_loss(spec)) return;
  std::vector<std::string>& warnings = outcome.warnings;
  for (const models::TireFile* tire : list_tires(spec)) {
    const auto warning = tire->warn_of_conductances(spec.rig.cooling_rig());
    if (warning.has_value()) warnings.push_back(*warning);
    if (!tire->validity.has_value()) continue;
    const std::vector<std::string> beyond = list_validity_warnings(tire->name, *tire->validity, outcome.recording);
    warnings.insert(warnings.end(), beyond.begin(), beyond.end());
  }
}

/// The road load of a vehicle's file is held against its mass, as one that is fitted.
void warn_of_road_load(const RunSpec& spec, Outcome& outcome) {
  if (!spec.vehicle.has_value() || !spec.vehicle->road_load.has_value()) return;
  constexpr double kNoTop_m_s = 1e3;  // a file has no data whose speeds end
  const double mass_kg = spec.vehicle->body.mass_kg;
  for (const std::string& doubt : estimation::doubt_road_load(*spec.vehicle->road_load, mass_kg, kNoTop_m_s)) {
    outcome.warnings.push_back("[road_load] of vehicle '" + spec.vehicle->name + "': " + doubt);
  }
}

}  // namespace

PreparedRun prepare_run(const RunSpec& spec) {
  return [&spec, run = spec.scenario->prepare(spec)](const sim::Progress& progress) {
    try {
      Outcome outcome = run(progress);
      require_loss(list_tires(spec), outcome.recording);
      warn_of_tires(spec, outcome);
      warn_of_road_load(spec, outcome);
      return outcome;
    } catch (const RunFailure& failure) {
      if (spec.effects.empty()) throw;
      throw RunFailure(std::string(failure.what()) + "\neffects that were on: " + describe_effects(spec.effects));
    }
  };
}

Outcome run_scenario(const RunSpec& spec, const sim::Progress& progress) { return prepare_run(spec)(progress); }

namespace {

/// A scenario that is made when it is first asked for: a program that needs one starts some milliseconds sooner.
class Registered {
 public:
  Registered(const char* name, Scenario (*make)()) : name_(name), make_(make) {}

  const char* name() const { return name_; }
  const Scenario& get() {
    std::call_once(once_, [this] { scenario_ = make_(); });
    return *scenario_;
  }

 private:
  const char* name_;
  Scenario (*make_)();
  std::once_flag once_;
  std::optional<Scenario> scenario_;
};

auto& registered_scenarios() {
  static std::array registered{
#define ROLLRIG_SCENARIO(name) Registered(#name, &name::make),
#include "scenarios/scenarios.def"
#undef ROLLRIG_SCENARIO
  };
  return registered;
}

}  // namespace

const std::vector<const Scenario*>& all_scenarios() {
  static const std::vector<const Scenario*> pointers = [] {
    std::vector<const Scenario*> all;
    for (Registered& registered : registered_scenarios()) all.push_back(&registered.get());
    return all;
  }();
  return pointers;
}

std::vector<std::string> scenario_names() {
  std::vector<std::string> names;
  for (const Scenario* scenario : all_scenarios()) names.push_back(scenario->text.name);
  return names;
}

const Scenario* find_scenario_if_any(const std::string& name) {
  for (Registered& registered : registered_scenarios()) {
    if (name == registered.name()) return &registered.get();
  }
  for (const Scenario* scenario : all_scenarios()) {
    if (name == scenario->text.name || (!name.empty() && name == scenario->text.former_name)) return scenario;
  }
  return nullptr;
}

const Scenario& find_scenario(const std::string& name) {
  if (const Scenario* scenario = find_scenario_if_any(name)) return *scenario;
  throw InputError(unknown_name("scenario", name, scenario_names()));
}

}  // namespace rollrig::scenarios
