#pragma once
/// An alignment, and a value aligned with it, as measurements, for their uncertainty.

#include "estimation/alignment/alignment.h"
#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// A2, B2, and the aligned values of further tires at the ends and the middle of the range, each measured once.
///
/// Each evaluation fits the line again, to means that have the errors of its inputs.
/// Equation  x_i = X_i + u_x k_x z_i,  y_i = A2 X_i + B2 + u_y k_y w_i,  u_y^2 = max(0, s^2 - A2^2 u_x^2);
///           RRC = A1 (A2 (x + e) + B2) + B1 + A1 d
/// Symbols   X_i means of the tires on the candidate machine, u_x their standard deviation by the repeats; s scatter about
///           the line; k z, k w as in make_scatter_inputs(); e scatter of the one measurement (sigma_m), d what tires
///           differ by beside the line (tau of fit_line)
/// Validity  without the uncertainty of A1 and B1, which their laboratory has to state
/// Source    the equations of fit_line() and align_value(), to which the budget is equal to first order
/// Checked   tests/estimation/alignment_uncertainty_test.cpp
MeasurementModel make_alignment_model(const AlignmentResult& result);

/// One aligned value: the mean of so many measurements on the candidate machine.
/// Equation  RRC = A1 (L + A2' (x + e - mean_x)) + B1 + A1 d
/// Symbols   L and A2' the line at mean_x and its slope, with standard deviations s/sqrt(p) and s/sqrt(Sxx), independent of
///           each other; e, d as above
/// Source    the equations of align_value()
/// Checked   tests/estimation/alignment_uncertainty_test.cpp
MeasurementModel make_aligned_value_model(const AlignmentLine& line, double rrc_N_per_kN, int measurements);

}  // namespace rollrig::estimation
