#pragma once
/// What a diagnosis finds, and what it is asked.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "error.h"
#include "progress.h"
#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

enum class Verdict { kNoGap, kExplained, kUnexplained };

/// What a cause changes.
struct CauseChange {
  double floors = 0.0;                   // of the readings, in noise floors, beyond what recalibration can imitate
  std::optional<double> energy_percent;  // of the energy of a run, by the cause alone: base parameters held
};

/// An effect that may act beside a cause.
struct Partner {
  std::string effect;
  double probability = 0.0;  // that it acts together with the cause
};

/// An effect or two or three that act together, or effects that this set cannot separate.
struct Cause {
  std::vector<std::string> effects;  // of the hypothesis: one, or two or three that act together
  double probability = 0.0;          // that it, or what it cannot be told from, acts: alone or with others
  std::vector<std::string> indistinguishable_from;
  std::vector<ParameterEstimate> parameters;
  bool adequate = true;
  std::vector<std::string> objections;               // why not adequate, a sentence each
  double kept = 1.0;                                 // share of its probability that the objections leave,
  double kept_confirmed = 1.0;                       // and where the data left out clearly confirm it
  std::vector<std::string> companions = {};          // of the best fit, not named since they would be most unusual: why
  std::optional<CauseChange> change = std::nullopt;  // of the first cause, and of a trace
  std::optional<double> acts = std::nullopt;         // of the first cause: that all its effects act, alone or not;
  std::optional<double> alone = std::nullopt;        // that they act and nothing else of the catalog does
  std::optional<double> complete = std::nullopt;     // that all that acts is named: it, or what it cannot be told from
  std::vector<Partner> partners = {};                // what may act beside them, the likeliest first
};

/// A gap in noise floors: rms of what is left without noise, in standard deviations of a mean over a
/// block of ten seconds; the session's offset does not count.
struct GapView {
  double before = 0.0;
  double after = 0.0;  // the first cause added
};

/// The gap of one channel, in its unit (a torque as force at the drum's surface).
struct ChannelGap {
  std::string channel;
  std::string unit;
  double before = 0.0;
  double after = 0.0;
};

/// What is left of the gap in one channel, in its unit (a torque as force at the drum's surface).
struct ChannelRest {
  std::string channel;
  std::string unit;
  double rms = 0.0;  // without noise
};

/// What is left of the gap after a step from the files' numbers to the first cause.
struct GapStep {
  std::string name;                      // "as calibrated", "recalibrated", then an effect that is added
  double floors = 0.0;                   // rms over all channels without noise, in noise floors
  std::optional<double> energy_percent;  // by how much the energy of a run is off: rms over runs
  std::vector<ChannelRest> channels;
};

/// What the first cause takes from the recalibrated gap, in one way of judging it.
struct Shrinkage {
  GapView gap;                    // noise floors
  std::optional<double> percent;  // none where the gap is not above the noise
  std::array<double, 2> ci95_percent{};
  std::optional<GapView> energy_percent;  // by how much the energy of a run is off: rms over runs
};

/// A run of which the others say too little.
struct UnjudgedRun {
  std::string run;
  std::vector<std::string> alone_in;  // conditions that it alone holds: "load", "speed"; empty where there is none
};

/// What a shrinkage is judged on.
enum class JudgedBy {
  kNothing,
  kRuns,      // runs left out of the fit
  kStretches  // stretches left out of it: no run counts, or only they confirm the cause (gap.h)
};

/// How far the gap shrinks, on data that the fit did not see.
struct Gap {
  GapView as_calibrated;                 // base parameters as the files give them
  GapView recalibrated;                  // base parameters moved within their uncertainty; on what the cause is judged
  std::optional<double> shrink_percent;  // of the recalibrated gap; none where that is not above the noise
  std::array<double, 2> shrink_ci95_percent{};
  JudgedBy judged_by = JudgedBy::kNothing;
  std::optional<Shrinkage> fitted;      // of the fit to all runs, on these; this and the next two: with a cause
  std::optional<Shrinkage> stretches;   // each phase of a run left out of the fit; none where none can be judged
  std::optional<Shrinkage> runs;        // each run left out of the fit; likewise
  std::optional<double> left_out_nats;  // ln of how much likelier the cause makes what was left out; with a cause
  std::vector<UnjudgedRun> not_judged;  // runs that the others do not predict well enough to judge the cause
  std::optional<double> recalibration_percent;  // what recalibration alone takes from the gap as calibrated
  std::optional<double> black_box_percent;      // what a smooth function of the inputs takes from the recalibrated gap
  std::vector<std::string> held_out;            // runs left out of a fit and predicted by it
  std::vector<std::string> judged_on;           // of held_out, those on which the cause is judged
  bool worse_where_certain = false;             // the cause enlarges the gap of what is judged
  std::vector<ChannelGap> channels;
  std::vector<GapStep> steps;  // on the fitted data, each effect added to those before it; empty where unknown
};

