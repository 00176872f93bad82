#pragma once
/// Units as a person or a logger writes them.

#include <string>
#include <vector>

#include "sim/core/units.h"

namespace rollrig {

/// The unit that a text names, for values of the unit `wanted`: a suffix of a key ("km_h", "kPa"), or what UDUNITS
/// knows ("psi", "mile/hour", "kgf"), or one of the further names mph, kph, lbf ft, °C, °F and their like.
///
/// Errors   std::invalid_argument, which says what is wrong: an unknown unit; a unit of another dimension, with both
///          dimensions; a name that says gauge or absolute pressure
/// Checked  tests/core/unit_names_test.cpp
/// Source   UDUNITS 2, the unit database of Unidata
Unit parse_unit(const std::string& text, const Unit& wanted);

/// Whether a text is a suffix of a key, or a unit that UDUNITS knows, of whatever dimension.
bool is_known_unit(const std::string& text);

/// Usual names of the units of a dimension, for messages; none for one that has none.
std::vector<std::string> list_unit_names(const Dimension& dimension);

/// "force (kg m s^-2)"; the base units alone where the dimension has no name.
std::string describe_dimension(const Dimension& dimension);

}  // namespace rollrig
