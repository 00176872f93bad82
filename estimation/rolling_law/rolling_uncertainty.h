#pragma once
/// What the laws of SAE J2452 and SAE J1269 say of a tire as measurements, for their uncertainty.

#include <optional>

#include "estimation/rolling_law/rolling_output.h"
#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// Exponents of pressure and load and, with a reference condition, its forces and its coefficient.
///
/// Each evaluation fits the law again, to points that have the errors of its inputs.
/// Equation  F'_i = g (F_i + s k z_i) + dF,  p'_i = p_i + dp,  Z'_i = G Z_i,  v'_i = v_i + dv
/// Symbols   F_i force of the law at point i [N]; s standard deviation of the residuals [N], k z_i as in
///           make_scatter_inputs(); p_i pressure [Pa], Z_i load [N], v_i speed [m/s]; errors common to all points: gain
///           g of the force, error dF of the parasitic loss that was subtracted [N], error dp of the pressure [Pa],
///           gain G of the load, error dv of the speed [m/s]
/// Validity  the law describes the tire; points without trend from one to the next. A constant zero of the force is in
///           the parasitic loss as well and cancels. The coefficients a, b and c are not among the results: a is the
///           force at 1 kPa, 1 N and standstill, far from every point, and all three move with the exponents
/// Errors    InputError: no degree of freedom is left for the scatter
/// Source    the equations of fit_j2452(). Uncertainties of the instruments are assumed, and marked so
/// Checked   tests/estimation/rolling_uncertainty_test.cpp
MeasurementModel make_j2452_model(const RollingTest& test, const J2452Fit& fit,
                                  const std::optional<J2452Reference>& reference);

/// Force and coefficient at the reference condition or, without one, at the mean load and pressure of the points.
/// Otherwise as make_j2452_model(), without an error of the speed, which the law does not have.
MeasurementModel make_multipoint_model(const RollingTest& test, const MultipointFit& fit,
                                       const std::optional<MultipointReference>& reference);

}  // namespace rollrig::estimation
