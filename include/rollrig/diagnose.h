#pragma once
/// Why a measurement and the simulation differ: where, by which unmodeled effect, and how far the gap
/// shrinks once that effect is added. Method: docs/how_the_diagnosis_reasons.md.

#include <functional>
#include <string>
#include <vector>

#include "findings.h"
#include "measurement_set.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// The diagnosis of one set; as a report without files.
struct Diagnosis : Findings, Report {
  std::function<FolderFiles()> make_plan;  // the first test as files for `rollrig run`, with plan.txt for a person;
                                           // none where no test is proposed
};

/// The diagnosis of a measurement set of any kind, against either baseline. Takes minutes; the answer does not depend
/// on the number of threads.
/// Errors  InputError: a file lacks what the set's kind needs; an unknown effect; nothing measured.
///         RunFailure: no fit converges
Diagnosis diagnose(const MeasurementSet& set, const DiagnosisOptions& options = {});

/// Several sets, and which effects come back with a machine or a tire; as a report without files.
struct FleetDiagnosis : Report {
  std::vector<FleetMember> members;
};

/// Diagnoses several sets. One that cannot be read or diagnosed is noted, and the others go on.
/// Errors  InputError: no set can be read; an unknown effect
FleetDiagnosis diagnose_fleet(const std::vector<std::string>& folders, const DiagnosisOptions& options = {},
                              BadRows bad_rows = BadRows::kRefuse);

/// What an effect is, how it is found, with what it is confused; also of "none" and "unknown". Text as wide as the
/// terminal.
/// Throws InputError with the nearest name.
std::string explain_effect(const std::string& name);
/// Names that it takes.
std::vector<std::string> explainable_names();
/// Names that DiagnosisOptions::only and ::without take.
std::vector<std::string> comparable_names();
/// Checks names of effects, as all functions that take DiagnosisOptions do first; diagnose_pair() allows more effects.
/// Throws InputError: an effect that is not among comparable_names(), with the nearest; one that is in both lists.
void require_comparable_effects(const std::vector<std::string>& only, const std::vector<std::string>& without);

}  // namespace rollrig
#pragma GCC visibility pop
