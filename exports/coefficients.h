#pragma once
/// Coefficients of rolling resistance as other programs take them, from fit.json of `rollrig fit j2452`.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "estimation/rolling_law/j2452_law.h"

namespace rollrig::exports {

/// What fit.json holds of the law.
struct RollingCoefficients {
  std::string path;
  std::string tire;
  estimation::J2452Law law;
  std::vector<estimation::RollingPoint> points;
  std::optional<estimation::ReferenceCondition> reference;
  double smerf_N = 0.0;  // where there is a reference
  std::string cycles;    // over which it is the mean, in words
  double low_m_s = 0.0;  // range of the points' speeds
  double high_m_s = 0.0;
  std::vector<std::string> warnings = {};  // of the fit

  /// Throws InputError where the fit has none.
  const estimation::ReferenceCondition& require_reference() const;
};

/// Reads fit.json, or the folder that holds it.
/// Errors  InputError: no fit of J2452, a number that is missing
RollingCoefficients read_rolling_coefficients(const std::string& path);

/// A polynomial 1, x, x^4 of x = v/V0 in the place of 1, v, v^2.
struct MagicFormulaSpeeds {
  std::array<double, 3> q{};  // QSY1, QSY3, QSY4
  double deviation = 0.0;     // largest, over the law's force, over the range of speeds [1]
};

/// Least squares of the relative deviation over the range of the points' speeds; exact at the reference.
MagicFormulaSpeeds fit_magic_formula(const RollingCoefficients& coefficients);

/// The measured points as a TYDEX file.
///
/// Channels LONGVEL [m/s], FZW [N], INFLPRES [Pa] (gauge) and FX [N], which is negative: it retards the tire.
/// Source  TYDEX-Format, release 1.3 (1997), as public programs write it: parts **HEADER, **COMMENTS, **CONSTANTS,
///         **MEASURCHANNELS, **MEASURDATA, **END; the document itself could not be read
std::string make_tydex(const RollingCoefficients& coefficients);

/// The part of a tire property file (.tir) that rolling resistance takes, Magic Formula 6.2.
/// Equation  as tables::calc_rolling_resistance_N(): QSY7 = beta, QSY8 = alpha, QSY1, QSY3, QSY4 by fit_magic_formula()
/// Errors    InputError: no radius, no reference
/// Checked   tests/exports/coefficients_test.cpp, with the reader of .tir files
std::string make_tir(const RollingCoefficients& coefficients, const std::optional<double>& tire_radius_m);

/// A MATLAB script with the parameters of the block Rolling Resistance of Simscape Driveline.
/// Equation  F = (P/1 Pa)^alpha (N/1 N)^beta 1 N (A + B |v| + C v^2), P in Pa, v in m/s
/// Source    MathWorks, Rolling Resistance, https://www.mathworks.com/help/sdl/ref/rollingresistance.html, read in the
///           version of R2021a
std::string make_simscape(const RollingCoefficients& coefficients);

/// wheel_rr_coef of FASTSim: the mean force over the cycles of the fit, over load.
/// Source  NREL, FASTSim, struct Chassis: "Wheel rolling resistance coefficient for the vehicle", a ratio
std::string make_fastsim(const RollingCoefficients& coefficients);

/// rolling_resistance_coeff, and the share of the tires in f0, f1, f2 of CO2MPAS.
/// Equation  f0 + f1 v + f2 v^2 = n P^alpha Z^beta (a + b v + c v^2), v in km/h, n tires
/// Source    JRC, CO2MPAS, co2mpas/core/model/physical/vehicle.py: f0 [N] = m 9.81 rolling_resistance_coeff, f1 in
///           N/(km/h), f2 in N/(km/h)^2
std::string make_co2mpas(const RollingCoefficients& coefficients, int tires);

}  // namespace rollrig::exports
