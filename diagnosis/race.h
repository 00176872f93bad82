#pragma once
/// All hypotheses on one set: fitted, weighed, compared.

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/screen.h"

namespace rollrig::diagnosis {

/// Probabilities before the measurement. Source: design of the method; the rest of a kind is shared evenly.
struct RacePriors {
  double none = 0.50;
  double singles = 0.35;
  double pairs = 0.05;
  double triples = 0.01;
  double unknown = 0.03;  // on top of the baseline
  double look_alike =
      0.06;  // on top of a single effect: like it, but something else; of pairs and triples in proportion
};

/// Sizes of model error, in noise floors and relative.
struct ModelError {
  double baseline_floors = 0.1;   // Assumed: of the baseline's equations, per channel
  double law_share = 0.05;        // Assumed: of what an effect changes in a channel that nothing else can change
  double whole_share = 0.015;     // Assumed: of all that it changes there, base parameters held
  double size_share = 0.1;        // Assumed: of an effect's size, by which its law may be wrong everywhere alike
  double look_alike_share = 0.3;  // Assumed: by which an unknown effect differs from the one that it looks like
};

/// One hypothesis in the race.
struct Contender {
  Fit fit;
  Amplitudes amplitudes;       // of the remainder, after the measurement
  Amplitudes signature;        // rms by channel of what it changes against the null's fit, in noise floors
  Amplitudes whole;            // the same against its own fit without its effects
  double log_evidence = 0.0;   // with the remainder as small as model error
  double log_remainder = 0.0;  // with a free remainder on top
  double probability = 0.0;    // with the small remainder
  double remainder_probability = 0.0;
};

struct Race {
  std::vector<const models::Effect*> effects;
  ModelError model_error;
  Contender null;
  std::vector<Screened> screened;     // on top of the null
  std::vector<Contender> contenders;  // effects, pairs and triples, the likeliest first
  double unknown_probability = 0.0;   // all hypotheses with a free remainder
};

struct RaceSettings {
  std::vector<const models::Effect*> effects;
  RacePriors priors;
  ModelError model_error;
  int threads = 0;
  std::function<void(double done, const std::string& stage)> progress = [](double, const std::string&) {};
};

/// Screens, refits every effect that could matter from its best start, then pairs on top of the best, then triples on
/// top of the best pair where two effects are asked for, and weighs all. Errors  RunFailure: the baseline cannot be
/// fitted
Race run_race(const PreparedSet& set, const std::vector<identification::FreeParameter>& base,
              const Remainder& remainder, const RaceSettings& settings);

}  // namespace rollrig::diagnosis
