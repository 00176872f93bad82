#pragma once
/// Units as people write them over the columns of a log.

#include <optional>
#include <string>
#include <vector>

#include "sim/core/quantity.h"

namespace rollrig::measurements {

/// A unit as a mapping writes it: number * factor + offset is in the unit of the suffix.
struct GuessedUnit {
  std::string suffix;  // "km_h", "kPa"; empty for revolutions per minute
  double factor = 1.0;
  double offset = 0.0;
  std::string written;  // as the log has it: "psi"

  bool is_rpm() const { return suffix.empty(); }
  bool is_of(const Quantity& quantity) const;
  /// A number of the log in the unit that files of rollrig have for the quantity.
  double convert(double number, const Quantity& quantity) const;
};

/// The unit of a text such as "km/h", "°C", "bar(a)". Pressures named absolute are made gauge against the standard
/// atmosphere.
std::optional<GuessedUnit> find_unit(const std::string& text);

/// Spellings of units that a quantity may have, one for each unit, for messages and for guesses by the size of values.
std::vector<GuessedUnit> list_units(const Quantity& quantity);

/// A heading taken apart: "Druck (bar)" is the name "Druck" and the unit bar.
struct HeadingParts {
  std::string name;
  std::optional<GuessedUnit> unit;
  std::string unknown_unit;  // a text in the place of the unit that is none that rollrig knows
};

/// A unit may stand in brackets, after "in", after a slash, a blank or an underscore; `unit_cell` is that of a row of
/// units, and may be empty.
HeadingParts split_heading(const std::string& heading, const std::string& unit_cell);

}  // namespace rollrig::measurements
