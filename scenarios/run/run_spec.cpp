#include "scenarios/run/run_spec.h"

#include <fmt/format.h>

#include <cmath>

#include "measurements/measurement_set.h"
#include "measurements/sensor_file.h"
#include "sim/core/assets.h"
#include "sim/core/file_io.h"

namespace rollrig::scenarios {
namespace {

constexpr const char* kFormat = "rollrig-run";
constexpr int kVersion = 1;

/// Puts every value of `changes` over that of `base`, table by table.
void merge(ConfigTable& base, const ConfigTable& changes) {
  for (const auto& [key, value] : changes.entries) {
    const auto it = base.entries.find(key);
    const bool both_tables =
        it != base.entries.end() && it->second.as_table() != nullptr && value.as_table() != nullptr;
    if (both_tables) {
      merge(std::get<ConfigTable>(it->second.data), *value.as_table());
    } else {
      base.entries[key] = value;
    }
  }
}

/// What a run document says: the document itself, its [override], and the folder to which its paths are relative.
struct RunDocument {
  TableReader reader;
  TableReader overrides;
  std::string base_folder;

  /// The file that `key` names, read by `read` with the overrides of the run.
  template <class Read>
  auto read_file(const std::string& key, const std::string& folder, const std::string& name, const Read& read) {
    const std::string path = find_asset_of(reader, key, base_folder, folder, name);
    const std::string content = read_text_file(path);
    ConfigTable config = parse_config(content, path);
    if (const ConfigTable* changes = overrides.table(key)) merge(config, *changes);
    auto file = read(config);
    file.content = content;
    return file;
  }

  /// Throws InputError where a run names what its scenario has not.
  void refuse(const char* machine, const Scenario& scenario) const {
    for (const TableReader* from : {&reader, &overrides}) {
      if (!from->has(machine)) continue;
      throw from->problem(machine, fmt::format("scenario '{}' has no {}", scenario.text.name, machine),
                          fmt::format("no {}, or another scenario", machine));
    }
  }
};

std::optional<models::SensorSet> read_run_sensors(TableReader& reader, const std::string& base_folder,
                                                  const RunSpec& spec) {
  if (!reader.has("sensors")) {
    reader.accept("sensors");
    return std::nullopt;
  }
  const ConfigTable* table = reader.source().find("sensors")->as_table();
  const std::string name = table != nullptr ? "" : reader.text("sensors");
  if (name == "none") return std::nullopt;
  if (!spec.scenario->writes_sets) {
    throw reader.problem("sensors", fmt::format("scenario '{}' records without sensors", spec.scenario->text.name),
                         "no sensors, or none");
  }
  const std::vector<Quantity> channels = rigs::measured_channels(*spec.rig.kind);
  if (table != nullptr) return models::read_sensors(*reader.table("sensors"), channels);
  return measurements::read_sensor_file(read_config(find_asset_of(reader, "sensors", base_folder, "sensors", name)),
                                        channels);
}

void check_rig_kind(const RunSpec& spec) {
  if (spec.scenario->runs_on(spec.rig.kind->traits)) return;
  throw InputError(
      {fmt::format("scenario '{}' cannot be carried out on rig '{}', which is of kind \"{}\"", spec.scenario->text.name,
                   spec.rig.name, spec.rig.kind->word),
       spec.rig.path, 0, "kind", "",
       fmt::format("a rig of kind \"{}\"", fmt::join(rigs::list_machines(spec.scenario->runs_on), "\" or \"")), ""});
}

/// The load of the skim test by the class of the tire. One that the run gives holds for all classes.
void read_skim_load(RunDocument& document, RunSpec& spec) {
  const ConfigTable* changes = document.overrides.table("rig");
  const ConfigValue* skim = changes != nullptr ? changes->find("skim") : nullptr;
  const bool is_given = skim != nullptr && skim->as_table() != nullptr && skim->as_table()->find("load_N") != nullptr;
  if (is_given && changes->find("skim_by_class") == nullptr) spec.rig.skim_by_class = {};
  rigs::use_skim_load_of_class(spec.rig, spec.tire);
}

void read_machines(RunDocument& document, RunSpec& spec) {
  const Scenario& scenario = *spec.scenario;
  if (scenario.has_rig()) {
    spec.rig = document.read_file("rig", "rigs", document.reader.text_or("rig", scenario.default_rig), &rigs::read_rig);
    read_skim_load(document, spec);
  } else {
    document.refuse("rig", scenario);
    spec.rig = rigs::find_kind_without_rig(scenario.runs_on).make_rig();
  }
  if (scenario.has_vehicle) {
    const std::string name = document.reader.text_or("vehicle", "source_car");
    spec.vehicle = document.read_file("vehicle", "vehicles", name, &rigs::read_vehicle);
  } else {
    document.refuse("vehicle", scenario);
  }
}

Fidelity read_fidelity(TableReader& reader, const Scenario& scenario) {
  const std::string name =
      reader.text_or("fidelity", name_of(scenario.fidelities.front()), {"multibody", "quasi_static"});
  std::vector<std::string> allowed;
  for (const Fidelity fidelity : scenario.fidelities) {
    if (name == name_of(fidelity)) return fidelity;
    allowed.emplace_back(name_of(fidelity));
  }
  throw reader.problem("fidelity", fmt::format("scenario '{}' is not simulated {}", scenario.text.name, name),
                       fmt::format("{}", fmt::join(allowed, " or ")));
}

/// Up to 2^53, which is more than an int holds: seeds of a campaign's items have 53 bits.
std::uint64_t read_seed(TableReader& reader) {
  const Field field{"seed", between(0.0, 9007199254740991.0), "random seed", 1.0};
  const double seed = reader.number(field);
  if (seed == std::floor(seed)) return static_cast<std::uint64_t>(seed);
  throw reader.problem(field.key, "'seed' must be a whole number", "a number " + field.range.to_string());
}

}  // namespace

const char* name_of(Fidelity fidelity) { return fidelity == Fidelity::kMultibody ? "multibody" : "quasi_static"; }
const char* name_of(models::Baseline baseline) {
  return baseline == models::Baseline::kCombined ? "combined" : "constant_rrc";
}

ConfigTable make_run_document(const std::string& scenario) {
  ConfigTable document;
  document.origin = {"command line", 0};
  const auto set = [&document](const char* key, const std::string& value) {
    document.entries[key] = ConfigValue{value, document.origin, value};
  };
  set("format", fmt::format("{}/{}", kFormat, kVersion));
  set("scenario", scenario);
  return document;
}

void set_run_value(ConfigTable& document, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError({fmt::format("--set '{}' is not key=value", assignment), "command line", 0, "--set", assignment,
                      "--set speed_km_h=100, --set tire.thermal.H_gas_W_per_K=3, --set effects.<id>.<parameter>=...",
                      ""});
  }
  std::string key = assignment.substr(0, equals);
  const std::string first = key.substr(0, key.find('.'));
  const bool has_parts = key.find('.') != std::string::npos;
  if (has_parts && (first == "tire" || first == "rig" || first == "vehicle")) {
    key = "override." + key;
  } else if (!(has_parts && (first == "effects" || first == "sensors" || first == "settings"))) {
    key = "settings." + key;
  }
  set_config_value(document, key, assignment.substr(equals + 1), "--set");
}

