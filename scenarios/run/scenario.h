#pragma once
/// A scenario: a procedure that is carried out on a rig, and what is reported of it.
///
/// A scenario is one file, scenarios/<name>.cpp, and one line in scenarios.def. See docs/add_a_scenario.md.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "estimation/uncertainty/measurement_model.h"
#include "measurements/measurement_set.h"
#include "models/effect.h"
#include "models/quantities.h"
#include "scenarios/run/results.h"
#include "sim/recording.h"
#include "sim/simulate.h"

namespace rollrig::scenarios {

namespace quantities = models::quantities;

enum class Fidelity { kMultibody, kQuasiStatic };

struct Scenario;

/// Everything that a run is made from, read and checked.
struct RunSpec {
  const Scenario* scenario = nullptr;
  models::TireFile tire;
  rigs::RigFile rig;
  std::optional<rigs::VehicleFile> vehicle;  // where the scenario has one
  Fidelity fidelity = Fidelity::kMultibody;
  models::Baseline baseline = models::Baseline::kCombined;
  std::vector<models::ActiveEffect> effects;
  std::optional<models::SensorSet> sensors;  // absent: what is recorded is what is
  std::uint64_t seed = 1;
  double sample_interval_s = 1.0;
  double tolerance_factor = 1.0;
  ConfigTable settings;  // [settings], read by the scenario
};

/// Part of a run that makes one run of a measurement set: rolling from a soaked tire.
struct SetRun : measurements::RunTable {
  double start_s = 0.0;
  double end_s = 0.0;
};

struct Outcome {
  Json result = Json::object();    // `result` of result.json
  ResultSheet sheet;               // the same, for people
  Json settings = Json::object();  // every setting as used
  std::vector<std::string> warnings;
  sim::Recording<double> recording;
  std::vector<SetRun> set_runs;
  Json statistics = Json::object();  // of the integrator
  /// The results as a measurement, for their uncertainty: of a scenario with has_uncertainty. A call may simulate
  /// again, and so may the evaluation of what it returns. The spec must outlive it. Throws RunFailure.
  std::function<estimation::MeasurementModel()> make_measurement_model;
  std::optional<InputProblem> why_no_uncertainty;  // the error of asking for one that the settings do not allow
};

/// A setting as it is shown by `rollrig describe`.
struct SettingInfo {
  std::string key;
  std::string range;
  std::string fallback;  // as text, in the unit of the key
  std::string doc;
  std::optional<Range> limits = {};       // of a single number, in the unit of the key
  std::vector<std::string> choices = {};  // of a word
};

/// What a scenario says of itself.
struct ScenarioText {
  std::string name;
  std::string summary;
  std::string procedure;  // steps, for a person
  std::string source;
  std::string former_name = {};  // still accepted where a scenario is named
};

/// A run whose settings are read and whose program is planned: calling it carries it out. Its spec must outlive it.
/// Throws RunFailure, Interrupted.
using PreparedRun = std::function<Outcome(const sim::Progress&)>;

struct Scenario {
  ScenarioText text;
  bool (*runs_on)(const models::MachineTraits&) = &models::has_skim;  // machines on which it can be carried out
  std::string default_rig = "drum_2m";                                // empty: it names no rig
  bool has_vehicle = false;
  std::vector<Fidelity> fidelities{Fidelity::kMultibody, Fidelity::kQuasiStatic};  // the first unless asked otherwise
  bool writes_sets = false;                                                        // with sensors, of the rig's kind
  bool has_uncertainty = false;  // its outcomes have a measurement model
  std::vector<SettingInfo> settings;
  std::vector<ResultInfo> results;
  std::vector<std::pair<std::string, std::string>> headlines;  // key and label of what matters most, in that order
  /// Reads spec.settings and plans: what prepare_run() calls. Throws InputError.
  std::function<PreparedRun(const RunSpec& spec)> prepare;

  bool has_rig() const { return !default_rig.empty(); }
};

/// Reads the settings of `spec` and plans its scenario, which finds whatever is wrong with them. A run that fails then
/// says which effects were on. Throws InputError.
PreparedRun prepare_run(const RunSpec& spec);

/// Prepares and runs. Throws InputError, RunFailure, Interrupted.
Outcome run_scenario(const RunSpec& spec, const sim::Progress& progress);

/// All scenarios, in the order of scenarios.def.
const std::vector<const Scenario*>& all_scenarios();
std::vector<std::string> scenario_names();
/// By its name or its former one; nullptr where there is none.
const Scenario* find_scenario_if_any(const std::string& name);
/// The same; throws InputError with the nearest known name where there is none.
const Scenario& find_scenario(const std::string& name);

}  // namespace rollrig::scenarios
