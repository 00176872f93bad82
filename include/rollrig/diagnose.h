#pragma once
/// Why a measurement and the simulation differ: where, by which unmodeled effect, and how far the gap
/// shrinks once that effect is added. Method: docs/diagnosis.md.

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measurement_set.h"
#include "progress.h"
#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

enum class Verdict { kNoGap, kExplained, kUnexplained };

/// An effect, a pair of them, or effects that this set cannot tell apart.
struct Cause {
  std::vector<std::string> effects;  // of the hypothesis: one, or two that act together
  double probability = 0.0;          // of it with all that it cannot be told from
  std::vector<std::string> indistinguishable_from;
  std::vector<ParameterEstimate> parameters;
  std::vector<std::string> objections;  // why it does not suffice, a sentence each
};

/// How far the gap shrinks, on runs that the fit did not see. A gap counts in noise floors: rms of what is left without
/// noise, in standard deviations of a mean over a block of ten seconds; the session's offset does not count.
struct Gap {
  double before = 0.0;                   // base parameters moved within their uncertainty
  double after = 0.0;                    // and the first cause added
  std::optional<double> shrink_percent;  // none where the gap is not above the noise
  std::array<double, 2> shrink_ci95_percent{};
};

/// A stretch of one channel in which simulation and measurement differ.
struct Location {
  std::string channel;
  std::string run;
  std::string phase;
  double share_percent = 0.0;  // of all that is above the noise
  double size = 0.0;           // measured less simulated, mean over the stretch
  std::string unit;
  double z = 0.0;  // size over its standard deviation
  double start_s = 0.0;
  double end_s = 0.0;
};

/// A test that would tell more.
struct NextTest {
  std::string test;
  std::vector<std::string> splits;  // effects that it tells apart
  double expected_bits_per_hour = 0.0;
  double hours = 0.0;                // of the rig
  std::vector<std::string> by_hand;  // what is done at the rig beside the runs, a sentence each
};

/// What a diagnosis finds; the JSON has more, such as which equations are off and what a further sensor would add.
struct Findings {
  std::string set;  // its name
  Verdict verdict = Verdict::kNoGap;
  std::map<std::string, double> probability;  // of "none", "unknown" and every effect in the comparison
  std::vector<Cause> causes;                  // the likeliest first
  Gap gap;
  std::vector<Location> where;            // the largest share first
  std::vector<NextTest> next_tests;       // the best first
  std::vector<std::string> not_excluded;  // effects that this set would not show
  std::vector<std::string> warnings;      // about the data, a sentence each
  std::string doubt;                      // of the warnings, the one for which no cause may be named; else empty
};

/// The diagnosis of one set; as a report without files.
struct Diagnosis : Findings, Report {
  std::function<FolderFiles()> make_plan;  // the first test as files for `rollrig run`, with plan.txt for a person;
                                           // none where no test is proposed
};

struct DiagnosisOptions {
  std::vector<std::string> without;  // effects left out of the comparison
  std::vector<std::string> only;     // where not empty, the effects in the comparison
  int threads = 0;                   // 0: as many as the machine has
  Progress progress = {};
};

/// The diagnosis of a measurement set of any kind, against either baseline. Takes minutes; the answer does not depend
/// on the number of threads.
/// Errors  InputError: a file lacks what the set's kind needs; an unknown effect; nothing measured.
///         RunFailure: no fit converges
Diagnosis diagnose(const MeasurementSet& set, const DiagnosisOptions& options = {});

/// One set of a folder of sets.
struct FleetMember {
  std::string folder;                // as given
  std::string machine;               // name of its rig or vehicle; empty where the set cannot be read, as is
  std::string tire;                  // its name
  std::optional<Findings> findings;  // none where it failed
  std::string failure;               // why
  bool is_input = false;             // whether its input is why
};

/// Several sets, and which effects come back with a machine or a tire; as a report without files.
struct FleetDiagnosis : Report {
  std::vector<FleetMember> members;
};

/// Diagnoses several sets. One that cannot be read or diagnosed is noted, and the others go on.
/// Errors  InputError: no set can be read; an unknown effect
FleetDiagnosis diagnose_fleet(const std::vector<std::string>& folders, const DiagnosisOptions& options = {});

/// What an effect is, how it is found, with what it is confused; also of "none" and "unknown". Text within 80 columns.
/// Throws InputError with the nearest name.
std::string explain_effect(const std::string& name);
/// Names that it takes.
std::vector<std::string> explainable_names();

}  // namespace rollrig
#pragma GCC visibility pop
