#include "scenarios/run_spec.h"

#include <fmt/format.h>

#include "scenarios/assets.h"
#include "scenarios/drum_bench.h"
#include "scenarios/sensor_file.h"
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

/// An asset's document with the overrides of the run.
ConfigTable read_with_overrides(const std::string& path, const std::string& content, const ConfigTable* overrides) {
  ConfigTable config = parse_config(content, path);
  if (overrides != nullptr) merge(config, *overrides);
  return config;
}

const ConfigTable* find_override(TableReader& overrides, const char* what) { return overrides.table(what); }

std::optional<models::SensorSet> read_run_sensors(TableReader& reader, const std::string& base_folder,
                                                  const Scenario& scenario) {
  if (!reader.has("sensors")) {
    reader.accept("sensors");
    return std::nullopt;
  }
  const ConfigTable* table = reader.source().find("sensors")->as_table();
  const std::string name = table != nullptr ? "" : reader.text("sensors");
  if (name == "none") return std::nullopt;
  if (scenario.has_vehicle) {
    throw reader.problem("sensors", fmt::format("scenario '{}' records without sensors", scenario.text.name),
                         "no sensors, or none");
  }
  if (table != nullptr) return models::read_sensors(*reader.table("sensors"), measured_drum_channels());
  return read_sensor_file(read_config(find_asset_of(reader, "sensors", base_folder, "sensors", name)));
}

template <class Parameters>
Json parameters_to_json(const Parameters& parameters) {
  Json json = Json::object();
  Parameters::visit(parameters, [&json](const Field& field, const double& value) {
    json[field.key] = unit_of_key(field.key).from_si(value);
  });
  return json;
}

Json tire_to_json(const models::TireFile& tire, const models::TireParameters<double>& on_rig) {
  Json json = {{"name", tire.name}, {"file", tire.path}, {"sha256", calc_sha256(tire.content)}};
  models::TireParameters<double>::visit_all(on_rig,
                                            [&json](const char* table, const Field& field, const double& value) {
                                              json[table][field.key] = unit_of_key(field.key).from_si(value);
                                            });
  json["load_map"] = Json::array();
  for (const auto& entry : on_rig.load_map) json["load_map"].push_back(parameters_to_json(entry));
  return json;
}

Json rig_to_json(const rigs::RigFile& rig) {
  using rigs::RigKind;
  Json json = {{"name", rig.name}, {"file", rig.path}, {"sha256", calc_sha256(rig.content)}};
  if (rig.kind != RigKind::kFlat) {
    json[rig.kind == RigKind::kDrum ? "drum" : "roller"] = parameters_to_json(rig.drum);
    json["parasitic"] = parameters_to_json(rig.parasitic);
    json["drive"] = parameters_to_json(rig.drive);
  }
  json["environment"] = parameters_to_json(rig.environment);
  if (rig.kind == RigKind::kDrum) {
    json["skim"] = parameters_to_json(rig.skim);
    json["carriage"] = parameters_to_json(rig.carriage);
  }
  if (rig.kind == RigKind::kDyno) {
    json["rollers_under"] = rigs::name_of_rolling_wheels(rig);
    json["tie_down"] = parameters_to_json(rig.tie_down);
  }
  return json;
}

Json vehicle_to_json(const rigs::VehicleFile& vehicle) {
  Json json = {{"name", vehicle.name},
               {"file", vehicle.path},
               {"sha256", calc_sha256(vehicle.content)},
               {"body", parameters_to_json(vehicle.body)},
               {"tires", vehicle.tires},
               {"geometry", parameters_to_json(vehicle.geometry)},
               {"suspension", parameters_to_json(vehicle.suspension)},
               {"powertrain", parameters_to_json(vehicle.powertrain)},
               {"brakes", parameters_to_json(vehicle.brakes)}};
  json["powertrain"]["driven_axle"] = rigs::name_of(vehicle.driven_axle);
  if (vehicle.road_load.has_value()) json["road_load"] = parameters_to_json(*vehicle.road_load);
  return json;
}

