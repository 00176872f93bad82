#pragma once
/// Simulated runs as a measurement set.

#include <map>
#include <string>

#include "scenarios/run/scenario.h"

namespace rollrig::scenarios {

/// The files of a set with the runs that `outcome` marks: set.toml, tire.toml, rig.toml (of the road: vehicle.toml) and
/// one CSV a run, its fields left empty where formats.md has no sample. For a scenario that writes sets.
std::map<std::string, std::string> write_measurement_set(const RunSpec& spec, const Outcome& outcome,
                                                         const std::string& name);

}  // namespace rollrig::scenarios
