#pragma once
/// Loops of tests on the cases of a validation set, with the generator as the rig.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/loop/ledger.h"
#include "validation/scoring/truth.h"

namespace rollrig::validation {

/// Which tests a loop does: those that the diagnosis proposes; drawn at random from those that fit; or those of the
/// campaign that is planned before anything is measured (diagnosis::plan_campaign()), one after the other.
enum class LoopTests { kProposed, kDrawn, kFixed };
inline const std::vector<std::string> kLoopTestsNames{"proposed", "drawn", "fixed"};

struct LoopOrder {
  std::string set;
  double hours = 8.0;
  double failing_share = 0.05;  // probability that a test fails; its hours count as used
  LoopTests tests = LoopTests::kProposed;
  bool with_ideal = false;  // also what an ideal observer makes of the same tests
  std::uint64_t seed = 1;   // of failures and of drawn tests
  int threads = 0;
  std::function<void(std::size_t done, std::size_t of)> progress = {};
};

/// The loop of one case.
struct LoopOfCase {
  Truth truth;
  std::string kind;  // of its machine
  diagnosis::LoopLedger ledger;
  std::vector<bool> separable;  // by an ideal observer, beside each answer; empty if not asked for, or without effect
  double slowest_step_s = 0.0;
  std::string failure;  // why the loop ended with an error; else empty

  bool names_truth(const diagnosis::LoopAnswer& answer) const;
  bool is_named() const { return ledger.state == diagnosis::LoopState::kNamed; }
  /// Whether the loop named exactly the true effects.
  bool is_right() const;
  /// Whether the last answer within these hours of the machine named the true effects and no other.
  bool is_right_by(double hours) const;
  /// Whether an ideal observer could separate them from all else within these hours.
  bool is_separable_by(double hours) const;
};

/// Runs the loop on every case: diagnosis, then a test, simulated by the generator for the same specimen in a new
/// session, and so on until a cause is named or no test is left that fits into the hours and would tell more (the state
/// is then kNothingToTest). With LoopTests::kFixed, a loop also ends after the last test of the campaign. Only the
/// generator uses the truth, and the score after a loop has ended. The result depends on set, truth and order alone.
/// Errors  InputError: as read_truths()
/// Checked tests/validation/loop_cases_test.cpp
std::vector<LoopOfCase> loop_cases(const LoopOrder& order);

}  // namespace rollrig::validation
