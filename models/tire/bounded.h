#pragma once
/// What the law of the model "bounded" allows of its numbers.

#include "models/tire/tire.h"

namespace rollrig::models {

/// Margins of the numbers to the limits of the law. A file is refused where fall_at_rest, fall_at_high_speed or
/// speed_rise is below 0; least_speed_rise is the limit of the speed rise itself.
struct BoundedMargins {
  double fall_at_rest = 0.0;        // the fall with temperature at standstill, relative to that at 80 km/h
  double fall_at_high_speed = 0.0;  // the same at high speed
  double least_speed_rise = 0.0;    // the speed rise with which the loss falls with speed at no temperature
  double speed_rise = 0.0;          // that of the tire less the least
};

/// Equation  fall at rest 1 - c S_80, at high speed 1 + c (1 - S_80);
///           least s = max of B c (theta - theta(30 degC)) at theta = 0 and theta = T_h - T_m
/// Symbols   those of the model: `rollrig describe` and models/tire/bounded.cpp
/// Checked   tests/models/tire_file_test.cpp
BoundedMargins calc_bounded_margins(const OwnParameters<double>& own);

}  // namespace rollrig::models
