#pragma once
/// Compares the machines of pairs (generator/machine_pairs.h), and scores the answers.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "include/rollrig/machine_pair.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"
#include "validation/scoring/answered_items.h"
#include "validation/scoring/statistics.h"

namespace rollrig::validation {

struct PairsRun {
  std::string set;
  std::string out;  // folder of the answers
  int threads = 0;  // pairs at the same time; 0: as many as the machine has
  std::function<void(std::size_t done, std::size_t of)> progress = {};
};

/// Answers each pair that has no answer yet by this program, of these files, on one thread each; see
/// carry_out_answers(). Opens nothing but the sets.
AnswerTally run_pairs(const PairsRun& order);

/// What a pair really is.
struct PairTruth {
  std::string effect;  // by which the machines differ; empty: none
  int on = 0;          // 0: A, 1: B
  bool has_tire_effect = false;
  double d_prime = 0.0;
};

/// Whether an answer names the effect by which the machines differ.
struct PairJudgement {
  bool is_named = false;  // with at most three effects in all
  bool is_top = false;    // as the first effect of the first cause
  bool is_right_machine = false;
  bool is_any_named = false;  // the verdict is that an effect makes them differ
};
PairJudgement judge_pair(const rollrig::PairFindings& answer, const PairTruth& truth);

/// Shares of the answers, each with its interval of 95 %.
struct PairShare {
  std::string label;
  std::size_t right = 0;
  std::size_t cases = 0;
  std::optional<double> target;

  Interval interval() const { return calc_wilson_95(right, cases); }
};

struct PairScore {
  std::vector<PairShare> shares;
  std::vector<PairShare> by_effect;  // named, of those that can be seen
  std::vector<std::string> missed;   // a sentence each
  double cpu_seconds = 0.0;          // median of an answer
  std::string truth_sha256;
};

/// Opens the truth. Throws InputError where an answer is missing.
/// Checked  tests/validation/scoring/machine_pairs_test.cpp
PairScore score_pairs(const std::string& set, const std::string& answers);

Table make_shares_table(const PairScore& score);
Json make_score_json(const PairScore& score);

}  // namespace rollrig::validation
