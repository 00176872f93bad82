#pragma once
/// The drum rig as a multibody system in Simbody: drum on a pin, or a belt on a slider in its place, carriage on a
/// vertical slider with its load cylinder, wheel and tire on a pin, contact element between wheel and drum.

#include <memory>

#include "rigs/drum_channels.h"
#include "rigs/rig_file.h"
#include "sim/ode_system.h"

namespace rollrig::rigs {

/// Forces at one instant of one state, for tests that look inside.
struct DrumForces {
  double motor_torque_Nm = 0.0;
  double contact_load_N = 0.0;
  double spindle_force_N = 0.0;     // of the hub on the wheel, against the motion, from the contact force
  double hub_moment_Nm = 0.0;       // of the hub on the wheel about its axis, from Simbody's joint reaction
  double spindle_reaction_N = 0.0;  // as spindle_force_N, but from Simbody's joint reaction
  double rolling_resistance_N = 0.0;
  double parasitic_N = 0.0;
  double surface_speed_m_s = 0.0;
  double drum_speed_rad_s = 0.0;
  double wheel_speed_rad_s = 0.0;
  double loaded_radius_m = 0.0;
};

/// State vector: Simbody's q (drum angle, carriage height, wheel angle), u (their rates) and z (slip
/// deflection, corner states, integral of the motor's speed error).
/// Energy    both ledgers of sim::EnergyAudit
/// Checked   tests/rigs/multibody_drum_test.cpp, tests/rigs/fidelities_test.cpp
class MultibodyDrum : public sim::OdeSystem<double> {
 public:
  virtual const models::Inflation<double>& inflation() const = 0;
  /// Everything at one state, joint reactions included.
  virtual DrumForces find_forces(double time_s, const double* state) = 0;
};

/// `corner` outlives the drum.
/// Errors  RunFailure: what Simbody refuses, and where its library cannot be loaded
std::unique_ptr<MultibodyDrum> make_multibody_drum(models::Corner<double>& corner, const RigFile& rig,
                                                   const RigStart<double>& start, bool surface_recorded);

}  // namespace rollrig::rigs
