#pragma once
/// A measured run of a vehicle's wheel simulated again from its recorded inputs: on the roller of a dynamometer, or on
/// the road, where each of the vehicle's tires does the same.

#include <vector>

#include "models/corner.h"
#include "scenarios/measurement_set.h"
#include "sim/recording.h"

namespace rollrig::identification {

/// Recorded inputs in the middle of a part of the time between two rows. The load of the part's first row holds.
struct WheelInterval {
  double duration_s = 0.0;
  double speed_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
  double load_N = 0.0;  // not read on the road, where the vehicle's mass decides
  double ambient_K = 0.0;
  double surface_K = 0.0;  // used where the run recorded it
  double slope = 0.0;
  double longitudinal_force_N = 0.0;  // root mean square over the part, with the sign of its middle
  std::size_t row = 0;                // the row before
  double share_of_row = 0.0;          // of the part, what belongs to the mean of the row before; the rest to the next
};

/// The parts of a run, none longer than 2.5 s (Assumed: a tenth of the gas's time constant).
/// On the road the slope is the rise of `elevation_m` over the way between two rows; 0 below 1 m/s.
std::vector<WheelInterval> make_wheel_intervals(const scenarios::MeasuredRun& run);

/// What the sensors of a dynamometer would have shown of one wheel: "loss_force_N", "liner_temperature_degC",
/// "cavity_pressure_kPa", "gas_temperature_degC", and the rim's temperature where an effect has a rim.
///
/// Equation  x(n+1) = x(n) + h f(x(n) + h/2 f(n-1), u(n)), u(n) inputs in the middle of interval n, f(n-1) the former
///           rates: one evaluation an interval. A row's value is the mean over the halves of the intervals beside it.
///           loss = F_rr + F_par + Fx^2/C + (j - 1) J/R^2 a
/// Symbols   x states, h duration, Fx recorded longitudinal force, C slip stiffness (infinite in the baseline),
///           j factor on the roller's inertia J (1 in the baseline), R its radius, a acceleration
/// Validity  h well below every time constant; order 2 in h. The recorded force is that of the contact
/// Source    explicit midpoint rule with a lagged predictor. baseline.md, "Rig"
/// Checked   tests/identification/wheel_replay_test.cpp
template <class S>
sim::Recording<S> replay_dyno_run(const scenarios::MeasurementSet& set, const scenarios::MeasuredRun& run,
                                  const std::vector<WheelInterval>& intervals, models::Corner<S>& corner);

/// "traction_force_N" of a vehicle on the road, its mass, rotating mass and drag area from the corner's context.
///
/// Equation  traction = n (F_rr + F_par) + m g s/sqrt(1 + s^2) + rho/2 CdA w |w| + j (m + m_rot) a,
///           each tire under m g/n
/// Symbols   n tires, m mass, m_rot rotating mass, j factor on both (1 in the baseline), s slope, w air speed;
///           rho of air of the recorded temperature at 101.325 kPa (formats.md)
/// Validity  as above; load transfer between tires does not change their sum. A run that started right after another
///           (tire_state = "warm") begins at the temperature of steady driving at 80 km/h (Assumed)
/// Source    (3.20); rigs/quasi_static_vehicle.h. Friction brakes: models/vehicle.h, blend_brakes
/// Checked   tests/identification/wheel_replay_test.cpp
template <class S>
sim::Recording<S> replay_road_run(const scenarios::MeasurementSet& set, const scenarios::MeasuredRun& run,
                                  const std::vector<WheelInterval>& intervals, models::Corner<S>& corner);

}  // namespace rollrig::identification
