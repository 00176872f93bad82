#pragma once
/// Numbers of a sweep's document (rollrig-sweep/1) whose results are flat (scenarios::flatten_results), and what
/// follows from them.

#include <string>
#include <vector>

#include "sim/core/json.h"

namespace rollrig::report {

/// Settings that are varied, in their order.
std::vector<std::string> list_sweep_axes(const Json& sweep);
/// Whether all values of an axis are numbers.
bool is_numeric_axis(const Json& sweep, const std::string& axis);
/// Name of an axis as a person reads it: "pressure" of "pressure_kPa".
std::string name_axis(const std::string& axis);

/// The value of an axis at a point, as it was written.
std::string axis_text(const Json& point, const std::string& axis);
double axis_value(const Json& point, const std::string& axis);
/// A result at a point; NaN where it has none.
double result_value(const Json& point, const std::string& key);
/// The same at all points.
std::vector<double> list_results(const Json& sweep, const std::string& key);

/// The results that are drawn where none is named: those of choose_charts() that are neither proportional to one before
/// them nor to what is varied.
std::vector<std::string> choose_drawn_results(const Json& sweep);

/// How strongly results depend on what was varied.
///
/// Equation  percent = 100 step (sum (x - x_m) (y - y_m) / sum (x - x_m)^2) / y_m: the straight line of least squares
///           through all points, per `step` of the setting, in percent of the mean result
/// Shape     a record for each of `keys` and each axis of numbers: result, varied, per ("10 kPa"), percent; with three
///           values or more also lowest_percent and highest_percent, the slopes from a value to the next of the means
///           over the other axes, and is_straight, whether these differ by less than half of `percent`
/// Validity  a full grid: no record where a point has no result
/// Checked   tests/report/tiles_test.cpp
Json list_sensitivities(const Json& sweep, const std::vector<std::string>& keys);

}  // namespace rollrig::report
