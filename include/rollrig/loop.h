#pragma once
/// A diagnosis in a loop with the machine: which test next, its measurement taken in, until a cause is named or the
/// hours are gone. Method: docs/test_loop.md.

#include <optional>
#include <string>
#include <vector>

#include "bad_rows.h"
#include "findings.h"
#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

enum class LoopState {
  kWaiting,       // for the measurement of the last test
  kNamed,         // a cause or a trace has at least 95 %
  kHoursGone,     // 0.6 h or less are left, too little for any test
  kNothingToTest  // no test that fits into the hours left would tell more
};

enum class LoopTestState { kPlanned, kMeasured, kFailed };

/// A test of a loop.
struct LoopTest {
  std::string id;    // in the menu of tests
  std::string test;  // in words
  double hours = 0.0;
  double expected_bits_per_hour = 0.0;
  double naming_chance = 0.0;  // of a cause at 95 % within the hours, as it was expected when the test was planned
  std::vector<std::string> splits;
  std::vector<std::string> runs;  // ids
  LoopTestState state = LoopTestState::kPlanned;
};

/// What the diagnosis says after so many tests.
struct LoopAnswer {
  std::size_t tests = 0;  // of the loop before it, failed ones included
  double hours = 0.0;     // that they took
  Verdict verdict = Verdict::kNoGap;
  std::vector<std::string> effects;  // of the first cause; empty where there is none
  std::vector<std::string> indistinguishable_from;
  double probability = 0.0;                    // of the first cause
  double none = 0.0;                           // of no effect
  double unknown = 0.0;                        // of an effect that is not in the catalog
  std::optional<double> alone = std::nullopt;  // that the first cause acts and nothing else of the catalog does
  std::optional<double> nothing_detectable = std::nullopt;  // as in Findings
  bool is_trace = false;                                    // the first cause is too small to matter: there is no gap
};

/// The record of a loop, as loop.json has it (rollrig-loop/1).
struct LoopLedger {
  std::string set;         // folder of the set that it began with
  std::string set_sha256;  // of its files, with tire and machine
  double hours = 0.0;      // of the machine, at most
  std::vector<std::string> only;
  std::vector<std::string> without;
  std::vector<LoopTest> tests;
  std::vector<LoopAnswer> answers;
  LoopState state = LoopState::kWaiting;
};

struct LoopInput {
  std::string set;                      // folder of a measurement set
  std::string folder;                   // of the loop; made where it is not there
  std::optional<double> hours;          // none: those of the loop; of a new one 8
  bool test_failed = false;             // the planned test could not be done: its hours are gone all the same
  BadRows bad_rows = BadRows::kRefuse;  // of all sets
  DiagnosisOptions diagnosis = {};      // its budget is that of the loop
};

/// As a report without files: those of a planned test are in the loop's folder.
struct Loop : LoopLedger, Report {
  std::vector<std::string> missing;  // files of the planned test that are waited for
};

/// Goes one step on: takes in what the planned test measured, diagnoses all that is measured, and plans the next test
/// in <folder>/test-<n>: run files, plan.txt, and a set.toml for what it measures. Where files of the planned test are
/// missing, nothing is done. Calling it again after an interruption gives the same.
/// Errors  InputError: as diagnose(); a set that has changed since the loop began; other effects than the loop's; hours
///         out of range; a failed test where none is planned
Loop advance_loop(const LoopInput& input);

}  // namespace rollrig
#pragma GCC visibility pop
