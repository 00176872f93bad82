#pragma once
/// A folder that a run wrote: result.json, manifest.json, recording.csv.

#include <string>
#include <vector>

#include "sim/core/csv.h"
#include "sim/core/json.h"

namespace rollrig::comparison {

struct ResultFolder {
  std::string path;
  Json result;    // result.json
  Json manifest;  // manifest.json
  CsvTable recording;

  std::string file_of(const char* name) const;
};

/// Whether a folder has a result.json.
bool holds_result(const std::string& folder);

/// Throws InputError: a file that is missing, damaged or of another format.
ResultFolder read_result_folder(const std::string& folder);

}  // namespace rollrig::comparison
