#include "measurements/logs/file_units.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "sim/core/unit_names.h"

namespace rollrig::measurements {
namespace {

bool is_same(const Unit& a, const Unit& b) {
  constexpr double kSame = 1e-9;
  return a.dimension == b.dimension && std::abs(a.factor - b.factor) <= kSame * std::abs(b.factor) &&
         std::abs(a.offset_SI - b.offset_SI) <= kSame * std::abs(b.offset_SI);
}

/// Texts of a file in Latin-1 have a degree sign of one byte.
std::string to_utf8(std::string text) {
  if (text ==
      "\xb0"
      "C")
    text = "\u00b0C";
  return text;
}

/// Whether a text names another unit than that of the mapping; a text that names no unit does not.
bool contradicts(const std::string& text, const Unit& of_mapping) {
  if (!is_known_unit(text)) return false;
  try {
    return !is_same(parse_unit(text, of_mapping), of_mapping);
  } catch (const std::invalid_argument&) {
    return true;  // of another dimension
  }
}

}  // namespace

void require_units(const LogForm& form, const tables::LogTable& table) {
  for (const LogColumn& column : form.columns) {
    if (table.not_read.count(column.column) > 0) {
      throw InputError({fmt::format("'{}' is an array, a text, or has a conversion that is not linear", column.column),
                        table.rows.path(), 0, column.column, "", "a channel of numbers", ""});
    }
    const auto said = table.units.find(column.column);
    if (said == table.units.end() || column.factor != 1.0 || column.offset != 0.0) continue;
    if (!contradicts(to_utf8(said->second), column.unit)) continue;
    throw InputError({fmt::format("'{}' is in {} by the file, and in {} by the mapping", column.column, said->second,
                                  column.unit.symbol),
                      table.rows.path(), 0, column.column, said->second,
                      fmt::format("the unit in [{}.columns], or factor and offset there", form.name), ""});
  }
}

}  // namespace rollrig::measurements
