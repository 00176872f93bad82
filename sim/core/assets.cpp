#include "sim/core/assets.h"

#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

/// Cycles are time series, everything else is TOML.
std::string extension_of(const std::string& folder) { return folder == "cycles" ? ".csv" : ".toml"; }

bool is_path(const std::string& folder, const std::string& name) {
  return name.find('/') != std::string::npos || fs::path(name).extension() == extension_of(folder);
}

/// The shared library of rollrig that this program has loaded; empty when there is none.
fs::path find_library() {
  fs::path library;
  const auto visit = [](dl_phdr_info* info, std::size_t, void* found) {
    const fs::path path = info->dlpi_name;
    if (path.filename().string().rfind("librollrig_cvodes", 0) != 0) return 0;
    *static_cast<fs::path*>(found) = path;
    return 1;
  };
  ::dl_iterate_phdr(visit, &library);
  return library;
}

/// The assets of the prefix under which a program or a library is installed; empty when there are none.
std::string find_installed_assets(const fs::path& binary) {
  constexpr int kDeepest = 2;  // lib/<architecture>/<library>
  std::error_code code;
  fs::path folder = fs::canonical(binary, code);
  for (int i = 0; !code && i < kDeepest; ++i) {
    folder = folder.parent_path();
    const fs::path assets = folder.parent_path() / "share" / "rollrig" / "assets";
    if (fs::is_directory(assets)) return assets.string();
  }
  return {};
}

}  // namespace

std::string find_assets_folder() {
  if (const char* set = std::getenv("ROLLRIG_ASSETS")) return set;
  // The library first: the program of a script is the interpreter, beside which another version may be installed.
  for (const fs::path& binary : {find_library(), fs::path("/proc/self/exe")}) {
    std::string assets = find_installed_assets(binary);
    if (!assets.empty()) return assets;
  }
  return ROLLRIG_DEFAULT_ASSETS;
}

std::vector<std::string> list_assets(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(fs::path(find_assets_folder()) / folder, code)) {
    if (entry.path().extension() == extension_of(folder)) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string find_present_name(const std::string& folder, const std::string& name) {
  static const std::map<std::string, std::string> former{{"rigs/flat", "road"}};
  const auto renamed = former.find(folder + "/" + name);
  return renamed != former.end() ? renamed->second : name;
}

namespace {

/// Throws InputError where ROLLRIG_ASSETS names a folder that has no such assets at all.
void require_assets_of_variable(const std::string& folder) {
  const char* set = std::getenv("ROLLRIG_ASSETS");
  if (set == nullptr || !list_assets(folder).empty()) return;
  throw InputError({fmt::format("the folder '{}' of the variable ROLLRIG_ASSETS has no {}", set, folder), "", 0,
                    "ROLLRIG_ASSETS", set,
                    fmt::format("a folder that has {}/*{}; or unset the variable", folder, extension_of(folder)), ""});
}

}  // namespace

std::string find_asset_from(const std::string& base_folder, const std::string& folder,
                            const std::string& name_or_path) {
  if (is_path(folder, name_or_path)) return (fs::path(base_folder) / name_or_path).lexically_normal().string();
  const std::string name = find_present_name(folder, name_or_path);
  const fs::path file = fs::path(find_assets_folder()) / folder / (name + extension_of(folder));
  std::error_code code;  // a name that is too long for a file names none
  if (fs::exists(file, code)) return file.string();
  require_assets_of_variable(folder);
  InputProblem problem = unknown_name(folder.substr(0, folder.size() - 1), name_or_path, list_assets(folder));
  problem.allowed += fmt::format("; or a path to a {} file", extension_of(folder));
  throw InputError(problem);
}

std::string find_asset(const std::string& folder, const std::string& name_or_path) {
  return find_asset_from("", folder, name_or_path);
}

std::string find_asset_of(const TableReader& reader, const std::string& key, const std::string& base_folder,
                          const std::string& folder, const std::string& name_or_path) {
  std::string path;
  try {
    path = find_asset_from(base_folder, folder, name_or_path);
  } catch (const InputError& error) {
    InputProblem at_key = reader.problem(key, error.problem().what, error.problem().allowed).problem();
    at_key.nearest = error.problem().nearest;
    throw InputError(at_key);
  }
  if (!is_there(path)) {
    InputProblem missing = reader
                               .problem(key, fmt::format("no such file '{}'", path),
                                        fmt::format("a name under assets/{}, or a path relative to this file", folder))
                               .problem();
    missing.nearest = nearest_file(path);
    throw InputError(missing);
  }
  return path;
}

}  // namespace rollrig
