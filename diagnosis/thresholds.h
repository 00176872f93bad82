#pragma once
/// The numbers that decide which causes the diagnosis names.
///
/// A release is checked against what they were when the last validation set was answered (docs/validation.md, "A new
/// validation set").

#include <cstddef>

namespace rollrig::diagnosis {

/// Probabilities before the measurement (docs/how_the_diagnosis_reasons.md, "Which hypotheses are compared");
/// what a kind has is shared evenly.
/// Assumed: of ten sets four without a cause; where there is one, a second effect in one of four sets and a third in
/// one of twenty-four; 9 % for a cause outside the catalog, in all.
struct ComparisonPriors {
  double none = 0.42;
  double singles = 0.35;
  double pairs = 0.12;
  double triples = 0.02;
  double unknown = 0.02;         // on top of the baseline, of any form
  double families = 0.02;        // a family of unknown effects (terms/unknown_terms.h), alone
  double family_beside = 0.015;  // odds of one beside a named cause, over that cause alone
  double look_alike =
      0.045;  // on top of a single effect: like it, but something else; of pairs and triples in proportion
};

/// Sizes of model error, in noise floors and relative.
struct ModelError {
  double baseline_floors = 0.1;   // Assumed: of the baseline's equations, per channel
  double law_share = 0.05;        // Assumed: of what an effect changes in a channel that nothing else can change
  double whole_share = 0.015;     // Assumed: of all that it changes there, base parameters held; an effect whose
                                  // law is rougher says so (EffectInfo::law_error)
  double size_share = 0.1;        // Assumed: of an effect's size, by which its law may be wrong everywhere alike
  double look_alike_share = 0.3;  // Assumed: by which an unknown effect differs from the one that it looks like
};

namespace thresholds {

// The law of an effect may be loose (comparison/law_errors.h): by how much, and how likely that is. Assumed: 10 % of
// what the effect changes. Where the cavity of an independent generator bends otherwise, such laws gain 25 to 45 nats.
constexpr double kLooseLawShare = 0.1;
constexpr double kLooseLaw = 0.1;

// An effect fitted beside another may be an error of the other's law: odds of that where it gains next to nothing, and
// how they fall with what it gains beside loose laws and with the relative error of the law that would gain as much.
// Assumed: the likeliest of a few values for 95 second effects of the mixed set 2026120101. Of those that gained 5 nats
// or more with a relative error below 10 %, 8 acted, and 7 of these kept at least 93 % of the gain beside a loose law.
// 6 neither acted nor resembled an effect that acts, and 5 of these kept 17 to 80 %.
constexpr double kLawErrorOdds = 1.5;
constexpr double kLawError_nats = 6.0;
constexpr double kLawErrorShare = 0.15;
constexpr double kDecides = 1e-4;  // Assumed: a smaller probability decides nothing, wherever it goes
constexpr double kExactLaw = 0.3;  // Assumed: that a law is better than the shares of model error say

// Screening and refits.
constexpr double kScreened_nats = 6.0;        // Assumed: all effects within odds of 400 of the best are refitted,
constexpr std::size_t kScreenedLeast = 6;     // Assumed: and so many at least
constexpr int kFirstSteps = 4;                // of Levenberg and Marquardt, for each of them
constexpr int kMostSteps = 30;                // for those that could still win
constexpr double kFaint_nats = 2.0;           // a screening score that cannot make a cause: one step will do
constexpr double kWorthFinishing_nats = 1.0;  // over the baseline, below which a better fit decides nothing
constexpr double kHopeless_nats = 20.0;     // Assumed: behind the best more than the steps that are left could gain ...
constexpr double kHopelessShare = 0.25;     // ... and so much of what the best gains
constexpr double kWorthAdding_nats = 3.0;   // Assumed: screening score of a second or third effect
constexpr std::size_t kFirstsOfPairs = 2;   // singles on top of which second effects are tried,
constexpr std::size_t kSecondsOfPairs = 3;  // and how many of these
constexpr std::size_t kFirstsOfTriples = 1;  // likewise pairs and third effects
constexpr std::size_t kSecondsOfTriples = 2;

// Discrepancy: a smooth unknown function of time.
constexpr double kDiscrepancyScales_s[] = {120.0, 480.0};  // Assumed: shorter is noise, longer is a phase

// Verdict.
constexpr double kToldApart_nats = 3.0;  // Assumed: odds of 20, below which hypotheses are named together
constexpr double kTail_sd = 3.0;         // Assumed: 3 draws of a prior in 1000; a parameter so far out is an objection
constexpr double kBeyondRange_sd = 2.0;  // Assumed: so far beyond its range a size is an objection
constexpr double kFarMoveChance = 0.01;  // Assumed: that any number of right files moves as far as an objection needs
constexpr double kStrained_sd = 1.5;     // Assumed: moves of a tire's numbers from which class values are tried
constexpr double kClassTirePrior =
    0.99;  // Assumed: that numbers are a class's where no uncertainty nor origin is stated
constexpr double kRunSizeChance = 1e-3;  // Assumed: of the test whether the size is one in all runs ...
constexpr double kRunSizeShare = 0.3;    // ... by which a law's idealization may change it from run to run
// Of a cause's probability, by what speaks against it; the rest goes to "unknown". The share of truths among causes
// with that objection, in 864 answers to two validation sets (truths plus one of cases plus two); of those that were
// not counted there, in 364 answers to three mixed sets, where nothing else spoke against the cause.
constexpr double kKeptUnusual = 0.5;           // of 14 with a parameter far out in its prior 7 were true
constexpr double kKeptRunSize = 0.65;          // of 4 whose size differs from run to run 3
constexpr double kKeptRemainder = 0.1;         // of 35 with something else missing 3
constexpr double kKeptBeyondRange = 0.05;      // Assumed: no such truth was seen
constexpr double kKeptWrongFiles = 0.3;        // Assumed: both of 2, and none in the earlier sets
constexpr double kKeptConfirmed = 0.7;         // of 5 with either of these two, but confirmed by data left out, 4
constexpr double kKeptUnconfirmed = 0.45;      // Assumed: below one half, so never "explained"; 6 of 9 were true
constexpr double kKeptHardlyLikelier = 0.5;    // 5 of 10: still the likeliest, and not explained
constexpr double kClearShrink_percent = 33.0;  // Assumed: what confirms a cause whose interval the noise makes wide
// Of a smaller gap the likelihood alone says whether a cause is confirmed. Assumed: in 142 answers to a fourth mixed
// set, all 4 causes that this confirms were true, and none of those that it would confirm from 0.98 noise floors on.
constexpr double kFaintGap_floors = 0.6;
constexpr double kConfirmed_nats = 3.0;   // Assumed: odds of 20 for what was left out; less does not confirm a cause
constexpr double kShownHeldOut_sd = 3.0;  // Assumed: by which a cause changes a part left out for it to be judged there
constexpr double kCertainHeldOut = 0.25;  // Assumed: of what the cause changes, in squares: a part left out is judged
constexpr double kSmallestEffect_floors_per_percent = 0.6;  // Assumed: 0.3 noise floors matter as 0.5 % of the loss do
constexpr double kDetectableEffect_sd = 5.0;                // named then in 19 of 20 sets, against the priors above
constexpr std::size_t kLongSet = 3;        // effects named together; more than that name nothing, so that
constexpr double kLeftOutOfLongSet = 0.1;  // Assumed: the unlikeliest are left out, up to this share of the set
constexpr double kNamed = 0.95;            // Assumed: from here on a cause is named, and a loop of tests ends
constexpr double kNamedAlone = 0.90;  // Assumed: from here on it counts as acting alone, and a loop of tests ends early
constexpr double kWorthNaming = 0.001;   // probability of a further cause
constexpr double kLikeFamily = 0.5;      // Assumed: share of "unknown" from which a family tells what it is like
constexpr double kWorthPartner = 0.005;  // Assumed: probability of an effect that is listed as acting beside a cause

}  // namespace thresholds
}  // namespace rollrig::diagnosis
