#pragma once
/// What was before a run, and the speed at which sizes of effects hold.

#include "models/ports.h"

namespace rollrig::tests {

constexpr double k80_m_s = 80.0 / 3.6;

/// After a rest of some hours.
inline models::InitialPort<double> rested(double hours) {
  models::InitialPort<double> initial;
  initial.soaked = false;
  initial.rest_before_s = hours * 3600.0;
  return initial;
}

/// Right after another run.
inline models::InitialPort<double> warm() {
  models::InitialPort<double> initial;
  initial.soaked = false;
  initial.started_warm = true;
  return initial;
}

}  // namespace rollrig::tests
