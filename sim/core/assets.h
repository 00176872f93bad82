#pragma once
/// Finding files by name or path: tires, rigs, vehicles, cycles, sensors.

#include <string>

#include "include/rollrig/assets.h"
#include "sim/core/schema.h"

namespace rollrig {

/// The name that an asset has now: `name`, or what replaced it where it is a former one.
std::string find_present_name(const std::string& folder, const std::string& name);

/// find_asset() with paths taken relative to `base_folder` (for names inside a file).
std::string find_asset_from(const std::string& base_folder, const std::string& folder, const std::string& name_or_path);

/// The same for what a key of a file says; the file must be there. Throws InputError that names the key's place.
std::string find_asset_of(const TableReader& reader, const std::string& key, const std::string& base_folder,
                          const std::string& folder, const std::string& name_or_path);

}  // namespace rollrig
