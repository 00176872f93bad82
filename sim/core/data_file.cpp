#include "sim/core/data_file.h"

#include <fmt/format.h>

#include <filesystem>

namespace fs = std::filesystem;

namespace rollrig {

std::string place_data_file(const TableReader& reader, const std::string& key, const std::string& folder,
                            const std::string& name) {
  const fs::path named = fs::path(name).lexically_normal();
  if (named.is_absolute() || (!named.empty() && *named.begin() == "..")) {
    throw reader.problem(key, fmt::format("'{}' is not in the folder of the data", name),
                         fmt::format("a path below '{}'; copy the file there", folder.empty() ? "." : folder));
  }
  return (fs::path(folder) / name).string();
}

}  // namespace rollrig
