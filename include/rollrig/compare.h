#pragma once
/// Results, measurement sets or tires side by side: docs/compare.md.

#include <optional>
#include <string>
#include <vector>

#include "bad_rows.h"
#include "progress.h"
#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// What is compared: folders that a run wrote, measurement sets, or tires.
enum class ComparedKind { kResults, kSets, kTires };

struct CompareInput {
  std::vector<std::string> compared;  // two or more, all of one kind: folders, or names or files of tires. The first is
                                      // the reference
  std::string scenario;               // of tires: a virtual test beside that of ISO 28580; empty: none
  BadRows bad_rows = BadRows::kRefuse;  // of sets
  int threads = 0;                      // of the virtual tests of tires; 0: as many as the machine has
};

/// An input that is not the same in all.
struct DifferentInput {
  std::string name;                 // "settings.pressure_kPa"
  std::vector<std::string> values;  // of each of the compared; empty where it has none
};

/// What one of the compared differs by from the reference, in the unit of the value.
struct Difference {
  std::optional<double> value;    // none where one of the two has no value
  std::optional<double> percent;  // of the reference's value; none where that is 0, of temperatures, and of percentages
  std::optional<double> sd;       // standard uncertainty of the difference
  std::optional<double> low_95;
  std::optional<double> high_95;
  std::string why_no_interval;  // empty where there is one
};

struct ComparedValue {
  std::string name;   // key of the result, of the column or of the tire file
  std::string place;  // of a set the run and its phase, of a tire the test; empty for others
  std::string label;  // in words, without the unit
  std::string unit;   // its symbol; empty for ratios
  std::string doc;
  std::vector<std::optional<double>> values;  // of each of the compared
  std::vector<Difference> differences;        // of each but the reference
};

struct EnergyStep {
  std::string name;  // of a term of the energy audit
  double energy_J = 0.0;
};

/// What changes an energy from that of the reference to that of another: start + all steps = end.
struct EnergyWaterfall {
  std::string compared;  // whose energy is at the end
  std::string term;      // what brings energy in: "motor"
  double start_J = 0.0;
  std::vector<EnergyStep> steps;
  double end_J = 0.0;
  std::vector<std::string> missing = {};  // terms that one of the two does not have: they count as 0 there
};

/// Its files: comparison.json, differences.csv.
struct Comparison : Report {
  ComparedKind kind = ComparedKind::kResults;
  std::vector<std::string> names;  // of the compared, all different
  std::string message;             // the main difference as a sentence
  std::vector<DifferentInput> inputs;
  std::vector<ComparedValue> values;
  std::vector<EnergyWaterfall> waterfalls;  // of each but the reference, where results have an energy audit
  std::vector<std::string> method;          // how intervals are found, and what is taken to be common, a sentence each
  std::vector<std::string> warnings;        // what could not be compared, a sentence each
};

/// Compares all with the first.
/// Errors  InputError: fewer than two; one that is not there or of another kind than the first; one given twice;
///         results of different scenarios; a wrong file. RunFailure: a virtual test fails. Interrupted
Comparison compare(const CompareInput& input, const Progress& progress = {});

}  // namespace rollrig
#pragma GCC visibility pop
