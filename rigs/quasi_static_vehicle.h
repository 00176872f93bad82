#pragma once
/// A vehicle on rollers or on the road with its mechanics in equilibrium: thermal and effect states alone,
/// and the speed when it coasts.

#include <vector>

#include "models/vehicle/vehicle.h"
#include "models/wheel/rolling_wheel.h"
#include "rigs/vehicle_channels.h"

namespace rollrig::rigs {

/// Equation  on the driver's foot  D = R(v) + sum F_rr,i + (m + m_rot) a, which the driver asks for;
///           coasting  a = -(R(v) + sum F_rr,i)/(m + m_rot);
///           R: rollers' force A + B v + C v^2, or drag, grade and road load on the flat;
///           each wheel: models/wheel/rolling_wheel.h, its hub doing its share of D
/// Symbols   m mass, m_rot equivalent mass of what turns [kg], a acceleration [m/s2]; what motors and brakes do of D:
///           models/vehicle/vehicle.h, blend_brakes
/// Validity  slow against suspension, tie-downs and the driver's settling (a few seconds); loads are static,
///           for the tie-downs of a dynamometer hold the vehicle (§3.4.2) and on the flat the sum over both
///           axles counts; rollers make up for their own nominal parasitic loss and hold one speed
/// Energy    kinetic energy jumps where the driver takes over: term "load_changes" of the mechanical audit
/// Source    baseline.md; (3.20)
/// Checked   tests/rigs/vehicle_test.cpp, tests/rigs/vehicle_fidelities_test.cpp
template <class S>
class QuasiStaticVehicle : public sim::OdeSystem<S> {
 public:
  /// One corner for each wheel of the layout.
  QuasiStaticVehicle(std::vector<models::Corner<S>>& corners, const VehicleLayout& layout, VehicleStart<S> start,
                     bool surface_recorded);

  std::size_t state_count() const override { return 1 + corners_.size() * corners_.front().state_count(); }
  std::vector<double> state_tolerances() const override;
  const std::vector<sim::Integral>& integrals() const override { return integrals_; }
  const std::vector<sim::Store>& stores() const override { return stores_; }
  const std::vector<sim::Channel>& channels() const override { return channels_; }

  void initialize(const sim::Segment& first, double time_s, S* state) override;
  void begin_phase(const sim::Phase& phase, double time_s, S* state) override;
  void begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) override;
  void evaluate(double time_s, const S* state, S* rates, S* integrands) override;
  void require_possible(const S* state) const override;
  S watch(const std::string& name, double time_s, const S* state) override;
  void observe(double time_s, const S* state, S* values) override;
  void calc_stored(double time_s, const S* state, S* stored_J) override;

 private:
  static constexpr std::size_t kSpeedState = 0;

  /// What one wheel does at an instant.
  struct Wheel {
    models::Instant<S> now;
    models::RollingWheel<S> rolling;
    S motor_N{};     // of its hub, as force at the surface
    S friction_N{};  // of its brake
    S hub_loss_N{};  // of the hub's own bearings and brake pads, on the flat
    S slip{};        // of the wheel against the surface, positive when it is dragged
  };

  std::size_t first_state_of(std::size_t wheel) const { return 1 + wheel * corners_.front().state_count(); }
  void find_motion(double time_s, const S* state);
  void find_losses(std::size_t wheel, const S* state, const models::InputPort<S>& recorded);
  void find_resistance();
  void find_balance();
  S calc_wheel_inertia_kg() const;
  void share_demand();
  void find_slip();
  void fill_vehicle_integrands(S* integrands) const;
  void fill_wheel_integrands(std::size_t wheel, S* integrands) const;
  S calc_kinetic_J() const;
  S find_recorded_speed_m_s() const {
    return models::calc_recorded_speed_m_s(speed_m_s_, wheels_.front().now.recorded, wheels_.front().now.acting);
  }

  std::vector<models::Corner<S>>& corners_;
  VehicleLayout layout_;
  VehicleStart<S> start_;
  bool surface_recorded_;
  std::vector<sim::Integral> integrals_;
  std::vector<sim::Store> stores_;
  std::vector<sim::Channel> channels_;

  sim::Segment segment_;
  double segment_start_s_ = 0.0;
  bool driver_on_ = true;
  std::vector<Wheel> wheels_;
  S speed_m_s_{};
  S acceleration_m_s2_{};
  S rolled_off_N_{};   // against the vehicle: given road load and drag on the flat, rollers on a dynamometer
  S given_force_N_{};  // part of it that rollers and grade do, as work and not as loss
  S body_mass_kg_{};   // all that moves but the simulated wheels' spin
  S demand_N_{};
  S motor_N_{};
  S assist_N_{};  // of the rest of the vehicle
};

extern template class QuasiStaticVehicle<double>;
extern template class QuasiStaticVehicle<Jet>;

}  // namespace rollrig::rigs
