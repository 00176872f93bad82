#pragma once
/// A vehicle on rollers or on the road as a multibody system in Simbody: sled along the road, body on it with
/// heave (and pitch on the road), an upright on its suspension for each wheel, wheel and roller on pins, contact
/// elements between them.

#include <memory>
#include <vector>

#include "rigs/vehicle_channels.h"
#include "sim/ode_system.h"

namespace rollrig::rigs {

/// Forces at one instant of one state, for tests that look inside. Horizontal ones are positive forwards,
/// vertical ones upwards.
struct VehicleForces {
  struct Wheel {
    double contact_load_N = 0.0;
    double contact_force_N = 0.0;  // of the surface on the wheel
    double rolling_resistance_N = 0.0;
    double loaded_radius_m = 0.0;
    double wheel_speed_rad_s = 0.0;
    double roller_speed_rad_s = 0.0;  // 0 on the road
    double spindle_reaction_N = 0.0;  // of the upright on the wheel, from Simbody's joint reaction
    double hub_torque_Nm = 0.0;       // of motor and brake on the wheel, positive when it drives
    double roller_reaction_N = 0.0;   // of the ground on the roller, from Simbody's joint reaction
    double roller_lift_N = 0.0;       // likewise upwards
    double roller_mass_kg = 0.0;
  };
  std::vector<Wheel> wheels;
  double tie_down_N = 0.0;  // on the vehicle
  double speed_m_s = 0.0;
};

/// Bodies   dynamometer, whole: sled held by the tie-downs, body with heave; no pitch, which the mounting
///          prevents (§3.4.2); a quarter: no sled. Road: sled free along it, body with heave, and pitch
///          when whole. No roll: both sides of the vehicle are alike
/// Rollers  carry the simulated inertia as their own, R^2 (m + m_rot - sum I_spin/r_l^2) in proportion to the
///          loads, as an ideal dynamometer would; on the road, what turns beside the wheels moves with the sled
/// State    q, u of all joints, then z: slip deflection and corner states of each wheel, the driver's integral
/// Energy   both ledgers of sim::EnergyAudit; work of the rollers counts against the simulated inertia's energy
/// Checked  tests/rigs/multibody_vehicle_test.cpp, tests/rigs/vehicle_fidelities_test.cpp
class MultibodyVehicle : public sim::OdeSystem<double> {
 public:
  /// Everything at one state, joint reactions included.
  virtual VehicleForces find_forces(double time_s, const double* state) = 0;
};

/// `corners`, one a wheel, outlive the vehicle.
/// Errors  RunFailure: what Simbody refuses, and where its library cannot be loaded
std::unique_ptr<MultibodyVehicle> make_multibody_vehicle(std::vector<models::Corner<double>>& corners,
                                                         const VehicleLayout& layout, const RigStart<double>& start,
                                                         bool surface_recorded);

}  // namespace rollrig::rigs
