#pragma once
/// Why a measurement and the simulation differ: where, by which unmodeled effect, and how far the gap
/// shrinks once that effect is added.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "include/rollrig/findings.h"
#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

using rollrig::BaseNumber, rollrig::Cause, rollrig::CauseChange, rollrig::DiagnosisOptions, rollrig::FleetMember,
    rollrig::Gap, rollrig::GapStep, rollrig::GapView, rollrig::JudgedBy, rollrig::Likeness, rollrig::Shrinkage,
    rollrig::UnjudgedRun;
using rollrig::Location, rollrig::NextTest, rollrig::ParameterEstimate, rollrig::Partner, rollrig::RangeLimit,
    rollrig::SdSource, rollrig::TestBudget, rollrig::Verdict;

/// The size of one of a cause's effects, the first of the parameters of that effect; nullptr where there is none.
const ParameterEstimate* find_size(const Cause& cause, const std::string& effect);

/// A next test with what its files need.
struct ProposedTest : NextTest {
  bool soaked = false;  // every run starts after a soak
  bool force_at_standstill = false;
  std::vector<measurements::MeasuredRun> runs = {};  // their inputs
};

/// What the sensors would have shown by the fits to all runs, their offsets included: block means in SI units, in the
/// order of the residuals of a PreparedSet of the whole set; empty where rows were left out. For
/// pictures; not part of the JSON.
struct FittedSet {
  std::vector<double> recalibrated;  // base parameters moved within their uncertainty
  std::vector<double> with_cause;    // and the first cause added; empty where there is none
};

struct Diagnosis : Findings {
  std::optional<ProposedTest> plan;  // the first of next_tests
  FittedSet fitted;
  std::set<std::string> mistaken_runs;  // that cannot be what the set says they are, by its checks
};

/// Multiplies all probabilities of a cause.
void scale_probability(double factor, Cause& cause);

/// Orders causes by their probability, but for the first: only of this one it is known whether it acts alone and what
/// speaks against it.
void sort_after_first(std::vector<Cause>& causes);

/// Probability of "none", "unknown" or an effect; 0 where it was not in the comparison.
double probability_of(const Findings& findings, const std::string& name);

/// Throws InputError for the first effect of `without` or `only` that does not exist, and for a smallest effect
/// beyond 0 to 100 percent.
void require_valid_options(const DiagnosisOptions& options);

/// The diagnosis of a measurement set of any kind, against either baseline.
/// Method  docs/how_the_diagnosis_reasons.md
/// Errors  InputError: a file lacks what the set's kind needs; an unknown effect; nothing measured.
///         RunFailure: no fit converges
/// Checked tests/diagnosis/diagnosis_test.cpp
Diagnosis diagnose(const measurements::MeasurementSet& set, const DiagnosisOptions& options);

}  // namespace rollrig::diagnosis
