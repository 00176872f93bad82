#pragma once
/// Pressure of the gas sealed in the tire.

#include "sim/core/scalar.h"

namespace rollrig::models {

/// State in which the tire was inflated: cold gauge pressure at the temperature T_0.
template <class S>
struct Inflation {
  S cold_pressure_Pa{};     // gauge, read on the setting gauge
  S temperature_K{};        // T_0
  S ambient_pressure_Pa{};  // absolute
};

/// Gauge pressure of a sealed cavity.
/// Equation  p = (p_cold + p_amb) (T_gas/T_0) (m/m_0) / (V/V_0) - p_amb
/// Symbols   p, p_cold gauge pressure [Pa]; p_amb ambient pressure [Pa]; T_gas, T_0 [K];
///           m/m_0 gas left [1]; V/V_0 volume of the cavity [1]; both 1 in the baseline
/// Source    (3.14), with absolute pressure
/// Checked   tests/models/small_laws_test.cpp
template <class S>
S calc_gauge_pressure_Pa(const Inflation<S>& inflation, const S& gas_temperature_K, const S& mass_ratio,
                         const S& volume_ratio) {
  const S cold_abs_Pa = inflation.cold_pressure_Pa + inflation.ambient_pressure_Pa;
  return cold_abs_Pa * (gas_temperature_K / inflation.temperature_K) * (mass_ratio / volume_ratio) -
         inflation.ambient_pressure_Pa;
}

}  // namespace rollrig::models
