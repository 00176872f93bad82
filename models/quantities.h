#pragma once
/// Quantities that machines are given, measure and record, with the units of files (docs/formats.md).

#include "sim/core/quantity.h"

namespace rollrig::models::quantities {

// What is given to a machine.
inline constexpr Quantity kSpeed{"speed", "km_h"};
inline constexpr Quantity kLoad{"load", "N"};
inline constexpr Quantity kAmbient{"ambient", "degC"};
inline constexpr Quantity kSurfaceTemperature{"surface_temperature", "degC"};
inline constexpr Quantity kLongitudinalForce{"longitudinal_force", "N"};
inline constexpr Quantity kElevation{"elevation", "m"};
inline constexpr Quantity kHungTorque{"hung_torque", "Nm"};
inline constexpr Quantity kHungForce{"hung_force", "N"};  // where the machine measures a force

// What its sensors show.
inline constexpr Quantity kDrumTorque{"drum_torque", "Nm"};
inline constexpr Quantity kLossForce{"loss_force", "N"};
inline constexpr Quantity kTractionForce{"traction_force", "N"};
inline constexpr Quantity kLinerTemperature{"liner_temperature", "degC"};
inline constexpr Quantity kCavityPressure{"cavity_pressure", "kPa"};
inline constexpr Quantity kGasTemperature{"gas_temperature", "degC"};
inline constexpr Quantity kRimTemperature{"rim_temperature", "degC"};
inline constexpr Quantity kContactLoad{"contact_load", "N"};
inline constexpr Quantity kSpeedReading{"speed_reading", "km_h"};

/// Stands for the force or torque that a machine measures, whatever its name there (MachineTraits::force).
inline constexpr Quantity kMachineForce{"machine_force", "N"};

// What only a simulation knows.
inline constexpr Quantity kRollingResistance{"rolling_resistance", "N"};
inline constexpr Quantity kParasiticLoss{"parasitic", "N"};
inline constexpr Quantity kSpindleForce{"spindle_force", "N"};
inline constexpr Quantity kMotorPower{"motor_power", "W"};  // mechanical, of the motor of a drum or belt
inline constexpr Quantity kFrictionBrake{"friction_brake", "N"};

}  // namespace rollrig::models::quantities
