#pragma once
/// Rolling resistance over load and pressure at one speed (`rollrig fit j1269`).

#include "estimation/rolling_law/j2452_fit.h"

namespace rollrig::estimation {

/// What is fitted to the points of a multipoint test.
enum class MultipointForm {
  kBilinear,     // F = A0 + A1 Z + A2/P + A3 Z/P
  kProportional  // F = Z (A1 + A3/P): no force without load
};

struct MultipointFit {
  MultipointForm form = MultipointForm::kBilinear;
  std::vector<ParameterEstimate> coefficients;  // of Z in N, P in kPa
  std::vector<FittedPoint> points;
  RegressionStatistics statistics;
  double speed_m_s = 0.0;         // mean of the points
  double mean_coefficient = 0.0;  // mean of F/Z over the points [1]
  std::vector<std::string> warnings;

  /// At a load and pressure, at the speed of the test.
  ForceEstimate estimate_force(double load_N, double pressure_Pa) const;

  // In the scaling of the fit: load over load_0_N, pressure_0_Pa over pressure.
  Eigen::VectorXd scaled;
  Eigen::MatrixXd covariance;
  double load_0_N = 1.0;
  double pressure_0_Pa = 1.0;
};

/// Linear least squares of forces in N.
/// Equation  F = A0 + A1 Z + A2/P + A3 Z/P, or its terms with Z alone
/// Symbols   F rolling resistance, Z load, P gauge pressure
/// Source    Linear relations of the equilibrium rolling resistance in load and in the reciprocal of pressure: Tire
///           Science and Technology 6 (1978) 163, abstract. The regression that SAE J1269 and ISO 18164 recommend could
///           not be read
/// Errors    InputError: fewer points than coefficients, fewer than two pressures or loads, more than one speed;
///           RunFailure: load and pressure that vary together
/// Checked   tests/estimation/rolling_law_test.cpp
MultipointFit fit_multipoint(const std::vector<RollingPoint>& points, MultipointForm form);

}  // namespace rollrig::estimation
