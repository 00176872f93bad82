#pragma once
/// Conditions that laws refer to, and what is left of a warm-up after a rest.

#include "models/ports.h"

namespace rollrig::models {

/// 80 km/h.
/// Source  ISO 28580
template <class S>
S get_reference_speed_m_s() {
  return quantity<S>(80.0 / 3.6, dimension::kSpeed);
}

/// 25 degC.
/// Source  ISO 28580
template <class S>
S get_reference_temperature_K() {
  return quantity<S>(298.15, dimension::kTemperature);
}

/// What a run starts with of a steady rise: all of it right after another run, none after a soak, and
/// Equation  D exp(-t/tau) after a rest
/// Symbols   D steady rise [any], t rest before the run [s], tau time constant of cooling [s]
template <class S>
S calc_rise_at_start(const InitialPort<S>& port, const S& steady_rise, const S& time_constant_s) {
  using std::exp;
  if (port.started_warm) return steady_rise;
  if (port.soaked) return S(0.0) * steady_rise;
  return steady_rise * exp(-port.rest_before_s / time_constant_s);
}

}  // namespace rollrig::models
