#pragma once
/// A machine aligned to a reference machine, as test laboratories do it for the EU tire label: docs/alignment.md.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "progress.h"
#include "result.h"
#include "uncertainty_options.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// What is to be aligned. Errors name a member as the option of the command line: reference_values as
/// "--reference-values".
struct AlignmentInput {
  std::string file;               // CSV with a row for each measurement
  std::string reference_values;   // CSV with the reference laboratory's value of each tire, where `file` has none
  std::string machine;            // the candidate machine; needed where the file has several
  std::string reference_machine;  // the machine of the file that is the reference
  std::optional<std::pair<double, double>> reference;  // A1, and B1 in N/kN; absent: 1 and 0
  bool preliminary = false;     // also a set of tires that breaks the rules for an alignment; it is then not valid
  bool first_excluded = false;  // the file already omits the first measurement of each tire, which is not used
  std::string on;  // day on which validity is judged, "2026-03-02"; empty: that of the candidate's last row
  std::string machine_changed;  // day of the last significant change of the machine; empty: none
};

/// A condition of the regulation, or of good statistics.
struct AlignmentCheck {
  std::string name;
  std::string found;
  std::string limit;
  std::string source;  // clause; "Second-hand" where the text itself was not read
  bool is_met = true;
  bool is_rule = true;     // of the regulation; else advice, which does not make the alignment invalid
  bool stops_fit = false;  // where it is not met, there is no alignment unless `preliminary` asks for one
};

/// RRc_aligned = A1 (A2 RRc_m + B2) + B1. Its files: alignment.json, measurements.csv; its test report
/// is the certificate.
struct Alignment : Report {
  ParameterEstimate A2;  // of the reference machine's value over the candidate's
  ParameterEstimate B2;  // N/kN
  double A1 = 1.0;       // of the network over the reference machine
  double B1_N_per_kN = 0.0;
  ParameterEstimate sigma_m;  // N/kN, standard deviation of one measurement of the candidate machine
  std::vector<AlignmentCheck> checks;
  std::string valid_until;     // "2028-03-01"
  bool is_valid = false;       // all rules are met, and nothing asks for a new alignment
  bool is_due = false;         // the machine has to be aligned anew
  bool is_of_network = false;  // whether A1 and B1 were given, or the reference values are those of the network
  std::vector<std::string> warnings;
};

/// Fits A2 and B2, checks the rules of EU 2020/740 Annex V, and watches control tires.
/// Errors  InputError: a wrong file; classes that do not go together; a value that is no RRc in N/kN; two measurements
///         of a tire at one time; a tire without a reference value, or the other way round; unless `preliminary`, fewer
///         than five tires, fewer than four measurements of a tire, or too narrow a range
Alignment align(const AlignmentInput& input, const UncertaintyOptions& uncertainty = {}, const Progress& progress = {});

/// A measured value that is to be aligned.
struct AlignedValueInput {
  std::string alignment;      // alignment.json
  double rrc_N_per_kN = 0.0;  // measured, at 25 degC and for the 2 m drum
  int measurements = 1;       // whose mean it is
  std::string on;             // day on which validity is judged, "2026-03-02"; empty: today
  std::string tire_class;     // "C3": refused where the alignment is not of this class; empty: not checked
};

/// An aligned value with its expanded uncertainty (95 %).
struct AlignedValue : Report {
  ParameterEstimate rrc;  // N/kN
  bool is_valid = false;  // the alignment meets its rules, and the day is one on which it holds
  std::vector<std::string> warnings;
};

/// RRc_aligned = A1 (A2 RRc_m + B2) + B1. Its uncertainty holds the line, what tires differ by beside it, and the
/// scatter of `measurements` measurements; that of A1 and B1 is not included.
/// Validity  the range of the alignment tires, from its last measurement until the day in the file; beyond them a
///           warning says so
/// Source    EU 2020/740, Annex V, Section 6
/// Errors    InputError: a wrong file or day, one that was changed by hand, a class that is not that of the alignment,
///           a value that is no RRc in N/kN, fewer than one measurement
AlignedValue apply_alignment(const AlignedValueInput& input, const UncertaintyOptions& uncertainty = {},
                             const Progress& progress = {});

}  // namespace rollrig
#pragma GCC visibility pop
