// What went into a run and what came out: manifest and result as JSON, the recording as CSV.

#include "scenarios/run/run_spec.h"
#include "sim/core/csv.h"
#include "sim/core/file_io.h"

namespace rollrig::scenarios {
namespace {

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
                                            [&json](const std::string& table, const Field& field, const double& value) {
                                              if (table.rfind("load_map", 0) == 0) return;  // an array, below
                                              json[table][field.key] = unit_of_key(field.key).from_si(value);
                                            });
  json["load_map"] = Json::array();
  for (const auto& entry : on_rig.load_map) json["load_map"].push_back(parameters_to_json(entry));
  return json;
}

Json rig_to_json(const rigs::RigFile& rig) {
  Json json = {{"name", rig.name}, {"file", rig.path}, {"sha256", calc_sha256(rig.content)}};
  rigs::RigFile::visit_tables(rig, [&json](const char* name, const auto& table, rigs::RigFile::Presence presence) {
    if (presence != rigs::RigFile::Presence::kOptional) json[name] = parameters_to_json(table);
  });
  if (is_tied_down(rig.kind->traits)) json["rollers_under"] = rigs::name_of_rolling_wheels(rig);
  return json;
}

Json vehicle_to_json(const rigs::VehicleFile& vehicle) {
  Json json = {{"name", vehicle.name},
               {"file", vehicle.path},
               {"sha256", calc_sha256(vehicle.content)},
               {"body", parameters_to_json(vehicle.body)},
               {"center_of_gravity_height_m", vehicle.center_of_gravity_height_m},
               {"powertrain", parameters_to_json(vehicle.powertrain)},
               {"axles", Json::array()}};
  for (const rigs::VehicleAxle& axle : vehicle.axles) {
    Json own = parameters_to_json(axle);
    own["name"] = axle.name;
    own["suspension"] = parameters_to_json(axle.suspension);
    if (axle.tire.has_value()) own["tire"] = tire_to_json(*axle.tire, axle.tire->values);
    json["axles"].push_back(own);
  }
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
    const double factor = channel.file_unit().factor;
    json[channel.header()] = {{"offset_sd", sensor.offset_sd / factor},
                              {"drift_sd", sensor.drift_sd / factor},
                              {"drift_time_s", sensor.drift_time_s},
                              {"noise_sd", sensor.noise_sd / factor},
                              {"resolution", sensor.resolution / factor}};
  }
  return json;
}

}  // namespace

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
  manifest["tire"] =
      tire_to_json(spec.tire, spec.scenario->has_rig() ? spec.tire.parameters_on(spec.rig.cooling_rig(), spec.baseline)
                                                       : spec.tire.values);
  if (spec.scenario->has_rig()) manifest["rig"] = rig_to_json(spec.rig);
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

std::string make_recording_csv(const sim::Recording<double>& recording) {
  std::vector<std::string> columns{"time_s", "phase"};
  std::vector<Unit> units;
  for (const sim::Channel& channel : recording.channels) {
    columns.push_back(channel.quantity.header());
    units.push_back(channel.quantity.file_unit());
  }
  CsvWriter csv(columns);
  for (std::size_t row = 0; row < recording.row_count(); ++row) {
    csv.add(recording.time_s[row]);
    csv.add(recording.phases[recording.phase[row]].name);
    for (std::size_t i = 0; i < units.size(); ++i) csv.add(units[i].from_si(recording.values[i][row]));
    csv.end_row();
  }
  return csv.take();
}

}  // namespace rollrig::scenarios
