#pragma once
/// A machine aligned to a reference machine: the line, what it is worth, the rules, and when to align anew.

#include <optional>
#include <string>
#include <vector>

#include "estimation/alignment/alignment_file.h"
#include "estimation/alignment/control_tires.h"
#include "estimation/alignment/line_fit.h"
#include "estimation/alignment/line_mistake.h"
#include "include/rollrig/align.h"
#include "sim/core/json.h"

namespace rollrig::estimation {

struct AlignmentResult {
  LineFit fit;
  AlignmentLine line;
  ScatterEstimate sigma_m;                 // of the candidate machine
  std::optional<ScatterEstimate> sigma_l;  // of the reference machine, where its measurements are there
  RepeatScatter plain_repeats;             // of the means, without the rounding of the values
  std::size_t needed_measurements = 4;     // of each tire, at this sigma_m
  ControlMonitoring monitoring;            // of the candidate machine
  ControlMonitoring reference_monitoring;  // of the reference machine
  LineMistake mistake;                     // a tire off the line of the others, or two that are exchanged
  std::vector<AlignmentCheck> checks;
  std::vector<std::string> due_because;  // reasons to align anew; empty: none
  double valid_until_s = 0.0;
  double judged_on_s = 0.0;
  bool is_valid = false;
  bool is_of_network = false;  // A1 and B1 are given, or the values are those of the network
  std::vector<std::string> warnings;
};

/// Fit, uncertainty, rules.
/// Equation  RRc_l = A2 RRc_c + B2 over the means of the alignment tires; fit_line(), align_value()
/// Source    EU 2020/740 Annex V Sections 5 and 6; Section 6 as (EC) 1222/2009 Annex IVa Section 6 has it
/// Errors    InputError: rules that are broken, unless input.preliminary; a line that falls; a day that is none
/// Checked   tests/estimation/alignment_test.cpp
AlignmentResult align_machine(const AlignmentFile& file, const AlignmentInput& input);

/// A probability with two significant digits, with more where these would lie on the other side of the level: 0.0498,
/// not 0.050, where the level is 0.05.
std::string format_p_value(double p, double level);

/// A value in the range of the alignment tires, aligned, and the interval of 95 % of one measurement and of the mean of
/// three.
struct AlignedExample {
  double measured_N_per_kN = 0.0;
  double aligned_N_per_kN = 0.0;
  double expanded_of_one_N_per_kN = 0.0;
  double expanded_of_three_N_per_kN = 0.0;
};
/// Of the least, the middle and the greatest value of the alignment tires.
std::vector<AlignedExample> list_aligned_examples(const AlignmentResult& result);

/// `rollrig-alignment/1`.
Json make_alignment_json(const AlignmentFile& file, const AlignmentResult& result);
/// The numbers of such a document that a later value needs.
struct StoredAlignment {
  AlignmentLine line;
  std::string machine, classes;
  std::string valid_from;   // day of the last measurement that the alignment uses
  std::string valid_until;
  std::string last_control;  // day since which a control tire was not measured; empty without control tires
  double low_N_per_kN = 0.0, high_N_per_kN = 0.0;  // range of the tires on the candidate machine
  bool is_valid = false;
};
/// Errors  InputError: no such document, a key that is missing or wrong, keys that contradict each other
StoredAlignment read_alignment_json(const std::string& path);

/// A row for each measurement.
std::string make_measurement_csv(const AlignmentFile& file, const AlignmentResult& result);

}  // namespace rollrig::estimation
