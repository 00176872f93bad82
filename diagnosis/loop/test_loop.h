#pragma once
/// Diagnosis and test in turn, one step for each call. The state between the calls is a folder: loop.json, and
/// test-<n>/ for each test.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "diagnosis/loop/ledger.h"

namespace rollrig::diagnosis {

using rollrig::LoopInput;

/// Hours of a loop, unless told otherwise.
constexpr double kUsualLoop_h = 8.0;

struct LoopStep {
  LoopLedger ledger;
  measurements::MeasurementSet set;    // the set that the loop began with, and the runs of all measured tests
  std::optional<Diagnosis> diagnosis;  // none if this step diagnosed nothing
  std::vector<std::string> missing;    // files of the planned test that are not there yet
};

/// As rollrig::advance_loop(). The folder of a test is a measurement set of its own, whose runs join those of the first
/// set. The folder of the next test is written before the ledger, so that a step that was interrupted is repeated.
/// Checked  tests/cli/loop_test.cpp
LoopStep advance_loop(const LoopInput& input);

/// The entry of the ledger for a diagnosis after all of its tests so far.
LoopAnswer make_answer(const LoopLedger& ledger, const Diagnosis& found);
/// Whether one cause is at 95 % or more, and cannot be mistaken for another; of a trace (a cause that is too small to
/// matter) as well.
bool is_named(const LoopAnswer& answer);
/// Whether a loop ends while there are hours left: a cause is named (is_named) and acts alone with a probability of at
/// least 90 %, or a trace is named.
bool is_settled(const LoopAnswer& answer);
/// How a loop ends for which no test is found: whether hours are left.
LoopState find_end_without_test(const LoopLedger& ledger);
/// The same test with run ids and sessions that no other test of the loop has: "test-<number>-...".
ProposedTest rename_runs(ProposedTest test, std::size_t number);

/// For a terminal: the answers so far, and what is planned or why the loop has ended.
std::string format_loop(const LoopStep& step, const std::string& folder);

}  // namespace rollrig::diagnosis
