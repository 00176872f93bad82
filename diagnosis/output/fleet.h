#pragma once
/// Several measurement sets at once: one table, and which effects come back from set to set.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "diagnosis/output/recurrences.h"
#include "sim/core/error.h"
#include "sim/core/json.h"

namespace rollrig::diagnosis {

/// One set of a fleet.
struct FleetMember {
  std::string folder;   // as named to the program
  std::string machine;  // name of its rig or vehicle; empty where the set cannot be read, as is
  std::string tire;     // its name
  std::optional<Diagnosis> diagnosis;
  std::string failure;                  // why there is none
  std::optional<InputProblem> problem;  // of the input, where that is why
};

struct Fleet {
  std::vector<FleetMember> members;
  std::vector<Recurrence> recurrences;
};

/// Folders right in `folder` that hold a set.toml, sorted by name; none where `folder` is a set itself.
std::vector<std::string> find_sets(const std::string& folder);

/// Folders right in `folder` that hold CSV files and no set.toml, sorted by name: sets that one forgot to describe.
std::vector<std::string> find_undescribed_folders(const std::string& folder);

/// Diagnoses every set of a folder, several at a time. A set that cannot be read and a diagnosis that fails are noted,
/// and the others go on.
/// Errors  InputError: no set can be read; an unknown effect in `options`
Fleet diagnose_fleet(const std::vector<std::string>& folders, const DiagnosisOptions& options);

/// One line a set, then what failed, what is in doubt, and what comes back; 80 columns but for places in files.
std::string format_fleet(const Fleet& fleet);

/// rollrig-fleet/1: `sets` (each `folder`, `machine`, `tire`, `failure`, `diagnosis` as of one set), `recurring`.
Json make_fleet_json(const Fleet& fleet);

}  // namespace rollrig::diagnosis
