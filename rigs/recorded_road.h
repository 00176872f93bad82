#pragma once
/// A measured vehicle on the road, simulated again.

#include "rigs/recorded_wheel.h"
#include "rigs/vehicle_channels.h"
#include "rigs/vehicle_file.h"

namespace rollrig::rigs {

/// A vehicle on the road, its mass, rotating mass and drag area those of the corner's context; its program has the
/// inputs of a vehicle's. Measured: traction_force of all hubs.
///
/// Equation  T = n (F_rr + F_par) + m g s/sqrt(1 + s^2) + rho/2 CdA w |w| + j (m + m_rot) a, each tire under m g/n
/// Symbols   n tires, m mass, m_rot rotating mass, j factor on both (1 in the baseline), s slope, w air speed, a
///           acceleration; rho of air of the recorded temperature at 101.325 kPa (formats.md)
/// Validity  load transfer between tires does not change their sum
/// Source    (3.20); rigs/quasi_static_vehicle.h. Friction brakes: models/vehicle/vehicle.h, blend_brakes. Assumed: all
///           tires alike, each driven and braked as the others
template <class S>
class RecordedRoad : public RecordedWheel<S> {
 public:
  /// `start` says how the tires were inflated; at the first instant they have `temperature_K`.
  RecordedRoad(models::Corner<S>& corner, const VehicleFile& vehicle, RigStart<S> start, const S& temperature_K,
               Detail detail);

  void initialize(const sim::Segment& first, double time_s, S* state) override;

 private:
  void read_inputs(double time_s, models::InputPort<S>& inputs) const override;
  void find_force() override;
  RecordedPowers<S> find_powers() const override;
  const models::VehicleBody<S>& body() const { return this->wheel().corner->context().vehicle; }

  S temperature_K_{};  // at the start
  S load_N_{};
  S motor_limit_N_{};
  S fade_m_s_{};
  S mass_kg_{};  // that is accelerated
  S drag_N_{};
  S grade_N_{};
};

extern template class RecordedRoad<double>;
extern template class RecordedRoad<Jet>;

}  // namespace rollrig::rigs
