#pragma once
/// The file of an alignment: a row for each measurement of a tire on a machine.

#include <optional>
#include <string>
#include <vector>

#include "estimation/alignment/alignment_rows.h"
#include "estimation/alignment/alignment_rules.h"
#include "include/rollrig/align.h"

namespace rollrig::estimation {

/// One tire on one machine, in the order of time.
struct TireMeasurements {
  std::vector<AlignmentMeasurement> all;

  std::vector<double> used() const;
  double mean() const;
};

/// An alignment tire.
struct AlignmentTire {
  std::string name;
  std::string tire_class;
  TireMeasurements candidate;
  TireMeasurements reference;     // empty where the file has no machine of reference
  double reference_N_per_kN = 0;  // mean of these, or as given
};

/// A control tire on one machine, in the order of time.
struct ControlTire {
  std::string name;
  std::vector<AlignmentMeasurement> measurements;
};

/// Rows of a machine that is neither candidate nor reference, and measured too little to be one.
struct UnusedRows {
  std::string machine;
  std::vector<int> lines;
  std::size_t controls = 0;  // of control tires
};

struct AlignmentFile {
  std::string path;
  std::string machine;            // empty where the file names none
  std::string reference_machine;  // likewise
  bool is_assigned = false;       // values of the network, so that A1 and B1 are within
  AlignmentRules rules;
  std::vector<AlignmentTire> tires;  // by mean on the candidate machine
  std::vector<ControlTire> controls;            // of the candidate machine
  std::vector<ControlTire> reference_controls;  // of the reference machine
  std::vector<UnusedRows> unused;
  double first_s = 0.0, last_s = 0.0;  // of the alignment tires on the candidate machine
  double newest_s = 0.0;               // of all rows of that machine
  double complete_s = 0.0;             // last measurement that the alignment uses, on either machine
  std::vector<std::string> inputs;     // paths
};

/// All values of the alignment tires on the candidate machine.
std::vector<double> list_candidate_values(const AlignmentFile& file);
/// Step to which the values of one side are rounded; of the reference, that of its measurements or, without them, of
/// the given values. 0 where there is none.
double find_candidate_step(const AlignmentFile& file);
double find_reference_step(const AlignmentFile& file);

/// Errors  InputError: as align(), but for the rules of an alignment; too few measurements for a mean and its scatter
AlignmentFile read_alignment_file(const AlignmentInput& input);

/// "2026-03-02".
std::string format_day(double time_s);
/// The same day some years later; of 29 February, 28 February where there is no 29th.
double add_years(double time_s, int years);

}  // namespace rollrig::estimation