RunSpec read_run_spec(const ConfigTable& table, const std::string& base_folder) {
  const ConfigTable no_changes;
  TableReader whole(table, "");
  check_format(whole, kFormat, kVersion);
  const ConfigTable* changes = whole.table("override");
  RunDocument document{whole, {changes != nullptr ? *changes : no_changes, "[override]"}, base_folder};
  TableReader& reader = document.reader;
  RunSpec spec;
  spec.scenario = find_scenario_if_any(reader.text("scenario"));
  if (spec.scenario == nullptr) reader.text("scenario", scenario_names());  // throws
  spec.tire = document.read_file("tire", "tires", reader.text("tire"), &models::read_tire);
  read_machines(document, spec);
  document.overrides.finish();
  spec.fidelity = read_fidelity(reader, *spec.scenario);
  const bool is_combined = reader.text_or("baseline", "combined", {"combined", "constant_rrc"}) == "combined";
  spec.baseline = is_combined ? models::Baseline::kCombined : models::Baseline::kConstantRrc;
  spec.seed = read_seed(reader);
  spec.sample_interval_s = reader.number({"sample_interval_s", between(0.01, 60.0), "between rows", 1.0});
  spec.tolerance_factor = reader.number({"tolerance_factor", between(1e-3, 1e3), "on all tolerances", 1.0});
  spec.sensors = read_run_sensors(reader, base_folder, spec);
  if (const ConfigTable* effects = reader.table("effects")) spec.effects = models::read_effects(*effects);
  if (const ConfigTable* settings = reader.table("settings")) spec.settings = *settings;
  reader.finish();
  check_rig_kind(spec);
  return spec;
}

}  // namespace rollrig::scenarios
