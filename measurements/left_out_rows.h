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
  std::size_t file_rows = 0;  // of the file, with those of another length
};

/// What was left out of a file, since it could not be used.
struct LeftOutRows : FileProblems {
  std::size_t rows = 0;    // left out
  std::size_t fields = 0;  // fields of other rows, left empty
};

/// The error of all bad rows of files that are read together.
InputError make_bad_rows_error(const std::vector<FileProblems>& files, const std::string& hint);

/// Throws InputError if the bad rows are more than 5 % of the file (and than one row); `of` names it: "run 'a'".
/// Source  Assumed: the limit
void require_few_bad_rows(const FileProblems& file, const std::string& of, const std::string& hint);

/// What was left out, in a sentence; `of` names it: " of run a", or is empty. `field` is one that was left empty.
std::string describe_left_out(const LeftOutRows& out, const std::string& of, const std::string& file,
                              const std::string& field);

/// The same with each bad row, for programs.
Json make_left_out_json(const LeftOutRows& out, const std::string& file);

}  // namespace rollrig::measurements
