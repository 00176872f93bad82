#pragma once
/// A mistake at one or two tires that keeps the tires off their line: a bad tire, or two that are exchanged.

#include <cstddef>
#include <optional>

#include "estimation/alignment/line_fit.h"

namespace rollrig::estimation {

/// Two points whose values of one machine belong to each other.
struct LineExchange {
  std::size_t first = 0, second = 0;  // among the points of the fit
  double lack_of_fit_p = 1.0;         // of the line of all points after the exchange
};

/// At most one of both.
struct LineMistake {
  std::optional<LineOutlier> outlier;
  std::optional<LineExchange> exchange;
};

/// The one mistake without which a line describes the points within their repeats.
///
/// Equation  p = P(F >= s_r^2/s_w^2) of fit_line(), for all points, without each one, and with the values of each pair
///           exchanged. A point is bad, if p < 0.005 for all points, p > 0.05 without it, and p < 0.005 without any
///           other one. Else a pair is exchanged, if p > 0.05 after its exchange, and p < 0.005 after any other one.
///           Else find_line_outlier()
/// Validity  `repeats` are of both machines; find_line_outlier() alone judges, if they have no degrees of freedom. Five
///           points at least for a bad one. The scaled residual of a bad point, and the difference of the values of an
///           exchanged pair, is larger than `least_size`: real scatter about the line is no mistake. A line that falls
///           describes nothing
/// Assumed: 0.005 and 0.05, as elsewhere in an alignment
/// Checked   tests/estimation/alignment_test.cpp
LineMistake find_line_mistake(const LineFit& fit, const RepeatScatter& repeats, double least_size);

}  // namespace rollrig::estimation
