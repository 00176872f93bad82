#pragma once
/// The rows of a run's file, and what becomes of those that cannot be used.

#include <string>
#include <vector>

#include "measurements/measurement_set.h"
#include "sim/core/json.h"

namespace rollrig::measurements {

/// What is known of a file beside the values of its rows.
struct RunFileRows : FileProblems {  // wrong fields are NaN, and rows of another length are no rows of the run
  std::vector<int> lines;            // of each row of the run
};

/// Reads the columns of a run from its file. Throws InputError for what is wrong with the file as a whole.
RunFileRows read_run_columns(const rigs::RunColumns& columns, MeasuredRun& run);

/// Refuses the bad rows of runs, or leaves them out.
///
/// A row is left out if an input or its time is bad, or if it has too few or too many fields. Then the inputs are
/// straight lines between the rows beside it, and the load keeps the value of the row before. The measured fields of
/// the rows beside it are left empty: they are means over an interval that the other rows no longer tell. If only
/// measured fields of a row are bad, these fields are left empty and the row stays.
/// Errors   InputError: bad rows, where they are refused; more of them than 5 % of a file (and than one row); no usable
///          row for longer than 5 s and than 2.5 intervals of the file
/// Source   Assumed: all limits
/// Checked  tests/measurements/bad_rows_test.cpp
void settle_bad_rows(const rigs::RunColumns& columns, BadRows bad_rows, const std::vector<RunFileRows>& files,
                     std::vector<MeasuredRun>& runs);

/// What was left out, a sentence for each run; none where nothing was.
std::vector<std::string> describe_bad_rows(const MeasurementSet& set);

/// The same with each bad row, for programs.
Json make_bad_rows_json(const MeasurementSet& set);

}  // namespace rollrig::measurements
