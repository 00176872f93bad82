#pragma once
/// An alignment, and a value aligned with it, as measurements, for their uncertainty.

#include "estimation/alignment/alignment.h"
#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// A2, B2, and the aligned values of further tires at the ends and the middle of the range, each measured once.
///
/// Each evaluation fits the line again, to means that have the errors of its inputs.
/// Equation  x_i = X_i + u_x k_x z_i,  y_i = A2 X_i + B2 + u_y k_y w_i,  u_y^2 = max(0, s^2 - A2^2 u_x^2);
///           RRc = A1 (A2 (x + e) + B2 + d) + B1
/// Symbols   X_i means of the tires on the candidate machine, u_x their standard deviation by the repeats; y_i values of
///           the reference machine; s scatter about the line; k_x z_i and k_y w_i as in make_scatter_inputs(); x a
///           measured value, e its scatter (sigma_m); d tire-to-tire scatter about the line (tau of fit_line). Inputs
///           and results are N/N, the line is in N/kN
/// Validity  without the uncertainty of A1 and B1, which their laboratory has to state
/// Source    the equations of fit_line() and align_value(), to which the budget is equal to first order
/// Checked   tests/estimation/alignment_uncertainty_test.cpp
MeasurementModel make_alignment_model(const AlignmentResult& result);

/// One aligned value: the mean of `measurements` measurements on the candidate machine.
/// Equation  RRc = A1 (L + a (x + e - mean_x) + d) + B1
/// Symbols   L value of the line at mean_x, a its slope, with standard deviations s/sqrt(p) and s/sqrt(Sxx),
///           independent of each other, s^2 = A2^2 u_x^2 + u_y^2; e, d as above
/// Source    the equations of align_value()
/// Checked   tests/estimation/alignment_uncertainty_test.cpp
MeasurementModel make_aligned_value_model(const AlignmentLine& line, double rrc_N_per_kN, int measurements);

}  // namespace rollrig::estimation
