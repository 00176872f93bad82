#pragma once
/// Several measurement sets at once: one table, and which effects come back from set to set.

#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "diagnosis/output/recurrences.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig::diagnosis {

struct Fleet {
  std::vector<FleetMember> members;
  std::vector<Recurrence> recurrences;
};

/// Diagnoses every set of a folder, several at a time. A set that cannot be read and a diagnosis that fails are noted,
/// and the others go on.
/// Errors  InputError: no set can be read; an unknown effect in `options`
Fleet diagnose_fleet(const std::vector<std::string>& folders, const DiagnosisOptions& options);

/// A row a set: verdict, cause, gap before and after.
Table make_fleet_table(const Fleet& fleet);

/// This table, then what failed, what is in doubt, and what comes back; 80 columns but for places in files.
std::string format_fleet(const Fleet& fleet);

/// rollrig-fleet/1: `sets` (each `folder`, `machine`, `tire`, `failure`, `diagnosis` as of one set), `recurring`.
Json make_fleet_json(const Fleet& fleet);

}  // namespace rollrig::diagnosis
