#pragma once
/// A diagnosis in a loop with the machine, a step at a time. Its state is a folder: loop.json, and test-<n>/ for each
/// test.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "diagnosis/loop/ledger.h"

namespace rollrig::diagnosis {

using rollrig::LoopInput;

/// Hours that a loop may have, and has unless told otherwise.
constexpr double kLeastLoop_h = 0.5;
constexpr double kMostLoop_h = 1000.0;
constexpr double kUsualLoop_h = 8.0;

struct LoopStep {
  LoopLedger ledger;
  measurements::MeasurementSet set;    // that the loop began with, and the runs of all tests that were measured
  std::optional<Diagnosis> diagnosis;  // none where nothing new was measured
  std::vector<std::string> missing;    // files of the planned test
};

/// As rollrig::advance_loop(). The folder of a test is a measurement set of its own, whose runs join those of the first
/// set; the test's folder is written before the ledger, so that a step that was cut short is done again.
/// Checked  tests/cli/loop_test.cpp
LoopStep advance_loop(const LoopInput& input);

/// What a diagnosis says after the tests of a ledger.
LoopAnswer make_answer(const LoopLedger& ledger, const Diagnosis& found);
/// Whether it ends the loop: explained by one cause alone, at 95 % or more.
bool is_named(const LoopAnswer& answer);
/// A test whose runs have names that no other run of the loop has, in a session of their own.
ProposedTest rename_runs(ProposedTest test, std::size_t number);

/// What a step says to a person: the answers so far, what is planned or why the loop has ended.
std::string format_loop(const LoopStep& step, const std::string& folder);

}  // namespace rollrig::diagnosis
