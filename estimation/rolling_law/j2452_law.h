#pragma once
/// The law of SAE J2452, and its mean over a drive cycle.

#include <vector>

#include "estimation/rolling_law/rolling_points.h"

namespace rollrig::estimation {

/// Rolling resistance of a warm tire over pressure, load and speed.
/// Equation  F = P^alpha Z^beta (a + b v + c v^2)
/// Symbols   F rolling resistance [N], P gauge pressure [kPa], Z load [N], v speed [km/h]; the coefficients belong to
///           these units
/// Validity  the range of the points from which it was fitted
/// Source    SAE J2452, second-hand: 40 CFR 1037.528(h)(6), with an example that the test below reproduces
/// Checked   tests/estimation/rolling_law_test.cpp
struct J2452Law {
  double alpha = 0.0;
  double beta = 1.0;
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;

  double calc_force_N(double pressure_Pa, double load_N, double speed_m_s) const;
};

/// Means over the distance of a drive.
struct SpeedMoments {
  double distance_m = 0.0;
  double mean_m_s = 0.0;           // of v
  double mean_square_m2_s2 = 0.0;  // of v^2
};

/// Equation  <v^n> = int v^n v dt / int v dt, with straight lines between the times, by Simpson's rule, which is exact
///           for them
SpeedMoments calc_speed_moments(const std::vector<double>& time_s, const std::vector<double>& speed_m_s);

/// Mean of moments, by weight.
SpeedMoments mix_moments(const SpeedMoments& first, double weight, const SpeedMoments& second);

/// The mean equivalent rolling force (MERF): work of rolling resistance over the distance of a drive. The law is
/// quadratic in speed, so that the two moments are all that it takes of the drive.
/// Equation  MERF = int F v dt / int v dt = P^alpha Z^beta (a + b <v> + c <v^2>)
/// Source    SAE J2452, second-hand: https://grokipedia.com/page/sae_j2452 has the purpose; the mean over distance,
///           and not over time, is assumed, since it gives the energy of the drive
double calc_mean_force_N(const J2452Law& law, double pressure_Pa, double load_N, const SpeedMoments& moments);

/// Share of the urban cycle in the combined one (UDDS 0.55, HWFET 0.45).
/// Source    second-hand: 40 CFR 600.210 (not read), weights of combined fuel economy, which SMERF is said to use
constexpr double kUrbanShare = 0.55;

}  // namespace rollrig::estimation
