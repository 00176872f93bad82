#pragma once
/// The document of `rollrig diagnose --json`.

#include "diagnosis/diagnosis.h"
#include "sim/core/json.h"

namespace rollrig::diagnosis {

/// The word of a verdict in files: no_gap, explained, unexplained.
const char* name_of(Verdict verdict);
/// The verdict of such a word. Throws InputError.
Verdict read_verdict(const std::string& word);

/// A diagnosis as formats.md has it (rollrig-diagnosis/1). What does not exist is null: the shrinkage of a
/// gap that is not above the noise, a number that is not finite.
/// Checked tests/diagnosis/diagnosis_json_test.cpp
Json make_diagnosis_json(const Findings& findings);

/// Reads from such a document: set, verdict, probability, nothing_detectable, causes (without companions and partners),
/// trace, of the gap as_calibrated, recalibrated and shrink_percent, where, next_tests, warnings. A number that is null
/// becomes NaN. Throws Json::exception or InputError where it is no such document.
Findings read_diagnosis_json(const Json& json);

}  // namespace rollrig::diagnosis
