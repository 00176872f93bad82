#pragma once
/// Libraries for binary files may crash on a damaged one, so they run in a process of their own.

#include <functional>
#include <string>

#include "tables/columns.h"

namespace rollrig::tables {

/// What `read` gives, called in a child process. Throws the InputError that `read` throws; InputError for a damaged file
/// where the child crashes or takes more than 10 minutes of processor time; InputError where the values take more than
/// kLargestTable_bytes; Interrupted.
/// Checked  tests/tables/log_table_test.cpp
Columns read_isolated(const std::string& path, const std::function<Columns(const std::string&)>& read);

}  // namespace rollrig::tables
