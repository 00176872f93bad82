#pragma once
/// Mistakes that people make with columns and units, and how to undo them.

#include <functional>
#include <string>
#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

/// A mistake with a unit that a kind of set is prone to: the numbers of the file, times `factor` and plus `offset`, in
/// the unit of the column, are right.
struct WrongUnit {
  Quantity column;
  double factor = 1.0;
  double offset = 0.0;
  std::string text;     // after the column's name
  double weight = 1.0;  // how often it is made, beside the others. Assumed
};
/// Those of columns that several kinds have: speed, load, pressure and temperatures.
std::vector<WrongUnit> list_common_wrong_units();

/// Those of a column that should hold what another factor away was written to: a torque in the place of a force, or a
/// force in that of a torque. None where `factor` is so near to 1 that an effect may do the same.
std::vector<WrongUnit> list_mixed_up_lever(const Quantity& force, double factor, const std::string& text);

/// A mistake that may have been made in a run, or two.
struct Mistake {
  std::string text;               // "speed_km_h holds m/s"
  double weight = 1.0;            // how often it is made, beside the others
  std::vector<Quantity> columns;  // that hold other numbers because of it
  bool is_exchange = false;
  QuantityMap<double> log_factors = {};  // of columns in another unit: logarithm of the factor that undoes it
  std::function<bool(measurements::MeasuredRun&)> undo;  // false where it cannot have been made in that run
};

/// Two columns exchanged; a column in another unit, with the other sign, or with a torque in the place of a force;
/// times in minutes or milliseconds.
std::vector<Mistake> list_mistakes(const measurements::MeasurementSet& set);

/// Both mistakes in one run. They have no column in common.
Mistake combine(const Mistake& a, const Mistake& b);
bool have_common_column(const Mistake& a, const Mistake& b);

}  // namespace rollrig::diagnosis
