#pragma once
/// Results, measurement sets and recordings as files for MATLAB and Python. Content of the files: docs/export.md.

#include <functional>
#include <string>
#include <vector>

#include "bad_rows.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// Makes the bytes of a file. The same source gives the same bytes.
struct Export {
  std::function<std::string()> make_mat;  // MATLAB, version 5; throws InputError for a variable of more than 2 GB
  std::function<std::string()> make_hdf5;
  std::vector<std::string> warnings = {};  // about rows that were left out, a sentence each
};

/// Reads a result folder (of `rollrig run --out`), a measurement set (its folder or set.toml), or a recording.csv.
/// `bad_rows` is for a set.
/// Example  write_folder("exported", {{"run.mat", read_export("results").make_mat()}});
/// Errors   InputError: none of these; a file is missing or wrong
Export read_export(const std::string& source, BadRows bad_rows = BadRows::kRefuse);

}  // namespace rollrig
#pragma GCC visibility pop
