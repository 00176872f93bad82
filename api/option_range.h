#pragma once
/// Limits of numbers that a user gives, the same on the command line, in C++ and in Python.

#include <string>

namespace rollrig {

/// Limits in the unit of the command line's option.
struct OptionRange {
  const char* option;  // "--mass"
  double lowest;
  double highest;
  const char* unit;  // "kg"; empty for a count
};

/// Throws InputError for a number that is not within the limits, NaN included. `value` is in the unit of the option. A
/// number may exceed a limit by 1e-12 of the larger limit, for the rounding of converted units.
void require_within(const OptionRange& range, double value);

/// Throws InputError for a number of threads below 0 or above 1024. 0: as many as the machine has.
void require_threads(int threads);

}  // namespace rollrig
