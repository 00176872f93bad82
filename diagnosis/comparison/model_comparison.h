#pragma once
/// All hypotheses on one set: fitted, weighed, compared.

#include <vector>

#include "diagnosis/comparison/screen.h"
#include "diagnosis/comparison/unfitted.h"

namespace rollrig::diagnosis {

constexpr std::size_t kMostTerms = 3;  // of a hypothesis

/// Terms that were screened on top of a hypothesis.
struct ScreenedOnTop {
  Hypothesis hypothesis;
  std::vector<Screened> screened;
};

struct Comparison {
  std::vector<Screened> screened;     // on top of the null
  std::vector<ScreenedOnTop> on_top;  // on top of others
  std::vector<Candidate> candidates;  // of a term, pairs and triples, the likeliest first
  std::vector<Unfitted> unfitted;     // what was screened and not fitted; all probabilities add to 1 with theirs
  double log_evidence = 0.0;          // of all hypotheses together, with their prior probabilities
  double unknown_probability = 0.0;   // all hypotheses with a free discrepancy

  /// Size of a term's signature at the middle of its prior, in standard deviations: of its best trial; 0 where none
  /// changes anything.
  double find_detectability(const Term& term) const;
};

/// Probability before the measurement of each hypothesis with so many terms, one to three.
double find_prior(const StudySettings& settings, std::size_t terms);
/// Of one hypothesis, one of whose terms may be a family of unknown effects.
double find_prior(const StudySettings& settings, const Hypothesis& hypothesis);

/// Gains of log evidence, nats, that say whether a further effect acts.
struct SecondGain {
  double nats = 0.0;                    // by the further effect
  double beside_loose_laws_nats = 0.0;  // likewise where the others' laws may be wrong (loosen_laws())
  double of_others_nats = 0.0;          // by the others over the baseline
};

/// Probability that an effect fitted beside others is an error of their laws and does not act.
/// Equation  P = o/(1 + o), o = 1.5 exp(-((g_l/6)^2 + (s/0.15)^2)/2), s = sqrt(g/G)
/// Symbols   g, g_l >= 0 gain by the effect and gain by it beside loose laws, nats (below 0: as 0); G >= 1 that of the
///           others, nats (below 1: as 1); s the relative error of the others' laws that would gain g: a change of the
///           readings by a share s gains the share s^2 in squares
/// Validity  where g_l was not found, or the pair has a probability below 1e-4, g takes its place
/// Source    Assumed: thresholds.h, kLawErrorOdds
/// Checked   tests/diagnosis/model_comparison_test.cpp
double calc_law_error(const SecondGain& gain);

/// Fits the baseline (study.null), screens, refits every term that could matter from its best start, then pairs on
/// top of the best, then triples on top of the best pair where two terms are asked for, and weighs all. Of pairs and
/// triples the share calc_law_error() goes to the hypothesis without their weakest effect.
/// Errors  RunFailure: the baseline cannot be fitted
Comparison compare_models(Study& study);

}  // namespace rollrig::diagnosis
