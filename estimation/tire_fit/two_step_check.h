#pragma once
/// Whether the two-step regression and the joint fit say the same.

#include <string>
#include <vector>

#include "estimation/tire_fit/at_speeds.h"
#include "estimation/tire_fit/two_step.h"

namespace rollrig::estimation {

/// A warning for each speed at which both differ by more than three times their uncertainty: in the fall of the loss
/// with temperature, which the first step reads off torque and temperature without any heat balance, or in the
/// conductance, which the second step finds with the heat capacities of the joint fit. Both methods see the same data,
/// so that a difference comes from a model that lacks something, or from a number that was held.
/// Equation  |x_two - x_joint| > 3 sqrt(s_two^2 + s_joint^2)
/// Symbols   x fall [1/K] or conductance [W/K] at one speed, s its standard uncertainty: of the joint fit from its
///           covariance, of the two-step regression from its scatter when the errors of the sensors are added to the
///           data again
/// Source    Assumed: 3; the regression then errs by chance in less than one set of a hundred
/// Checked   tests/estimation/two_step_test.cpp
std::vector<std::string> compare_two_steps(const measurements::MeasurementSet& set, const models::TireFile& fitted,
                                           const std::vector<AtSpeed>& joint);

}  // namespace rollrig::estimation
