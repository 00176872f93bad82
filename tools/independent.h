#pragma once
/// What sources say that no tire was fitted to, and the same of virtual tires. The page independent_validation.md has
/// the sources.

#include <string>
#include <vector>

#include "tools/study_tires.h"

namespace rollrig::tools::independent {

inline constexpr double kPsi_Pa = 6894.757;
inline constexpr double kEpaRoll_m = 1.2192;  // LDTP 78-11: 48 inches
inline constexpr double kInsulated = 0.5;     // Assumed: share of the cooling that an insulated wheelhouse leaves
inline constexpr double kSprayed = 2.0;       // Assumed: factor on the cooling of a tire that is sprayed with water

/// Relative change of the reported loss in steady state from one cold pressure to another, at the ISO load.
double find_pressure_change(const StudyTire& tire, double from_psi, double to_psi);
/// Mean relative rise of it for each psi less, each of the loss before.
double find_rise_per_psi(const StudyTire& tire, double from_psi, double to_psi);
/// Exponent of the reported loss in steady state between two conditions.
double find_pressure_exponent(const StudyTire& tire);  // from 0.75 to 1.15 of the ISO pressure
double find_load_exponent(const StudyTire& tire);      // from 0.5 to 1.0 of the ISO load
/// The reported loss at 120 over that at 80 km/h in steady state, less 1.
double find_speed_rise(const StudyTire& tire);

/// Largest distance of the reported loss in steady state from a straight line, of the loss at ISO conditions: over the
/// load from 0.5 to 1.0 of the ISO load, or over the reciprocal of a pressure from 0.75 to 1.15 of the ISO pressure.
double find_bend_over_load(const StudyTire& tire);
double find_bend_over_inverse_pressure(const StudyTire& tire);

/// Relative fall of a steady loss per degC of the air, from 20 to 30 degC, of that at 25 degC.
double find_air_slope_per_K(const StudyTire& tire, double SteadyLoss::*loss);
/// The reported loss in steady state at a temperature of the air over that at 25 degC, less 1.
double find_air_excess(const StudyTire& tire, double air_degC);
/// The reported loss in steady state at -20 degC over that at 25 degC, at a speed.
double find_cold_ratio(const StudyTire& tire, double speed_km_h);

/// R = P^alpha Z^beta (a + b V + c V^2), fitted to a virtual stepwise coastdown: true losses, P cold.
struct J2452Fit {
  double alpha = 0.0;
  double beta = 0.0;
  double a = 0.0, b = 0.0, c = 0.0;  // kPa, N, km/h
  double rms = 0.0;                  // relative
  double worst = 0.0;                // relative
};
J2452Fit fit_j2452(const StudyTire& tire);

/// A truck tire in steps of speed at +5 degC, cooled as it is, or by this factor more.
struct SpeedStep {
  double speed_km_h = 0.0;
  RollingState usual, changed;
};
std::vector<SpeedStep> step_truck_tire(double cooling_factor);

/// Correlation of the true loss with a temperature over warm-ups at 80 km/h in air of -30 to +25 degC.
struct Correlation {
  double with_tread = 0.0;
  double with_air = 0.0;
};
Correlation correlate_truck_tire();

}  // namespace rollrig::tools::independent
