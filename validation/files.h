#pragma once
/// A validation set on disk: a folder of cases, each a measurement set, and the truth about them with its hash.

#include <map>
#include <string>
#include <vector>

#include "sim/core/json.h"

namespace rollrig::validation {

// Formats of the files that the generator and the scoring exchange. They keep their first names: the SHA-256 that were
// published with the results of a seed (validation/results) cover them.
constexpr const char* kTruthFormat = "rollrig-blind-bank/1";
constexpr const char* kPairsTruthFormat = "rollrig-validation-pairs/1";
constexpr const char* kPlanFormat = "rollrig-blind-plan/1";
constexpr const char* kUpperBoundFormat = "rollrig-blind-ceiling/1";
constexpr const char* kLocationsFormat = "rollrig-validation-locations/1";

// In a validation set: plans of follow-up tests, and the cases made by them.
constexpr const char* kFollowUpFolder = "followup";
constexpr const char* kDrawnFollowUpFolder = "followup-drawn";  // tests drawn from the menu

/// Whatever is in a file; nothing where it cannot be read.
std::string read_bytes(const std::string& file);

/// Numbers of the cases, which are the folders in <set>/sets, sorted. Throws InputError where there is none. Opens no
/// file.
std::vector<std::string> list_cases(const std::string& set);

/// Folder of a case.
std::string case_folder(const std::string& set, const std::string& number);

/// SHA-256 over names and contents of files.
std::string hash_files(const std::map<std::string, std::string>& files);
/// The same of all files of a case.
std::string hash_case(const std::string& folder);

/// What truth.json of a validation set says.
struct TruthFile {
  Json cases;  // by number
  std::string sha256;
};

/// Opens the truth.
/// Errors  InputError: no such file; its SHA-256 is not `hash`, or where that is empty not that of truth.sha256, in
///         older sets seal.sha256; not the truth of a validation set
TruthFile open_truth(const std::string& set, const std::string& hash, const char* format = kTruthFormat);

/// Whether `path` lies in `folder`; neither need be there.
bool lies_within(const std::string& path, const std::string& folder);

/// Throws InputError where `path` is there and is no empty folder.
void require_new_folder(const std::string& path, const std::string& option);

}  // namespace rollrig::validation
