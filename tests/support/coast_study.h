#pragma once
/// Coast-downs of a drum made up with a known loss, noise, missed pulses and a resonance.

#include <cstdint>

#include "estimation/drum_deceleration/drum_coastdown.h"

namespace rollrig::tests {

struct CoastStudy {
  double noise_m_s = 0.01;      // about that of the measured coasts (7 to 12 mm/s)
  double missed_share = 0.03;   // of the pulses: speed a half
  double doubled_share = 0.0;   // speed twice
  double resonance = 0.05;      // excess at its top, of the deceleration; loaded runs
  double resonance_m_s = 10.0;  // where it is
  double resonance_width_m_s = 0.4;
  double loaded_scatter = 0.01;  // standard deviation of a run's level, of the deceleration
  double lifted_scatter = 0.015;
  double exponent = -0.45;       // of force over pressure
  double left_over_right = 0.0;  // difference of the directions' net force
  double mass_ratio = 0.0;
  std::vector<double> pressures_Pa{280e3, 350e3, 420e3, 490e3, 560e3};
  int lifted_runs = 6;
};

/// Net deceleration of the made-up tire at the surface of the drum, both directions' mean.
double calc_true_net_m_s2(const CoastStudy& study, double pressure_Pa, double speed_m_s);
double calc_true_drum_m_s2(double speed_m_s);
double calc_true_wheel_m_s2(double speed_m_s);

/// Two loaded runs (left, right) at each pressure and the lifted ones, spin-up first.
estimation::CoastSet make_coasts(const CoastStudy& study, std::uint64_t seed);

}  // namespace rollrig::tests
