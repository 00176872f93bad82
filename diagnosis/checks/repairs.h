#pragma once
/// Mistakes that people make with columns and units, tried out on a run that cannot be what it is said to be.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/checks/plausibility.h"

namespace rollrig::diagnosis {

/// A mistake that, undone, makes runs plausible.
struct Repair {
  std::string text;                                      // "speed_km_h holds m/s"
  std::function<bool(measurements::MeasuredRun&)> undo;  // false where it cannot have been made in that run
  std::vector<std::size_t> runs = {};                    // in which it was made
};

/// A mistake with a unit that a kind of set is prone to: the numbers of the file, times `factor` and plus `offset`, in
/// the unit of the column, are right.
struct WrongUnit {
  Quantity column;
  double factor = 1.0;
  double offset = 0.0;
  std::string text;  // after the column's name
};
/// Those of columns that several kinds have: speed, load, pressure and temperatures.
std::vector<WrongUnit> list_common_wrong_units();

/// Which mistakes are tried: where a column stands still, a factor may fit it by chance.
enum class Mistakes { kAll, kExchanges };

/// Of the mistakes in the list (two columns exchanged; speed in m/s or multiplied by 3.6; load in kgf;
/// pressure absolute, in bar or psi; temperature in degF; torque too small by 3.6 or with the other sign) the one that,
/// undone in all of `odd_runs` and simulated again, brings every channel within its tolerance and the sum of squares
/// below a tenth; with it the other runs that it brings below a tenth. None where none does.
/// Validity  one mistake at a time, the same in all of `odd_runs`
/// Checked   tests/diagnosis/wrong_columns_test.cpp
std::optional<Repair> find_repair(const measurements::MeasurementSet& set, const std::vector<std::size_t>& odd_runs,
                                  Mistakes which, int threads);

}  // namespace rollrig::diagnosis
