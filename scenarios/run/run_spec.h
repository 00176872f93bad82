#pragma once
/// From a run document (a file, or the command line's options) to a RunSpec, and from a run to its files.

#include <map>
#include <string>

#include "scenarios/run/scenario.h"

namespace rollrig::scenarios {

/// Reads a run document ("rollrig-run/1"): scenario, tire, rig, fidelity, baseline, seed, sensors,
/// [settings], [effects.<id>], [override.tire...], [override.rig...]. Paths in it are relative to
/// `base_folder`. Throws InputError.
RunSpec read_run_spec(const ConfigTable& document, const std::string& base_folder);

/// A document with nothing but a scenario, for the command line to fill.
ConfigTable make_run_document(const std::string& scenario);

/// Sets one `key=value` of --set: a key with a first part of tire, rig or effects goes there, any other
/// is a setting of the scenario. Throws InputError when there is no '='.
void set_run_value(ConfigTable& document, const std::string& assignment);

/// Everything that went into a run, defaults included: files with their SHA-256, all parameters, versions.
Json make_manifest(const RunSpec& spec, const Outcome& outcome);

/// result.json of formats.md.
Json make_result_json(const RunSpec& spec, const Outcome& outcome);

/// The recording as CSV text: time, phase, channels in the units of their names.
std::string make_recording_csv(const sim::Recording<double>& recording);

/// The files of a set with the runs that `outcome` marks: set.toml, tire.toml, rig.toml (of the road: vehicle.toml) and
/// one CSV a run, its fields left empty where formats.md has no sample. For a scenario that writes sets.
std::map<std::string, std::string> write_measurement_set(const RunSpec& spec, const Outcome& outcome,
                                                         const std::string& name);

const char* name_of(Fidelity fidelity);
const char* name_of(models::Baseline baseline);

}  // namespace rollrig::scenarios
