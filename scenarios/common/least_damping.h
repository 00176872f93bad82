#pragma once
/// What the multibody fidelity needs of a damper.

#include <string>

namespace rollrig::scenarios {

/// A mass on a spring and a damper.
struct DampedMass {
  std::string damper;  // "the carriage"
  std::string bounce;  // what would happen with hardly any damping: "it would bounce on the tire"
  std::string path;    // of the file with damping_N_s_per_m
  double damping_N_s_per_m = 0.0;
  double stiffness_N_per_m = 0.0;
  double mass_kg = 0.0;
};

/// With hardly any damping, a mass bounces through the whole test: the integrator then follows some ten steps of each
/// oscillation for hours of simulated time.
/// Validity  c >= 0.05 * 2 sqrt(k m). Assumed: dampers of cars have 0.2 to 0.4 of critical damping, worn ones 0.1
/// Errors    InputError where c is less
void require_damping(const DampedMass& damped);

}  // namespace rollrig::scenarios
