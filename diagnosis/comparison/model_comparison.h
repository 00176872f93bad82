#pragma once
/// All hypotheses on one set: fitted, weighed, compared.

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/comparison/screen.h"
#include "diagnosis/thresholds.h"

namespace rollrig::diagnosis {

/// One hypothesis in the comparison.
struct Candidate {
  Fit fit;
  Amplitudes amplitudes;         // of the discrepancy, after the measurement
  Amplitudes signature;          // rms by channel of what it changes against the null's fit, in noise floors
  Amplitudes whole;              // the same against its own fit without its effects
  double log_evidence = 0.0;     // with the discrepancy as small as model error
  double log_discrepancy = 0.0;  // with a free discrepancy on top
  double probability = 0.0;      // with the small discrepancy
  double discrepancy_probability = 0.0;
};

struct Comparison {
  std::vector<const models::Effect*> effects;
  ModelError model_error;
  Candidate null;
  std::vector<Screened> screened;     // on top of the null
  std::vector<Candidate> candidates;  // effects, pairs and triples, the likeliest first
  double unknown_probability = 0.0;   // all hypotheses with a free discrepancy
};

struct ComparisonSettings {
  std::vector<const models::Effect*> effects;
  RacePriors priors;
  ModelError model_error;
  int threads = 0;
  std::function<void(double done, const std::string& stage)> progress = [](double, const std::string&) {};
};

/// Screens, refits every effect that could matter from its best start, then pairs on top of the best, then triples on
/// top of the best pair where two effects are asked for, and weighs all.
/// Errors  RunFailure: the baseline cannot be fitted
Comparison compare_models(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                          const Discrepancy& discrepancy, const ComparisonSettings& settings);

}  // namespace rollrig::diagnosis
