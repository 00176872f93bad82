#pragma once
/// A measured run of a vehicle's wheel simulated again from its recorded inputs: on the roller of a dynamometer, or on
/// the road, where each of the vehicle's tires does the same.

#include "measurements/wheel_intervals.h"
#include "models/corner.h"

namespace rollrig::measurements {

/// Told of a replay beside what its sensors would have shown.
template <class S>
class ReplayObserver {
 public:
  virtual ~ReplayObserver() = default;
  /// States of the corner before the first interval and after the last.
  virtual void begin(const S* states) = 0;
  virtual void end(const S* states) = 0;
  /// An interval, at its middle; `force_N` is what the kind's force channel is the mean of.
  virtual void add(const WheelInterval& part, const models::Instant<S>& now, const S& force_N) = 0;
};

/// What the sensors of a dynamometer would have shown of one wheel: "loss_force_N", "liner_temperature_degC",
/// "cavity_pressure_kPa", "gas_temperature_degC", and the rim's temperature where an effect has a rim.
///
/// Equation  x(n+1) = x(n) + h f(x(n) + h/2 f(n-1), u(n)), u(n) inputs in the middle of interval n, f(n-1) the former
///           rates: one evaluation an interval. A row's value is the mean over the halves of the intervals beside it.
///           loss = F_rr + F_par + Fx^2/C + (j - 1) J/R^2 a
/// Symbols   x states, h duration, Fx recorded longitudinal force, C slip stiffness (infinite in the baseline),
///           j factor on the roller's inertia J (1 in the baseline), R its radius, a acceleration
/// Validity  h well below every time constant; order 2 in h. The recorded force is that of the contact
/// Errors    RunFailure: a tire that runs away in temperature
/// Source    explicit midpoint rule with a lagged predictor. baseline.md, "Rig"
/// Checked   tests/measurements/wheel_replay_test.cpp
template <class S>
sim::Recording<S> replay_dyno_run(const MeasurementSet& set, const MeasuredRun& run,
                                  const std::vector<WheelInterval>& intervals, models::Corner<S>& corner,
                                  ReplayObserver<S>* observer = nullptr);

/// "traction_force_N" of a vehicle on the road, its mass, rotating mass and drag area from the corner's context.
///
/// Equation  traction = n (F_rr + F_par) + m g s/sqrt(1 + s^2) + rho/2 CdA w |w| + j (m + m_rot) a,
///           each tire under m g/n
/// Symbols   n tires, m mass, m_rot rotating mass, j factor on both (1 in the baseline), s slope, w air speed;
///           rho of air of the recorded temperature at 101.325 kPa (formats.md)
/// Validity  as above; load transfer between tires does not change their sum. A run that started right after another
///           (tire_state = "warm") begins at the temperature of steady driving at 80 km/h (Assumed)
/// Source    (3.20); rigs/quasi_static_vehicle.h. Friction brakes: models/vehicle/vehicle.h, blend_brakes
/// Checked   tests/measurements/wheel_replay_test.cpp
template <class S>
sim::Recording<S> replay_road_run(const MeasurementSet& set, const MeasuredRun& run,
                                  const std::vector<WheelInterval>& intervals, models::Corner<S>& corner,
                                  ReplayObserver<S>* observer = nullptr);

/// What the equations take of a vehicle on the road and its tires, all of them alike. Against the constant coefficient
/// a tire file may lack all but that: values of its class then stand in. Throws InputError where the vehicle is given
/// by its road load, or the tire lacks a table.
models::Context<double> make_road_context(const MeasurementSet& set);

/// Load of one of the vehicle's tires, its share of the weight.
double find_tire_load_N(const rigs::VehicleFile& vehicle);

}  // namespace rollrig::measurements
