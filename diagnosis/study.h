#pragma once
/// One measured set under diagnosis: what every step of it works on, each made once.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/comparison/base_parameters.h"
#include "diagnosis/comparison/refit.h"
#include "diagnosis/thresholds.h"
#include "include/rollrig/progress.h"

namespace rollrig::diagnosis {

/// How far a diagnosis is: stages one after the other, each with its share of the time, as measured on drum sets.
struct Stages {
  Progress report;
  std::string name;
  double from = 0.0;
  double to = 0.0;

  void begin(const std::string& stage, double until) {
    name = stage;
    from = to;
    to = until;
    advance(0.0);
  }
  void advance(double share) const {
    if (report) report((1.0 - share) * from + share * to, name);
  }
};

struct StudySettings {
  std::vector<const Term*> terms;          // in the comparison
  std::vector<const Term*> unknown_terms;  // likewise: families of unknown effects
  ComparisonPriors priors;
  ModelError model_error;
  TireBelief belief = TireBelief::kIdentified;
  int threads = 0;  // 0: as many as the machine has
  std::shared_ptr<Stages> stages = std::make_shared<Stages>();

  /// For parallel_for: tells that a share of the stage is done.
  std::function<void(double)> advance() const {
    return [stages = stages](double share) { stages->advance(share); };
  }
};

/// A hypothesis that was fitted to the set, and how well it predicts the set.
struct Candidate {
  Fit fit;
  Amplitudes amplitudes;            // of the discrepancy, after the measurement
  Amplitudes signature;             // rms by channel of what it changes against the null's fit, in noise floors
  Amplitudes whole;                 // the same against its own fit without its terms
  double log_evidence = 0.0;        // with the discrepancy as small as model error
  std::optional<double> log_loose;  // part of it: where the laws of all terms are loose; none if not found
  double log_discrepancy = 0.0;     // with a free discrepancy on top
  double probability = 0.0;         // with the small discrepancy
  double of_law_error = 0.0;  // part of it that came from hypotheses with one effect more, whose further effect may
                              // be an error of these effects' laws
  double discrepancy_probability = 0.0;

  double posterior() const { return probability + discrepancy_probability; }
};

struct Study {
  explicit Study(const measurements::MeasurementSet& measured, StudySettings settings = {});
  /// Of one tire on several machines (PreparedSet).
  explicit Study(std::vector<measurements::MeasurementSet> measured, StudySettings settings = {});
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  Model make_model(const Hypothesis& hypothesis) const { return {set, base, hypothesis}; }

  StudySettings settings;
  PreparedSet set;
  std::vector<estimation::FreeParameter> base;          // what a recalibration may move
  std::map<std::string, rollrig::SdSource> sd_sources;  // of their standard uncertainties, by key
  Discrepancy discrepancy;                              // of time: model error, or what follows nothing recorded
  Candidate null;                                       // the baseline, recalibrated; compare_models() fits it
};

}  // namespace rollrig::diagnosis
