#pragma once
/// The test that a diagnosis proposes for a case of which it cannot tell the causes apart: planned for the generator,
/// the truth unopened, and read back once it was done.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/next_test/test_menu.h"
#include "validation/scoring/answer.h"

namespace rollrig::validation {

struct Case;

/// Which test of the menu is done.
enum class Choice { kProposed, kDrawn };
/// Folder in a validation set with the plans of a choice, and then with the cases.
const char* folder_of(Choice choice);

/// Why the generator cannot do a test; empty where it can.
std::string find_obstacle(const diagnosis::PlannedTest& test);

/// Tests of a case for the generator, by file name: plan.json (rollrig-blind-plan/1) and a CSV for each of their runs.
std::map<std::string, std::string> write_generator_plan(const std::string& number, const std::string& set_sha256,
                                                        const measurements::MeasurementSet& set,
                                                        const std::vector<diagnosis::ProposedTest>& tests);

/// What an answer names: the first cause's effects and all that it cannot be told from.
std::vector<std::string> list_named(const diagnosis::Diagnosis& diagnosis);

/// The next test of one case.
struct FollowUpPlan {
  std::string number;
  std::string set_sha256;
  std::vector<std::string> named;  // by the answer
  std::string test;                // its description; empty where none is proposed
  std::string not_made;            // why the generator does not do it; empty where it does
};

struct FollowUp {
  FollowUpPlan plan;
  std::optional<Answer> answer;  // to the case with the test's runs

  /// Whether the answer that proposes it says that it tells two of the named effects apart, not just that it tells
  /// most.
  bool is_promised(const Answer& before) const;
};

struct PlanOrder {
  std::string set;
  std::string answers;  // folder
  Choice choice = Choice::kProposed;
  std::uint64_t seed = 1;  // of the choice
  std::function<void(std::size_t done, std::size_t of)> progress = {};
};

/// Writes <set>/followup/: plans.json (rollrig-blind-plans/1) with a line for each answer that leaves something open,
/// and for each of these whose test the generator can make plans/<number>/ with plan.json (rollrig-blind-plan/1) and
/// the files of diagnosis::write_plan. The runs are those of the menu's test of that description: an answer does not
/// hold them, and the menu is a function of the set. A test is not made where a measurement set has no place for what
/// it reads (a common pulse, a further sensor). Drawn: each test that can be made is as likely. Opens cases and answers
/// alone.
///
/// Errors   InputError: cases without an answer to their files; a test that the menu does not have; plans are there
/// Checked  tests/validation/scoring/follow_up_test.cpp
std::vector<FollowUpPlan> plan_follow_ups(const PlanOrder& order);

/// Puts the tests of a choice, planned in `folder`, and the answers to them beside the cases of a validation set.
/// Errors  InputError: plans for other answers; tests that were planned and not done, or not diagnosed
void read_follow_ups(const std::string& set, Choice choice, const std::string& folder, std::vector<Case>& cases);

}  // namespace rollrig::validation
