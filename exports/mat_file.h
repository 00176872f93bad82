#pragma once
/// MATLAB's .mat (version 5). The only place of the project that knows the library.

#include <string>

#include "exports/tree.h"

namespace rollrig::exports {

/// The bytes of a .mat file: a member of `tree` is a variable. A Group is a struct, a table one with the struct `units`
/// (the unit of every member whose name says one) as its last field; a Column and Texts are columns (double, cell), a
/// flag is logical, a List a cell. Names are made MATLAB's: letters, digits and '_', a letter first, 63 at most. The
/// same tree gives the same bytes.
/// Errors   InputError where a variable is larger than the format holds (2 GB)
/// Checked  tests/exports/mat_file_test.cpp
std::string make_mat(const Group& tree);

}  // namespace rollrig::exports