/// A stretch of one channel in which simulation and measurement differ.
struct Location {
  std::string channel;
  std::string run;
  std::string phase;
  double share_percent = 0.0;  // of all that is above the noise
  double size = 0.0;           // measured minus simulated, mean over the stretch
  std::string unit;
  double z = 0.0;  // size over its standard deviation
  double start_s = 0.0;
  double end_s = 0.0;
};

/// An equation that needs a perturbation for the simulation to meet the measurement.
struct BalanceShare {
  std::string name;
  double share_percent = 0.0;
};

/// A test that would tell more.
struct NextTest {
  std::string test;
  std::vector<std::string> splits;  // effects that it separates
  double expected_bits_per_hour = 0.0;
  double hours = 0.0;                                  // of the rig
  std::vector<std::string> by_hand = {};               // what is done at the rig beside the runs, a sentence each
  std::string id = {};                                 // in the menu of tests: "load_sweep"
  std::optional<double> naming_chance = std::nullopt;  // within the hours of a TestBudget, with the tests after it
};

/// A sensor that the rig has not, and what it would add to an ordinary run.
struct NextSensor {
  std::string sensor;
  std::vector<std::string> splits;  // beyond what the run splits without it
  double expected_bits = 0.0;       // likewise
  double hours = 0.0;               // to fit it
};

/// A run that holds half or more of the gap of an unexplained set, or runs in doubt, and what is found without them.
struct LoneRun {
  std::string run;
  double share_percent = 0.0;  // of all that is above the noise
  Verdict verdict = Verdict::kNoGap;
  std::vector<std::string> effects;  // of the first cause, where there is one
  double probability = 0.0;          // of the first cause, or of "none"
};

/// Where the standard uncertainty of a number comes from.
enum class SdSource {
  kFile,   // key `_sd` of the file
  kUsual,  // assumed: of a number that was identified
  kClass   // assumed: of a value of the tire's class, or a guess
};

/// A number of a tire, rig or vehicle file that the diagnosis moves within its standard uncertainty.
struct BaseNumber {
  std::string name;  // as the file has it: "thermal.heat_capacity_J_per_K"
  std::string unit;
  double value = 0.0;  // of the file
  double sd = 0.0;
  SdSource sd_source = SdSource::kFile;
  double recalibrated = 0.0;                        // without any effect
  double moved_sd = 0.0;                            // by how many standard uncertainties
  std::optional<double> with_cause = std::nullopt;  // the same with the first cause; none where there is none
  std::optional<double> with_cause_moved_sd = std::nullopt;
};

/// What an unknown effect is like.
struct Likeness {
  std::string text;  // "a force of +3.1 N that acts between 40 and 55 km/h"
  double probability = 0.0;
  std::vector<std::string> beside;  // named effects that act together with it; usually none
};

/// What a diagnosis finds, as its JSON has it.
struct Findings {
  std::string set;                   // its name
  std::vector<std::string> only;     // as DiagnosisOptions has them
  std::vector<std::string> without;  // likewise
  Verdict verdict = Verdict::kNoGap;
  std::map<std::string, double> probability;  // of "none", "unknown" and every effect in the comparison
  std::optional<double> nothing_detectable;   // without a gap: that no effect acts which the set would show
  std::vector<Cause> causes;                  // the likeliest first
  std::optional<Cause> trace;                 // a cause that acts, but is too small to matter: then there is no gap
  std::optional<Likeness> unknown_like;       // what an effect outside the catalog is like, where that is known
  Gap gap;
  std::vector<Location> where;  // the largest share first
  std::vector<BalanceShare> balance;
  std::vector<BaseNumber> base_numbers;  // that which moved furthest first
  std::vector<NextTest> next_tests;      // the best first
  std::vector<NextSensor> next_sensors;
  std::vector<std::string> not_excluded;  // effects that this set would not show, or does not decide about
  std::vector<std::string> warnings;      // about the data, a sentence each
  std::string doubt;                      // of the warnings, the one for which no cause may be named; else empty
  std::optional<LoneRun> without_run;     // of an unexplained set of three runs or more
};

/// One set of a folder of sets.
struct FleetMember {
  std::string folder;                   // as given
  std::string machine;                  // name of its rig or vehicle; empty where the set cannot be read, as is
  std::string tire;                     // its name
  std::optional<Findings> findings;     // none where it failed
  std::string failure;                  // why
  std::optional<InputProblem> problem;  // of the input, where that is why
};

/// What further tests may take. Next tests are then chosen by the chance that they, with those after them, bring a
/// cause to 95 % within the hours.
struct TestBudget {
  double hours = 0.0;                     // of the machine, set-up and soaks included
  std::vector<std::string> without = {};  // ids of tests that are not proposed
};

struct DiagnosisOptions {
  std::vector<std::string> without;  // effects left out of the comparison
  std::vector<std::string> only;     // where not empty, the effects in the comparison
  int threads = 0;                   // 0: as many as the machine has
  Progress progress = {};
  double smallest_effect_percent = 0.5;  // of the tire's loss or of the energy of drives; below it a cause is a trace
  std::optional<TestBudget> budget = std::nullopt;
};

}  // namespace rollrig
#pragma GCC visibility pop
