#include "validation/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"

namespace fs = std::filesystem;

namespace rollrig::validation {
namespace {

constexpr const char* kMade = "a folder made by rollrig_validation make, with its cases in sets/";

/// The hash that truth.json must have. Throws InputError.
std::string find_hash(const fs::path& set, const std::string& given) {
  constexpr std::size_t kDigits = 64;
  const fs::path old = set / "seal.sha256";
  const std::string file = (fs::exists(old) ? old : set / "truth.sha256").string();
  if (given.empty() && !fs::exists(file)) {
    throw InputError({fmt::format("'{}' has no truth.sha256", set.string()), file, 0, "", "",
                      "--hash and the SHA-256 that was printed when the validation set was made", ""});
  }
  const std::string hash =
      boost::algorithm::to_lower_copy(given.empty() ? read_text_file(file).substr(0, kDigits) : given);
  if (hash.size() == kDigits && hash.find_first_not_of("0123456789abcdef") == std::string::npos) return hash;
  throw InputError({"a hash that is no SHA-256", given.empty() ? file : "command line", 0,
                    given.empty() ? "" : "--hash", hash, "64 hexadecimal digits", ""});
}

}  // namespace

std::string read_bytes(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

std::vector<std::string> list_cases(const std::string& set) {
  const fs::path folder = fs::path(set) / "sets";
  std::vector<std::string> numbers;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_directory()) numbers.push_back(entry.path().filename().string());
    }
  }
  if (numbers.empty()) throw InputError({fmt::format("no cases in '{}'", folder.string()), set, 0, "", "", kMade, ""});
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::string case_folder(const std::string& set, const std::string& number) {
  return (fs::path(set) / "sets" / number).string();
}

std::string hash_files(const std::map<std::string, std::string>& files) {
  std::string all;
  for (const auto& [name, content] : files) all += fmt::format("{}  {}\n", calc_sha256(content), name);
  return calc_sha256(all);
}

std::string hash_case(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), folder).generic_string()] = read_bytes(entry.path().string());
  }
  return hash_files(files);
}

TruthFile open_truth(const std::string& set, const std::string& hash, const char* format) {
  const std::string file = (fs::path(set) / "truth.json").string();
  if (!fs::exists(file)) throw InputError({fmt::format("no file '{}'", file), set, 0, "", "", kMade, ""});
  const std::string text = read_text_file(file);
  TruthFile opened{{}, calc_sha256(text)};
  const std::string expected = find_hash(set, hash);
  if (opened.sha256 != expected) {
    throw InputError({"truth.json is not the file that was made: it has another hash", file, 0, "SHA-256",
                      opened.sha256, expected, ""});
  }
  try {
    const Json json = parse_json(text, file);
    if (json.at("format") == format) opened.cases = json.at("sets");
  } catch (const Json::exception&) {  // said below
  }
  if (opened.cases.is_object()) return opened;
  throw InputError({"not the truth of a validation set", file, 0, "format", "", format, ""});
}

bool lies_within(const std::string& path, const std::string& folder) {
  const auto place = [](const std::string& of) {
    const fs::path whole = fs::weakly_canonical(fs::absolute(of));
    return whole.filename().empty() ? whole.parent_path() : whole;
  };
  const fs::path relative = place(path).lexically_relative(place(folder));
  return !relative.empty() && *relative.begin() != "..";
}

void require_new_folder(const std::string& path, const std::string& option) {
  if (!fs::exists(path) || (fs::is_directory(path) && fs::is_empty(path))) return;
  throw InputError({fmt::format("'{}' is there already", path), "", 0, option, path, "an empty or new folder", ""});
}

}  // namespace rollrig::validation
