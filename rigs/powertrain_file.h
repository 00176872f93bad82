#pragma once
/// Tables [powertrain] and [battery] of a vehicle's file: reading and writing.

#include <optional>
#include <string>

#include "rigs/vehicle_file.h"

namespace rollrig::rigs {

/// The keys of [powertrain] and its map, in both formats; the reader may have others accepted. Throws InputError for
/// unknown keys, constant efficiencies beside a map, and a map whose axes do not rise or whose rows do not fit.
void read_powertrain(TableReader& reader, VehiclePowertrain& powertrain);

/// [battery] of the file; nothing where it has none. Throws InputError where the recharge is less than what the battery
/// gives, or is given twice.
std::optional<VehicleBattery> read_battery(TableReader& file);

/// [powertrain] as TOML; beside a map, without the constant efficiencies.
std::string write_powertrain(const VehiclePowertrain& powertrain);

}  // namespace rollrig::rigs
