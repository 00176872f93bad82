#pragma once
/// Units that a log says of its columns, held against those of the mapping.

#include <optional>
#include <string>

#include "measurements/logs/mapping.h"
#include "tables/log_table.h"

namespace rollrig::measurements {

/// A unit as loggers write it, such as "km/h", "N m", "\u00b0C"; none where it is not known.
std::optional<Unit> find_logged_unit(const std::string& text);

/// Throws InputError where a column of the mapping is one that is not read, or in another unit by the file than by the
/// mapping. A column with a factor or an offset of the mapping is not checked, and a unit that is not known neither.
/// Checked  tests/measurements/logs/file_units_test.cpp
void require_units(const LogForm& form, const tables::LogTable& table);

}  // namespace rollrig::measurements
