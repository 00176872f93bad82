#pragma once
/// A case of a validation set with its truth and the answer to it.

#include <optional>
#include <string>
#include <vector>

#include "validation/scoring/answer.h"
#include "validation/scoring/follow_up.h"
#include "validation/scoring/locations.h"
#include "validation/scoring/statistics.h"
#include "validation/scoring/truth.h"

namespace rollrig::validation {

constexpr double kConfident = 0.9;           // from here on a wrong cause counts as stated with confidence
constexpr double kDetectable_d_prime = 5.0;  // of the ideal observer: from here on an effect is to be found
constexpr double kDetectable_floors = 1.0;   // likewise where no d' is known. Assumed: an upper bound of what is seen
constexpr std::size_t kLargestNamedSet = 3;  // a larger one names nothing

/// A stated size beside the true one, where both laws mean the same by it.
struct SizeCheck {
  double error = 0.0;  // relative to what the size differs from doing nothing
  bool covered = false;
};

struct Case {
  Truth truth;
  Answer answer;
  std::optional<double> known_cause_shrink_percent;  // with the true effect alone in the comparison
  std::optional<double> d_prime;                     // of the ideal observer
  std::optional<bool> identifiable;                  // likewise: whether its data tell the effect from all others
  std::vector<double> log_bayes_factors;  // likewise: expected, of the truth over each other effect; may be empty
  std::vector<TruePlace> places;          // where the effects act; empty where that was not computed
  std::optional<FollowUp> next_test;      // that the answer proposes; none where it leaves nothing open
  std::optional<FollowUp> drawn_test;     // drawn from the menu instead

  bool is(diagnosis::Verdict verdict) const { return answer.failure.empty() && answer.diagnosis.verdict == verdict; }
  bool has_cause() const { return answer.failure.empty() && !answer.diagnosis.causes.empty(); }
  const diagnosis::Cause& cause() const { return answer.diagnosis.causes.front(); }
  /// The first cause's effects and all that it cannot be told from.
  std::vector<std::string> named_set() const;
  /// Whether the true effects stand in a named set of at most three.
  bool names_truth() const;
  /// Likewise, and the verdict is that the gap is explained; or the trace of a set without a gap names the true effects
  /// in this way.
  bool is_named() const { return (is(diagnosis::Verdict::kExplained) && names_truth()) || names_trace(); }
  bool names_trace() const;
  /// Whether nothing acts that an ideal observer would see (d' below 5, or, where that is not known, less than a noise
  /// floor in every channel).
  bool shows_nothing() const;
  bool is_exact() const;
  /// Likewise named, and the first cause, or the trace, has no more effects than there are.
  bool is_named_strictly() const;
  /// Effects that are said to act with more than that, where the verdict is that the gap is explained: all, and those
  /// of them that do not.
  std::vector<std::string> claims_above(double probability) const;
  std::vector<std::string> false_claims_above(double probability) const;
  /// Whether the first cause acts, and nothing else does, with the probability stated for that; none where it is not
  /// stated.
  std::optional<Stated> stated_alone() const;
  /// Whether all effects of the first cause act, alone or not, with the probability stated for that; likewise.
  std::optional<Stated> stated_acts() const;
  /// Whether all effects of the first cause act.
  bool first_cause_acts() const;
  /// Whether the first cause is one effect, which is one of the two true ones.
  bool names_one_of_two() const;
  /// The probability stated for the first cause: that all that acts is named. Answers of programs that did not state it
  /// count with the probability of the cause.
  double stated_whole() const;
  /// Whether something untrue is stated with more than that: that all that acts is named, that anything that is named
  /// acts, or that the whole first cause does.
  bool is_wrong_above(double probability) const;
  bool is_right_above(double probability) const;
  /// How many effects are as likely as the true one or likelier.
  std::size_t rank_of_truth() const;
  /// What a careful reader takes home: no gap, a cause, or that it is unexplained.
  bool is_right() const;
  /// The probability stated for that.
  Stated stated() const;
  std::string said() const;

  /// The locations that the answer names, the largest share of the gap first; none where it is not known where the
  /// effects act.
  std::vector<diagnosis::Location> scored_locations() const;

  bool is_clean() const { return truth.effects.empty(); }
  bool is_single() const { return truth.effects.size() == 1 && !truth.outside; }
  bool is_pair() const { return truth.effects.size() == 2 && !truth.outside; }
  bool is_triple() const { return truth.effects.size() == 3 && !truth.outside; }
  /// Whether there is an effect, and none outside of the catalog.
  bool is_inside() const { return is_single() || is_pair() || is_triple(); }
  std::optional<SizeCheck> check_size() const;
  /// The same case with the answer to it after a test; without an answer where the test was not done.
  Case answered_after(const FollowUp& test) const;
  /// Whether a test that was done has split the named set: with its runs the verdict is explained, the new named set
  /// holds the truth and at most three effects, and fewer than before.
  bool is_split_by(const FollowUp& test) const;

 private:
  bool is_true_effect(const std::string& id) const;
};

}  // namespace rollrig::validation
