#pragma once
/// Loops of tests on the cases of a validation set, with the generator as the rig.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/loop/ledger.h"
#include "validation/scoring/truth.h"

namespace rollrig::validation {

struct LoopOrder {
  std::string set;
  double hours = 8.0;
  double failing_share = 0.05;  // of tests that fail, drawn; their hours are gone
  bool drawn = false;           // each test that could be done is as likely, instead of the best
  std::uint64_t seed = 1;       // of failures and of drawn tests
  int threads = 0;
  std::function<void(std::size_t done, std::size_t of)> progress = {};
};

/// The loop of one case.
struct LoopOfCase {
  Truth truth;
  std::string kind;  // of its machine
  diagnosis::LoopLedger ledger;
  double slowest_step_s = 0.0;
  std::string failure;  // why it could not go on; empty where it could

  bool is_named() const { return ledger.state == diagnosis::LoopState::kNamed; }
  /// Whether what is named is what is true, nothing missing and nothing beside it.
  bool is_right() const;
  /// The same at so many hours: of the loop, the test that ended it has been done by then.
  bool is_right_by(double hours) const { return is_right() && ledger.answers.back().hours <= hours; }
};

/// Does the loop on every case: diagnosis, the proposed test done by the generator on the same specimen in a new
/// session, and so on until a cause is named, the hours are gone, or nothing is left to test. The truth is opened by
/// the generator alone, and here after a loop has ended. A function of set, truth and order.
/// Errors  InputError: as read_truths()
/// Checked tests/validation/loop_cases_test.cpp
std::vector<LoopOfCase> loop_cases(const LoopOrder& order);

}  // namespace rollrig::validation
