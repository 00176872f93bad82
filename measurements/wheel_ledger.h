#pragma once
/// What a replay of a wheel takes in, stores and loses: its two audits, and means that no sensor shows.

#include <memory>

#include "measurements/wheel_replay.h"
#include "sim/energy_audit.h"

namespace rollrig::measurements {

/// Channel of the road: force of all friction brakes of the vehicle.
constexpr const char* kFrictionBrake = "friction_brake_N";

/// Power at the middle of an interval, and the mass that moves with the surface speed.
struct WheelPowers {
  double hub_W = 0.0;  // of the hubs on their wheels
  double roller_W = 0.0;
  double gravity_W = 0.0;
  double tire_W = 0.0;
  double slip_W = 0.0;
  double bearing_W = 0.0;
  double drag_W = 0.0;
  double moving_kg = 0.0;
};

/// Sums over a replay.
///
/// Equation  mechanical: hubs + rollers + gravity + jumps - change of kinetic energy - losses = 0, jumps being those of
///           kinetic energy where the mass (a load step) or the speed jumps between two intervals;
///           thermal: heat generated - change of stored heat - heat to air and road = 0
/// Validity  the midpoint rule: an interval's speed runs straight, so that a m v h is the change of m v^2/2. Loss
///           of the tire is counted over the way, as in the loss force; what slip takes from it is of second order
/// Checked   tests/scenarios/recorded_inputs_test.cpp
class WheelLedger : public ReplayObserver<double> {
 public:
  /// `wheels` alike, of which the corner is one.
  WheelLedger(const MeasuredRun& run, const models::Corner<double>& corner, int wheels,
              std::vector<std::string> channels);

  void begin(const double* states) override;
  void end(const double* states) override;
  void add(const WheelInterval& part, const models::Instant<double>& now, const double& force_N) override;

  sim::EnergyAudit make_audit() const;
  /// Means of its channels, row by row; once.
  sim::Recording<double> take_means() { return means_.finish(); }

 protected:
  virtual WheelPowers find_powers(const models::Instant<double>& now, double force_N) const = 0;
  virtual std::vector<double> read_channels(const models::Instant<double>& now) const = 0;
  double wheels() const { return wheels_; }

 private:
  const models::Corner<double>& corner_;
  double wheels_;
  RowMeans<double> means_;
  WheelPowers sum_J_;  // energies; its mass is not used
  double throughput_J_ = 0.0;
  double jumps_J_ = 0.0;
  double kinetic_start_J_ = 0.0;
  double kinetic_J_ = 0.0;
  bool moved_ = false;
  double heat_in_J_ = 0.0;  // as those below of one wheel
  double to_air_J_ = 0.0;
  double to_road_J_ = 0.0;
  double heat_start_J_ = 0.0;
  double heat_end_J_ = 0.0;
};

/// One wheel on its roller.
///
/// Equation  hub    (F_rr/(1 + r_l/R) + I_spin/r_l^2 a + Fx) v + P_slip
///           roller (F_rr (r_l/R)/(1 + r_l/R) + F_par + j J/R^2 a - Fx) v
/// Symbols   as in QuasiStaticDrum; Fx force of the wheel on the roller, j factor on the roller's inertia
/// Source    the couple of rolling resistance: docs/architecture.md, "Multibody rig"
std::unique_ptr<WheelLedger> make_dyno_ledger(const MeasuredRun& run, const models::Corner<double>& corner);

/// A vehicle on the road, n tires alike.
///
/// Equation  hubs T v (1 - s), s slip of the tires; gravity -m g sin v; drag; n tires; mass j (m + m_rot)
std::unique_ptr<WheelLedger> make_road_ledger(const MeasuredRun& run, const models::Corner<double>& corner, int tires);

}  // namespace rollrig::measurements