Json effects_to_json(const std::vector<models::ActiveEffect>& effects) {
  Json json = Json::object();
  for (const models::ActiveEffect& active : effects) {
    Json& own = json[active.effect->info.id] = Json::object();
    const auto& declared = active.effect->info.parameters;
    for (std::size_t i = 0; i < declared.size(); ++i) {
      own[declared[i].key] = unit_of_key(declared[i].key).from_si(active.parameters[i]);
    }
  }
  return json;
}

Json sensors_to_json(const std::optional<models::SensorSet>& sensors) {
  if (!sensors.has_value()) return nullptr;
  Json json = Json::object();
  for (const auto& [channel, sensor] : *sensors) {
    const double factor = unit_of_key(channel).factor;
    json[channel] = {{"offset_sd", sensor.offset_sd / factor},
                     {"drift_sd", sensor.drift_sd / factor},
                     {"drift_time_s", sensor.drift_time_s},
                     {"noise_sd", sensor.noise_sd / factor},
                     {"resolution", sensor.resolution / factor}};
  }
  return json;
}

void check_rig_kind(const RunSpec& spec) {
  std::vector<std::string> kinds;
  for (const rigs::RigKind kind : spec.scenario->rig_kinds) {
    if (spec.rig.kind == kind) return;
    kinds.push_back(fmt::format("\"{}\"", name_of(kind)));
  }
  throw InputError({fmt::format("scenario '{}' cannot be carried out on rig '{}', which is of kind \"{}\"",
                                spec.scenario->text.name, spec.rig.name, name_of(spec.rig.kind)),
                    spec.rig.path, 0, "kind", "", fmt::format("a rig of kind {}", fmt::join(kinds, " or ")), ""});
}

/// The vehicle of a scenario that has one.
void read_run_vehicle(TableReader& reader, TableReader& overrides, const std::string& base_folder, RunSpec& spec) {
  if (!spec.scenario->has_vehicle) {
    for (TableReader* from : {&reader, &overrides}) {
      if (!from->has("vehicle")) continue;
      throw from->problem("vehicle", fmt::format("scenario '{}' has no vehicle", spec.scenario->text.name),
                          "no vehicle, or another scenario");
    }
    return;
  }
  const std::string path =
      find_asset_of(reader, "vehicle", base_folder, "vehicles", reader.text_or("vehicle", "source_car"));
  const std::string content = read_text_file(path);
  spec.vehicle = rigs::read_vehicle(read_with_overrides(path, content, find_override(overrides, "vehicle")));
  spec.vehicle->content = content;
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
                      "--set speed_km_h=100, --set tire.thermal.z_W_per_K=12, --set effects.<id>.<parameter>=...", ""});
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

