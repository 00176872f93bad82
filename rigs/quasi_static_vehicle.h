#pragma once
/// A vehicle on rollers or on the road with its mechanics in equilibrium: thermal and effect states alone,
/// and the speed when it coasts.

#include <vector>

#include "models/vehicle/vehicle.h"
#include "rigs/quasi_static_rig.h"
#include "rigs/vehicle_channels.h"

namespace rollrig::rigs {

/// Equation  on the driver's foot  D = R(v) + sum F_rr,i + (m + m_rot) a, which the driver asks for;
///           coasting  a = -(R(v) + sum F_rr,i)/(m + m_rot);
///           R: rollers' force A + B v + C v^2, or drag, grade and given road load on the road;
///           each wheel: models/wheel/rolling_wheel.h, its hub doing its share of D
/// Symbols   m mass, m_rot equivalent mass of what turns [kg], a acceleration [m/s2]; what motors and brakes do of D:
///           models/vehicle/vehicle.h, blend_brakes
/// Validity  slow against suspension, tie-downs and the driver's settling (a few seconds); loads are static,
///           for the tie-downs of a dynamometer hold the vehicle (§3.4.2) and on the road the sum over all
///           axles counts; rollers make up for their own nominal parasitic loss and hold one speed
/// Energy    kinetic energy jumps where the driver takes over: term "load_changes" of the mechanical audit
/// Source    momentum of the vehicle and of what turns in it; (3.20)
/// Checked   tests/rigs/vehicle_test.cpp, tests/rigs/vehicle_stops_test.cpp, tests/rigs/vehicle_fidelities_test.cpp
template <class S>
class QuasiStaticVehicle : public QuasiStaticRig<S> {
 public:
  /// One corner for each wheel of the layout.
  QuasiStaticVehicle(std::vector<models::Corner<S>>& corners, const VehicleLayout& layout, RigStart<S> start,
                     bool surface_recorded);

  void initialize(const sim::Segment& first, double time_s, S* state) override;
  void begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) override;
  void evaluate(double time_s, const S* state, S* rates, S* integrands) override;
  void observe(double time_s, const S* state, S* values) override;
  void calc_stored(double time_s, const S* state, S* stored_J) override;

 private:
  using Base = QuasiStaticRig<S>;
  using Wheel = typename Base::Wheel;
  using Base::present_;
  using Base::wheels_;
  static constexpr std::size_t kSpeedState = 0;

  /// What a wheel's hub does at an instant, as force at the surface.
  struct Hub {
    S motor_N{};
    S friction_N{};  // of its brake
    S loss_N{};      // of its own bearings and brake pads, on the road
  };

  bool is_on_road() const { return models::is_on_road(layout_.machine); }
  void find_motion(double time_s, const S* state);
  void find_resistance();
  void find_balance();
  S calc_wheel_inertia_kg() const;
  void share_demand();
  void find_wheel(std::size_t wheel);
  void fill_vehicle_integrands(S* integrands) const;
  S find_recorded_speed_m_s(double time_s, const S* state) override;

  VehicleLayout layout_;
  std::vector<Hub> hubs_;
  S speed_m_s_{};
  S acceleration_m_s2_{};
  S rolled_off_N_{};   // against the vehicle: given road load and drag on the road, rollers on a dynamometer
  S given_force_N_{};  // part of it that rollers and grade do, as work and not as loss
  S body_mass_kg_{};   // all that moves but the simulated wheels' spin
  S demand_N_{};
  S motor_N_{};
  S assist_N_{};  // of the rest of the vehicle
};

extern template class QuasiStaticVehicle<double>;
extern template class QuasiStaticVehicle<Jet>;

}  // namespace rollrig::rigs
