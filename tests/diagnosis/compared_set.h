#pragma once
/// Drum sets with known effects, compared with few hypotheses, for tests of what is proposed next.

#include <string>
#include <vector>

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/next_test/next_test.h"

namespace rollrig::tests {

/// An effect on, its size a multiple of the middle of its prior.
models::ActiveEffect act(const std::string& id, double size = 1.0);

/// Skim, 25 min at 80 km/h, skim, at 1 Hz.
measurements::MeasuredRun plan_skim_run();

/// Runs of the asset tire on the asset rig with effects on, measured with noise.
measurements::MeasurementSet measure_on_drum(const std::vector<models::ActiveEffect>& effects,
                                             std::vector<measurements::MeasuredRun> runs);

struct ComparedSet {
  ComparedSet(const measurements::MeasurementSet& measured, const std::vector<std::string>& terms);

  std::vector<diagnosis::OpenHypothesis> find_open() const { return find_open_hypotheses(study, comparison); }
  std::vector<diagnosis::ProposedTest> propose() const { return propose_tests(study, find_open()); }

  diagnosis::Study study;
  diagnosis::Comparison comparison;
};

/// A warm-up in which only what warms shows, with bearings that do: the torque's zero could drift as well.
ComparedSet compare_bearings_or_zero();

/// The same, compared once for all tests that only read it.
const ComparedSet& bearings_or_zero();

/// The baseline ("none") and each of the effects, at the middle of its prior and as uncertain, all as likely.
std::vector<diagnosis::OpenHypothesis> make_open(const diagnosis::Study& study,
                                                 const std::vector<std::string>& effects);

const diagnosis::JudgedTest& find_judged(const std::vector<diagnosis::JudgedTest>& judged, const std::string& id);

}  // namespace rollrig::tests
