#pragma once
/// Scenarios, effects, and the assets that a name stands for: tires, rigs, vehicles, cycles, sensors.

#include <string>
#include <vector>

#pragma GCC visibility push(default)
namespace rollrig {

/// Folder of the assets: $ROLLRIG_ASSETS, else share/rollrig/assets of the prefix in which the library or else the
/// program is installed; else that of the source tree from which it was built.
std::string find_assets_folder();

/// The file of an asset: `name_or_path` is a path when it holds a '/' or ends as the folder's files do
/// (".csv" for cycles, ".toml" for the rest), else a name under assets/<folder>. Throws InputError with the nearest
/// known name.
std::string find_asset(const std::string& folder, const std::string& name_or_path);

/// Names under assets/<folder>, without their ending, sorted.
std::vector<std::string> list_assets(const std::string& folder);

/// The folders of assets.
const std::vector<std::string>& asset_folders();

/// A scenario or an effect.
struct Listed {
  std::string name;
  std::string summary;  // a sentence
};
std::vector<std::string> names_of(const std::vector<Listed>& listed);
std::vector<Listed> list_scenarios();
std::vector<Listed> list_effects();

/// What a scenario, an effect or an asset is, with its settings or parameters: text as wide as the terminal, of an
/// asset its file. A name with a '/', or that ends in .toml or .csv, is the path of a file, or of the folder of a set.
/// Throws InputError with the nearest known name.
std::string describe(const std::string& name);

}  // namespace rollrig
#pragma GCC visibility pop
