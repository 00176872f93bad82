#pragma once
/// Units that a log says of its columns, held against those of the mapping.

#include "measurements/logs/mapping.h"
#include "tables/log_table.h"

namespace rollrig::measurements {

/// Throws InputError where a column of the mapping is one that is not read, or in another unit by the file than by the
/// mapping. Not checked: a column with a factor or an offset of the mapping, and a unit that is not known.
/// Checked  tests/measurements/logs/file_units_test.cpp
void require_units(const LogForm& form, const tables::LogTable& table);

}  // namespace rollrig::measurements
