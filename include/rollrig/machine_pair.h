#pragma once
/// Finds the effect in which two machines differ. Both tested the same tire. Method: docs/machine_pairs.md.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "findings.h"
#include "measurement_set.h"
#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// An estimate in N/kN with its interval of 95 %.
struct RrcEstimate {
  double value_N_per_kN = 0.0;
  double low_95_N_per_kN = 0.0;
  double high_95_N_per_kN = 0.0;
};

/// The probability that an effect acts on one of the machines alone, by machine.
struct OnMachine {
  std::string effect;
  std::array<double, 2> probability{};
};

/// An effect, or two or three together, in which the machines differ.
struct MachineDifference {
  std::vector<std::string> effects;  // of the likeliest hypothesis; usually one
  double probability = 0.0;          // that they differ by it, or by what it cannot be told from
  std::vector<std::string> indistinguishable_from;
  std::vector<OnMachine> on_machine;          // of each effect that is named
  std::vector<ParameterEstimate> parameters;  // "<effect> on A.<key>", of the likeliest hypothesis
};

enum class PairVerdict {
  kAgree,       // no difference beyond the noise
  kExplained,   // they differ in an effect that is named
  kUnexplained  // they differ, but in nothing that the comparison knows, or a set is in doubt
};

/// What the comparison of two machines finds, as its JSON has it.
struct PairFindings {
  std::array<std::string, 2> sets;      // their names; the first machine is called A, the second B
  std::array<std::string, 2> machines;  // names of the rigs
  std::string tire;
  PairVerdict verdict = PairVerdict::kAgree;
  std::map<std::string, double> probability;  // of "agree", "unknown" and every effect in which they may differ
  std::vector<MachineDifference> causes;      // the likeliest first
  RrcEstimate difference;                     // of the coefficient on A minus that on B, no effect assumed
  std::optional<RrcEstimate> remaining;       // what of it remains with the first cause
  std::optional<double> left_out_nats;        // ln of how much likelier the cause makes runs left out; with a cause
  std::vector<Location> where;                // a run is "A: <id>" or "B: <id>"
  std::vector<std::string> warnings;
  std::string doubt;  // of the warnings, the one for which no cause may be named; else empty
};

/// The comparison of two machines; as a report without files.
struct PairDiagnosis : PairFindings, Report {};

/// Finds the effect in which two machines differ. Both sets have the same tire file and the same kind of rig.
/// `options`: budget and smallest_effect_percent do not count; `only` and `without` also take the effects that only a
/// second machine shows: surface_roughness, drum_diameter, ambient_record, liner_record.
/// Errors  InputError: another tire or kind of machine; the same set twice; a set of the road; an unknown effect
PairDiagnosis diagnose_pair(const MeasurementSet& a, const MeasurementSet& b, const DiagnosisOptions& options = {});

/// Effects in which two machines may differ: those of the catalog that belong to a machine, and those that only a
/// second machine shows.
std::vector<std::string> list_machine_effects();

}  // namespace rollrig
#pragma GCC visibility pop
