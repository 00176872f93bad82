#include "comparison/result_folder.h"

#include <fmt/format.h>

#include <filesystem>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"

namespace fs = std::filesystem;

namespace rollrig::comparison {
namespace {

constexpr const char* kResultFile = "result.json";

/// A JSON file of a format, with members that are objects.
Json read_document(const std::string& path, const std::string& format, const std::vector<const char*>& members) {
  Json document = read_json(path);
  const Json found = document.is_object() ? document.value("format", Json()) : Json();
  if (found != format) {
    throw InputError({"this is no file that rollrig run --out writes", path, 0, "format",
                      found.is_string() ? found.get<std::string>() : "", format, ""});
  }
  for (const char* member : members) {
    if (document.contains(member) && document[member].is_object()) continue;
    throw InputError(
        {"the file was changed or is damaged", path, 0, member, "", "a file as rollrig run --out writes it", ""});
  }
  return document;
}

}  // namespace

std::string ResultFolder::file_of(const char* name) const { return (fs::path(path) / name).string(); }

bool holds_result(const std::string& folder) { return is_there((fs::path(folder) / kResultFile).string()); }

ResultFolder read_result_folder(const std::string& folder) {
  ResultFolder found;
  found.path = folder;
  found.result = read_document(found.file_of(kResultFile), "rollrig-result/1", {"result", "energy"});
  found.manifest = read_document(found.file_of("manifest.json"), "rollrig-manifest/1", {"settings", "tire"});
  found.recording = CsvTable::read(found.file_of("recording.csv"));
  return found;
}

}  // namespace rollrig::comparison
