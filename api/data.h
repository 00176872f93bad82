#pragma once
/// What objects of the API hold, and how its inputs and results are converted.

#include <map>
#include <string>

#include "measurements/logs/mapping.h"
#include "measurements/measurement_set.h"
#include "rollrig/measurement_set.h"
#include "rollrig/run.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/json.h"

namespace rollrig {

struct MeasurementSet::Data {
  measurements::MeasurementSet set;
};

/// Values in SI units as a channel of the API has them.
Channel make_channel(const Quantity& quantity, std::vector<double> values_SI);

/// Files by their names as the API has them.
inline FolderFiles to_folder(const std::map<std::string, std::string>& files) { return {files.begin(), files.end()}; }

/// What import_logs() does with a mapping that has been read.
Report import_by_mapping(const measurements::Mapping& mapping, BadRows bad_rows, const Progress& progress);

/// Whether a text names a file, and not an asset or a scenario: it has a '/', or ends in .toml.
bool is_file_name(const std::string& text);
/// A path that a program gives, which is relative to the working folder; the name of an asset as it is.
std::string absolute_if_path(const std::string& name);

/// Reads what `input` names. Throws InputError.
scenarios::RunSpec read_run(const RunInput& input);

}  // namespace rollrig
