#pragma once
/// The score of a validation set: each figure beside its target, tables by effect, campaign and size, what was missed,
/// and what an ideal observer would reach.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/scoring/case.h"

namespace rollrig::validation {

enum class Unit { kPercent, kNumber, kSeconds };

/// A line of the table of targets.
struct Figure {
  std::string id;
  std::string label;
  std::optional<double> value = {};  // none where there was no case, or it was not measured
  std::optional<Interval> interval = {};
  std::size_t k = 0;  // of n cases
  std::size_t n = 0;
  Unit unit = Unit::kPercent;
  std::optional<double> target = {};
  std::optional<double> floor = {};  // the least that is asked for
  bool more_is_better = true;
  std::optional<double> best_baseline = {};
  std::string best_baseline_id = {};       // of that method
  std::optional<double> upper_bound = {};  // what an ideal observer would reach; none where it is not known
  std::string note = {};                   // where there is no value: why

  bool meets(const std::optional<double>& bar) const;
};

/// How the cases of one cause, campaign or size were answered.
struct Tally {
  std::size_t cases = 0, named = 0, named_wrong = 0, no_gap = 0, unexplained = 0, failed = 0;
  std::size_t right_above = 0, wrong_above = 0;  // first causes stated above kConfident
  std::size_t named_effects = 0;                 // in the cases that are named, right or wrong

  void add(const Case& one);
  double mean_named_set() const;
};

using Tallies = std::map<std::string, Tally>;
using Confusion = std::map<std::string, std::map<std::string, std::size_t>>;  // truth, what was said

struct ScoreOptions {
  double detectable_d_prime = kDetectable_d_prime;  // docs/validation.md, "Figures of merit"
  double detectable_floors = kDetectable_floors;
};

/// The chance that an ideal observer has with one case: nobody names what the data do not show. None where the case has
/// no upper bound that tells it.
using Chance = std::function<std::optional<double>(const Case&)>;

/// That it raises a gap at 1 % false alarms: Phi(d' - 2.326).
/// Checked  tests/validation/scoring/ideal_observer_test.cpp, as those below
std::optional<double> find_chance_of_detection(const Case& one);
/// 1 where less than three other effects are within 3 nats of the truth, else 0.
std::optional<double> find_chance_of_small_set(const Case& one);
/// 1 where a pair is told from every single effect, else 0.
std::optional<double> find_chance_of_pair(const Case& one, double detectable_d_prime);

/// Whether an ideal observer who starts from the probabilities of the diagnosis names a pair: it is then likelier than
/// all single effects together. None without an upper bound that compares it with them.
/// Equation  sum_r 1/o_r < 1,  o_r = (pi_2/pi_1) exp(L_r) / sqrt(1 + 2 L_r)
/// Symbols   L_r >= 0 expected log Bayes factor against the single effect r at the true sizes, nats; pi_2, pi_1
///           probability of each pair and of each single effect before the measurement
/// Validity  the root is the Occam factor of the second size: its prior is normal, the true size is one standard
///           deviation, and d' = sqrt(2 L_r). Pairs of other effects are not compared, so the observer names too many
/// Source    docs/validation.md, "Upper bound"
/// Checked   tests/validation/scoring/ideal_observer_test.cpp
std::optional<bool> is_pair_named_by_ideal(const Case& one);

/// Mean chance; none where one of the cases has none, or there is no case.
std::optional<double> find_mean_chance(const std::vector<Case>& cases, const Chance& chance);

/// What the answers state, of the cases that could be diagnosed.
std::vector<Stated> list_stated(const std::vector<Case>& cases);

/// Source  docs/validation.md, "Figures of merit"
std::vector<Figure> find_figures(const std::vector<Case>& cases, const ScoreOptions& options);

/// The same figures of a baseline's answers.
struct BaselineScore {
  std::string id;
  std::string label;
  std::map<std::string, double> values;  // by a figure's id, of those that the method is judged by
};

constexpr const char* kAllKinds = "all";

/// What answers of one verdict to cases of one kind of measurement set state, and how many are right.
struct ReliabilityGroup {
  std::string kind;
  diagnosis::Verdict verdict = diagnosis::Verdict::kNoGap;
  ReliabilityBin bin{};
};

/// By kind, verdicts in the order no gap, explained, unexplained, where there are answers; then of all kinds together,
/// where there is more than one. A diagnosis that failed is none.
/// Checked  tests/validation/scoring/score_test.cpp
std::vector<ReliabilityGroup> group_reliability(const std::vector<Case>& cases);

/// How well answers locate the gap. Answers that name no location count nowhere.
struct LocationTally {
  std::size_t answers = 0;                                     // that name one or more
  std::size_t channel = 0, run = 0, phase = 0, all_three = 0;  // of the first location of each: right
  std::size_t named = 0;                                       // locations of all answers
  std::size_t shifted = 0;                                     // of these: the effects shift the readings there so

  void add(const Case& one);
};

struct Score {
  std::vector<Figure> figures;
  std::vector<BaselineScore> baselines;
  Tallies by_effect, by_campaign, by_size_class;
  Tally all_effects;
  Confusion confusion;
  Reliability reliability{};
  std::vector<ReliabilityGroup> reliability_groups;
  std::map<std::string, LocationTally> locations;  // by kind, and of kAllKinds; empty where nothing is known of them
  std::vector<Case> missed;
  std::vector<Case> followed_up;  // whose next test was planned
  std::size_t cases = 0;
  std::vector<std::string> warnings;
};

/// Checked  tests/validation/scoring/score_test.cpp
Score score_cases(const std::vector<Case>& cases, const ScoreOptions& options);

struct ScoreOrder {
  std::string set;
  std::string hash;                 // of the truth; empty: what truth.sha256 says
  std::string answers;              // folder
  std::string known_cause;          // folder of answers with the true effect alone in the comparison; empty: none
  std::string upper_bound;          // file with d' of the cases; empty: none
  std::string locations;            // file with where the effects act; empty: none
  std::string next_tests;           // folder of follow-up tests that were proposed, done; empty: none
  std::string drawn_tests;          // likewise with tests drawn from the menu
  bool truth_was_left_out = false;  // the true effects were not in the comparison: none is in the catalog
  bool by_baseline = false;         // the answers are of baselines
};

/// Opens the truth and puts the answers beside it.
/// Errors  InputError: as read_truths(); answers that lack or are of other files
std::vector<Case> read_cases(const ScoreOrder& order);

}  // namespace rollrig::validation