RunSpec read_run_spec(const ConfigTable& document, const std::string& base_folder) {
  TableReader reader(document, "");
  check_format(reader, kFormat, kVersion);
  RunSpec spec;
  spec.scenario = &find_scenario(reader.text("scenario", scenario_names()));
  const ConfigTable no_changes;
  const ConfigTable* override_table = reader.table("override");
  TableReader overrides(override_table != nullptr ? *override_table : no_changes, "[override]");
  const std::string tire_path = find_asset_of(reader, "tire", base_folder, "tires", reader.text("tire"));
  const std::string tire_content = read_text_file(tire_path);
  spec.tire = models::read_tire(read_with_overrides(tire_path, tire_content, find_override(overrides, "tire")));
  spec.tire.content = tire_content;
  const std::string rig_path =
      find_asset_of(reader, "rig", base_folder, "rigs", reader.text_or("rig", spec.scenario->default_rig));
  const std::string rig_content = read_text_file(rig_path);
  spec.rig = rigs::read_rig(read_with_overrides(rig_path, rig_content, find_override(overrides, "rig")));
  spec.rig.content = rig_content;
  read_run_vehicle(reader, overrides, base_folder, spec);
  overrides.finish();
  const std::vector<std::string> fidelities{"multibody", "quasi_static"};
  spec.fidelity = reader.text_or("fidelity", "multibody", fidelities) == "multibody" ? Fidelity::kMultibody
                                                                                     : Fidelity::kQuasiStatic;
  const std::vector<std::string> baselines{"combined", "constant_rrc"};
  spec.baseline = reader.text_or("baseline", "combined", baselines) == "combined" ? models::Baseline::kCombined
                                                                                  : models::Baseline::kConstantRrc;
  spec.seed = static_cast<std::uint64_t>(reader.count({"seed", between(0.0, 2147483647.0), "random seed", 1.0}));
  spec.sample_interval_s = reader.number({"sample_interval_s", between(0.01, 60.0), "between rows", 1.0});
  spec.tolerance_factor = reader.number({"tolerance_factor", between(1e-3, 1e3), "on all tolerances", 1.0});
  spec.sensors = read_run_sensors(reader, base_folder, *spec.scenario);
  if (const ConfigTable* effects = reader.table("effects")) spec.effects = models::read_effects(*effects);
  if (const ConfigTable* settings = reader.table("settings")) spec.settings = *settings;
  reader.finish();
  check_rig_kind(spec);
  return spec;
}

Json make_manifest(const RunSpec& spec, const Outcome& outcome) {
  Json manifest;
  manifest["format"] = "rollrig-manifest/1";
  manifest["rollrig"] = {{"version", ROLLRIG_VERSION},
                         {"compiler", ROLLRIG_COMPILER},
                         {"simbody", ROLLRIG_SIMBODY_VERSION},
                         {"sundials", ROLLRIG_SUNDIALS_VERSION}};
  manifest["scenario"] = spec.scenario->text.name;
  manifest["fidelity"] = name_of(spec.fidelity);
  manifest["baseline"] = name_of(spec.baseline);
  manifest["seed"] = spec.seed;
  manifest["sample_interval_s"] = spec.sample_interval_s;
  manifest["tolerance_factor"] = spec.tolerance_factor;
  manifest["settings"] = outcome.settings;
  manifest["tire"] = tire_to_json(spec.tire, spec.tire.parameters_on(spec.rig.name, spec.baseline));
  manifest["rig"] = rig_to_json(spec.rig);
  if (spec.vehicle.has_value()) manifest["vehicle"] = vehicle_to_json(*spec.vehicle);
  manifest["effects"] = effects_to_json(spec.effects);
  manifest["sensors"] = sensors_to_json(spec.sensors);
  manifest["integrator"] = outcome.statistics;
  return manifest;
}

Json make_result_json(const RunSpec& spec, const Outcome& outcome) {
  using Ledger = sim::EnergyTerm::Ledger;
  Json json;
  json["format"] = "rollrig-result/1";
  json["scenario"] = spec.scenario->text.name;
  json["tire"] = spec.tire.name;
  json["rig"] = spec.rig.name;
  if (spec.vehicle.has_value()) json["vehicle"] = spec.vehicle->name;
  json["fidelity"] = name_of(spec.fidelity);
  json["result"] = outcome.result;
  json["phases"] = Json::array();
  for (const sim::PhaseSpan& phase : outcome.recording.phases) {
    json["phases"].push_back({{"name", phase.name}, {"start_s", phase.start_s}, {"end_s", phase.end_s}});
  }
  const sim::EnergyAudit& audit = outcome.recording.audit;
  Json terms = Json::object();
  for (const sim::EnergyTerm& term : audit.terms) terms[term.name] = term.in_J;
  json["energy"] = {{"mechanical_closure", audit.calc_closure(Ledger::kMechanical)},
                    {"thermal_closure", audit.calc_closure(Ledger::kThermal)},
                    {"terms_J", terms}};
  if (!outcome.warnings.empty()) json["warnings"] = outcome.warnings;
  return json;
}

}  // namespace rollrig::scenarios
