#pragma once
/// Units at the edge: the suffix of a key or column says the unit, and this file converts it once.

#include <string>
#include <string_view>

#include "sim/core/dimension.h"

namespace rollrig {

constexpr double kZeroCelsius_K = 273.15;          // 0 degC, by definition of the Celsius scale
constexpr double kStandardGravity_m_s2 = 9.80665;  // CGPM 1901
constexpr double kStandardAtmosphere_Pa = 101325;  // formats.md: ambient unless the rig says otherwise
constexpr double kKmhPerMs = 3.6;                  // km/h in a m/s
constexpr double kPoundForce_N = 0.45359237 * kStandardGravity_m_s2;
constexpr double kMile_m = 1609.344;           // exact, NIST SP 811
constexpr double kMph_m_s = kMile_m / 3600.0;  // 1 mph

/// A unit of a file: value in SI = value in file * factor + offset.
struct Unit {
  std::string symbol;      // as a person reads it, such as "N/kN"; empty when the key has no unit
  Dimension dimension;     // of the SI value
  double factor = 1.0;     // SI per file unit
  double offset_SI = 0.0;  // non-zero for a temperature in degC alone

  double to_si(double file_value) const { return file_value * factor + offset_SI; }
  double from_si(double si_value) const { return (si_value - offset_SI) / factor; }
};

/// The unit that a key's suffix names: "A1_N_s_per_m" -> N s/m, "speed_km_h" -> km/h,
/// "pressure_exponent" -> none. A trailing "_sd" is left out of account; a standard deviation of a
/// temperature is a difference, so it has no offset.
Unit unit_of_key(std::string_view key);

/// The key without its unit suffix: "drum_torque_Nm" -> "drum_torque".
std::string name_without_unit(std::string_view key);

/// That in plain words: "drum torque".
std::string plain_name(std::string_view key);

}  // namespace rollrig
