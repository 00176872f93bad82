#pragma once
/// Bad rows of CSV files: refused all at once, or left out, counted and reported.

#include <string>
#include <vector>

#include "sim/core/json.h"
#include "sim/core/rows.h"

namespace rollrig::measurements {

/// Bad rows of one file.
struct FileProblems {
  RowProblems problems;       // by line; empty where no row was bad
  std::size_t file_rows = 0;  // of the file, with those that have a wrong number of fields
};

/// What was left out of a file, and why.
struct LeftOutRows : FileProblems {
  std::size_t rows = 0;    // left out
  std::size_t fields = 0;  // fields of other rows, left empty
};

/// The error that lists all bad rows of files that are read together. `hint`: see format_row_problems().
InputError make_bad_rows_error(const std::vector<FileProblems>& files, const std::string& hint);

/// Throws InputError if more than one row and more than 5 % of the rows of a file are bad. `of` names the file in the
/// message: "run 'a'".
/// Source  Assumed: the limit
void require_few_bad_rows(const FileProblems& file, const std::string& of, const std::string& hint);

/// What was left out, in a sentence. `of` says of what: " of run a", or nothing. `field` is the word for a field.
std::string describe_left_out(const LeftOutRows& out, const std::string& of, const std::string& file,
                              const std::string& field);

/// The same with each bad row, for programs.
Json make_left_out_json(const LeftOutRows& out, const std::string& file);

}  // namespace rollrig::measurements
