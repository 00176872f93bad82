#pragma once
/// Stretches of a run whose samples were not measured but interpolated.

#include <string>
#include <vector>

#include "diagnosis/checks/stuck_sensors.h"

namespace rollrig::diagnosis {

/// Stretches that were interpolated, and the samples that they spoil.
struct Interpolated {
  std::vector<DoubtfulRows> rows;     // of measured channels
  std::vector<std::string> warnings;  // a sentence for each stretch
};

/// Finds stretches in which a measured channel that scatters elsewhere follows a straight line or a cubic exactly.
///
/// Equation  A row is smooth where |y - p| <= r (1 + sum |w|)/2, p = sum w y_k the line through its two neighbors, or
///           the cubic through four. A stretch has n >= max(10, ln(10^4 N)/-ln q) smooth rows, and the rows beside it
///           deviate from such lines by three times the limit and by 0.1 times what the noise of the sensor makes
/// Symbols   r step of the column's numbers in the file, and 0.02 of its usual deviation at least; N rows of the column
///           in the set; q the share of them that is smooth, those left out where all three numbers are the same
/// Validity  A column without scatter of its own tells nothing: a speed held by a controller, a temperature rounded to
///           tenths, a simulated set without noise. A stretch at one number is for stuck_sensors.h.
/// Left out  The measured samples of the stretch. Where a given column (such as the speed on the road) is smooth as
///           well, the inputs are unknown: the stretch has all rows in which it is, and all measured channels are left
///           out. The state of the tire is carried on with the inputs as they are. After more than 300 s of that it is
///           not known any more, and the run ends there.
/// Source    Assumed: all limits. 300 s is about a third of a tire's time constant
/// Checked   tests/diagnosis/interpolated_test.cpp
Interpolated find_interpolated(const measurements::MeasurementSet& set);

/// Rows of a run, both ends included.
struct SmoothRows {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Step of the numbers of a column, in its SI unit: the power of ten of which all are multiples, 1e-9 of the largest
/// where there is none.
double find_step(const measurements::MeasurementSet& set, const Quantity& column);

}  // namespace rollrig::diagnosis
