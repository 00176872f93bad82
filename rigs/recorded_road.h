#pragma once
/// A measured vehicle on the road, simulated again.

#include "rigs/recorded_wheel.h"
#include "rigs/vehicle_channels.h"
#include "rigs/vehicle_file.h"

namespace rollrig::rigs {

/// The corner that is simulated for all tires of a group.
template <class S>
struct RoadTireGroup {
  models::Corner<S>* corner = nullptr;
  double count = 0.0;
  S load_N{};                // of each
  double pressure_Pa = 0.0;  // of the soaked tire, gauge
  S temperature_K{};         // at the first instant
};

/// A vehicle on the road, its mass, rotating mass and drag area those of the corners' context; its program has the
/// inputs of a vehicle's. Measured: traction_force of all hubs.
///
/// Equation  T = sum n (F_rr + F_par) + m g s/sqrt(1 + s^2) + rho/2 CdA w |w| + j (m + m_rot) a, each tire of a group
///           under its load
/// Symbols   n tires of a group, over whose groups the sum goes (rigs/vehicle_file.h, group_tires); m mass, m_rot
///           rotating mass, j factor on both (1 in the baseline), s slope, w air speed, a acceleration; rho of air of
///           the recorded temperature at 101.325 kPa (formats.md)
/// Validity  load transfer between tires is left out
/// Source    (3.20); rigs/quasi_static_vehicle.h; friction brakes: models/vehicle/vehicle.h. Assumed: each tire drives
///           and brakes as much as the others.
/// Checked   tests/measurements/road_axles_test.cpp, tests/rigs/recorded_wheel_test.cpp
template <class S>
class RecordedRoad : public RecordedWheel<S> {
 public:
  /// `start` says at what temperature the tires were inflated.
  RecordedRoad(std::vector<RoadTireGroup<S>> tires, const VehiclePowertrain& powertrain, RigStart<S> start,
               Detail detail);

  void initialize(const sim::Segment& first, double time_s, S* state) override;

 private:
  void read_inputs(double time_s, std::size_t wheel, models::InputPort<S>& inputs) const override;
  void find_force() override;
  RecordedPowers<S> find_powers() const override;
  const models::VehicleBody<S>& body() const { return this->wheel().corner->context().vehicle; }

  std::vector<RoadTireGroup<S>> groups_;  // of the wheels, in their order
  S motor_limit_N_{};
  S fade_m_s_{};
  S mass_kg_{};  // that is accelerated
  S drag_N_{};
  S grade_N_{};
};

extern template class RecordedRoad<double>;
extern template class RecordedRoad<Jet>;

}  // namespace rollrig::rigs
