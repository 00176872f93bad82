#pragma once
/// What lies in a dropped folder, and what the columns of its logs are taken to be.

#include <cstdint>
#include <string>
#include <vector>

#include "rollrig/scaffold_options.h"
#include "sim/core/json.h"

namespace rollrig::serve {

struct DroppedFile {
  std::string name;  // below the folder
  std::string kind;  // "tire", "rig", "vehicle", "sensors", "set", "mapping", "log", "other"
  std::uint64_t bytes = 0;
};

/// The files in order of their names; a TOML file by the format that it states.
std::vector<DroppedFile> list_dropped_files(const std::string& folder);

/// {headings: [{name, unit, examples}], targets: [{name, unit, doc, is_needed}], columns: [{target, heading, unit,
/// value, reason}], guesses: [{subject, taken, reason}], problem}: what the logs hold, what a set of this machine
/// takes, and what was guessed; where the logs do not tell something, the problem names it and the rest stays.
Json guess_columns_json(const GuessOptions& options, const std::string& private_part);

}  // namespace rollrig::serve
