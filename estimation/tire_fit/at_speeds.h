#pragma once
/// What a set decides of a tire at the speeds at which it was measured, however uncertain the fitted numbers are alone.

#include <Eigen/Core>
#include <vector>

#include "estimation/tire_fit/fit_unknowns.h"
#include "estimation/tire_fit/set_variety.h"

namespace rollrig::estimation {

/// A number with its standard uncertainty.
struct Uncertain {
  double value = 0.0;
  double sd = 0.0;
};

/// The fitted tire at one speed, at the set's mean load, pressure and liner temperature there.
struct AtSpeed {
  SpeedConditions at;
  Uncertain loss_N;               // on the reference drum
  Uncertain fall_per_K;           // relative fall of the loss with temperature
  Uncertain conductance_W_per_K;  // from the tire to its surroundings
  Uncertain time_constant_s;      // of the rubber against its surroundings
};

/// The fitted tire warm at one speed in air of one temperature, at the load and pressure of the set's nearest speed.
struct SteadyTire {
  SpeedConditions at;         // with the temperature that it then has
  double ambient_K = 0.0;     // of air and surface
  Uncertain loss_N;           // on the reference drum
  Uncertain rrc;              // loss over load
  Uncertain fall_per_K;       // relative fall of the loss with temperature
  Uncertain time_constant_s;  // of the warm-up
};

/// The fitted tire in steady state at 80 km/h in air of 25 degC, the conditions of ISO 28580.
/// Equation  F_rr(v, Fz, p, T) v = (z + f v) (T - T_a); the others as of find_at_speeds
/// Symbols   T_a temperature of the air, T of the tire; all loss heats the tire
/// Validity  the gas has the tire's temperature; the pressure is the set's, as warm as it was there
/// Checked   tests/estimation/one_warm_up_test.cpp
SteadyTire find_steady_tire(const measurements::MeasurementSet& set, const FitUnknowns& unknowns,
                            const std::vector<double>& found, const Eigen::MatrixXd& covariance);

/// The fitted tire at each speed of the set.
/// Equation  F = F_rr(v, Fz, p, T),  b = -(dF/dT)/F,  g = z + f v,  tau = C/g;  s^2 = (dx/dp) S (dx/dp)^T
/// Symbols   F loss [N], b its fall [1/K], g conductance [W/K], tau time constant [s]; C heat capacity of the rubber
///           [J/K]; p fitted numbers, S their covariance, x any of F, b, g, tau, s its standard uncertainty
/// Validity  T is the temperature that the law sees
/// Checked   tests/estimation/one_warm_up_test.cpp
std::vector<AtSpeed> find_at_speeds(const measurements::MeasurementSet& set, const FitUnknowns& unknowns,
                                    const std::vector<double>& found, const Eigen::MatrixXd& covariance);

}  // namespace rollrig::estimation
