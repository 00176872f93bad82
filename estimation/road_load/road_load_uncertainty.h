#pragma once
/// A, B and C of coastdowns as a measurement, for their uncertainty.

#include "estimation/road_load/coastdown_file.h"
#include "estimation/road_load/road_load_fit.h"
#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// Scatter of the runs by the covariance of the fit, and the instruments behind it.
/// Equation  A = m/m_0 g k/k_0 (A_0 + a), B = m/m_0 k/k_0 (B_0 + b), C = m/m_0 q_0/q (C_0 + c) / g
///           k = 1 + K_0 (T - T_ref), q = p/T, (a, b, c) = L k z with L L^T the covariance of the fit
/// Symbols   m effective mass [kg] from test mass and rotating mass; g gain of the speed; K_0 fall of A and B [1/K];
///           T, p mean temperature [K] and pressure [Pa] of the air over the samples; index 0: as in the fit; k z
///           as in make_scatter_inputs(), with the fewest degrees of freedom of the three coefficients
/// Validity  weather that does not change much during the test; no coefficient on a bound of the fit. Mass enters
///           in forces alone, and the slope of the road not at all
/// Source    the equations of fit_road_load(). Uncertainties of the instruments are assumed, and marked so
/// Checked   tests/estimation/road_load_uncertainty_test.cpp, against fits with other numbers
MeasurementModel make_road_load_model(const CoastdownData& data, const RoadLoadFitOptions& options,
                                      const RoadLoadFit& fit);

}  // namespace rollrig::estimation
