#pragma once
/// Rows of CSV files that cannot be used: all of them in one message.

#include <string>
#include <vector>

#include "sim/core/error.h"

namespace rollrig {

/// What is wrong with rows of one file or of several, each with file, line, column (empty: the whole row), value and
/// what is allowed. A row with two wrong fields has two entries.
using RowProblems = std::vector<InputProblem>;

/// How many rows have a problem.
std::size_t count_rows(const RowProblems& problems);

/// Which of the times belong to the longest sequence that increases from row to row: the fewest rows are left out. Of
/// equal times, the first stays. Where of two neighboring rows either could belong to it, it is the one that fits even
/// steps better. NaN never belongs to it.
/// Checked  tests/core/rows_test.cpp
std::vector<bool> find_increasing(const std::vector<double>& times);

/// The problems as a table for each file: line, column, value and what is allowed. At most 20 rows of each file are
/// shown, and the number of the others. `hint`, where what is allowed ends with it, is not repeated in each row.
std::string format_row_problems(const RowProblems& problems, const std::string& hint);

/// Their error. One problem stands for itself, with `remedy` beside what is allowed; several are listed below
/// `what`.
InputError make_rows_error(const std::string& what, const RowProblems& problems, const std::string& remedy,
                           const std::string& hint);

}  // namespace rollrig
