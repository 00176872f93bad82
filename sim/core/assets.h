#pragma once
/// Finding files by name or path: tires, rigs, vehicles, cycles, sensors.

#include <string>
#include <vector>

#include "sim/core/schema.h"

namespace rollrig {

/// Folder of the assets: $ROLLRIG_ASSETS, else share/rollrig/assets of the prefix in which the program is installed or,
/// for a program of others, the library; else that of the source tree from which it was built.
std::string find_assets_folder();

/// The file of an asset: `name_or_path` is a path when it holds a '/' or ends as the folder's files do
/// (".csv" for cycles, ".toml" for the rest), else a name under assets/<folder>. Throws InputError with the nearest
/// known name.
std::string find_asset(const std::string& folder, const std::string& name_or_path);

/// The same, with paths taken relative to `base_folder` (for names inside a file).
std::string find_asset_from(const std::string& base_folder, const std::string& folder, const std::string& name_or_path);

/// The same for what a key of a file says; the file must be there. Throws InputError that names the key's place.
std::string find_asset_of(const TableReader& reader, const std::string& key, const std::string& base_folder,
                          const std::string& folder, const std::string& name_or_path);

/// Names under assets/<folder>, without their ending, sorted.
std::vector<std::string> list_assets(const std::string& folder);

}  // namespace rollrig
