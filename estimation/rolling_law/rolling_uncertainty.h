#pragma once
/// What the laws of SAE J2452 and SAE J1269 say of a tire as measurements, for their uncertainty.

#include <optional>

#include "estimation/rolling_law/rolling_output.h"
#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// Exponents of pressure and load and, with a reference condition, its forces and its coefficient.
///
/// Each evaluation fits the law again, to points that have the errors of its inputs.
/// Equation  F_i = g (f_i + s k z_i) + f_0,  P_i = p_i + p_0,  Z_i = G z_i,  v_i = w_i + w_0
/// Symbols   f_i force of the law at the point, s standard deviation of the residuals, k z_i scatter as in
///           make_scatter_inputs(); common to all points: gain g and zero f_0 of the force, error p_0 of the pressure,
///           gain G of the load, error w_0 of the speed
/// Validity  the law describes the tire; points without trend from one to the next. a, b and c are not among the
///           results: they are the force at 1 kPa, 1 N and standstill, far from every point
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
