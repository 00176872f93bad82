#pragma once
/// Inputs, channels, integrals and stores of a vehicle on rollers or on the road: one list for both fidelities.

#include <string>
#include <vector>

#include "rigs/drum_channels.h"
#include "rigs/vehicle_layout.h"
#include "sim/ode_system.h"

namespace rollrig::rigs {

/// Inputs of a vehicle's program, in the order of Segment::inputs. kCounted is 1 on stretches that the
/// evaluation counts (above the speed from which the source trusts its model, §4.2.1), else 0.
enum class VehicleInput : std::size_t { kSpeed, kAmbient, kSurface, kSlope, kWind, kCounted };
constexpr std::size_t kVehicleInputCount = 6;

/// Command beside kSetPressure: 1 the driver follows the speed, 0 neutral, the vehicle coasts.
constexpr const char* kDriver = "driver";

/// Integrals of the vehicle as a whole, which stand first.
enum class VehicleIntegral : std::size_t {
  kTraction,  // force of all hubs on the vehicle's wheels, as force at the surface
  kDistance,
  kCountedTime,
  kCountedDistance,
  kDriveEnergy,  // given out by the hubs while they drive
  kRecuperated,  // taken in by the motor while it brakes
  kDriveWork,    // of the motor at the hubs, net
  kRollerWork,   // of rollers and of the rest of the vehicle on what is simulated, net
  kThroughput,
  kKnotWork,
  kTireLoss,
  kSlipLoss,
  kBearingLoss,
  kBrakeLoss,
  kDragLoss,
  kTireDamperLoss,
  kSuspensionDamperLoss,
  kHeatGenerated,
  kHeatToAir,
  kHeatToRoad,
  kCount
};

/// Integrals of each wheel, which follow wheel by wheel.
enum class WheelIntegral : std::size_t {
  kLossForce,
  kLinerTemperature,
  kCavityPressure,
  kGasTemperature,
  kRollingResistance,
  kParasitic,
  kLongitudinalForce,
  kContactLoad,
  kRollingEnergy,         // F_rr v
  kCountedRollingEnergy,  // the same, on counted stretches
  kCountedRrc,            // F_rr/Fz, on counted stretches
  kCount
};

enum class VehicleStore : std::size_t { kKinetic, kGravity, kSprings, kSlipSpring, kHeat, kCount };

constexpr std::size_t index_of(VehicleInput input) { return static_cast<std::size_t>(input); }
constexpr std::size_t index_of(VehicleIntegral integral) { return static_cast<std::size_t>(integral); }
constexpr std::size_t index_of(VehicleStore store) { return static_cast<std::size_t>(store); }
constexpr std::size_t index_of(WheelIntegral integral, std::size_t wheel) {
  return index_of(VehicleIntegral::kCount) + wheel * static_cast<std::size_t>(WheelIntegral::kCount) +
         static_cast<std::size_t>(integral);
}

std::vector<sim::Integral> make_vehicle_integrals(const VehicleLayout& layout);
std::vector<sim::Store> make_vehicle_stores();

/// Recorded channels: given ones first, then measured ones, as in formats.md, wheel by wheel; then what only
/// a simulation knows; then the states of further thermal nodes and of effects.
std::vector<sim::Channel> make_vehicle_channels(const VehicleLayout& layout,
                                                const std::vector<models::CornerState>& states, bool surface_recorded);

/// A channel of one wheel: the position stands before the unit, "liner_temperature_front_left_degC".
std::string wheel_channel(const std::string& name, const WheelPlace& wheel);

/// The name of a recorded channel as one wheel's effects know it: without the wheel's position; the vehicle's own
/// channels are the first wheel's; empty for those of other wheels.
std::string name_at_wheel(const std::string& recorded, const VehicleLayout& layout, std::size_t wheel);

/// The recorded inputs of a segment at a time. Load, longitudinal and brake force are the rig's to fill.
template <class S>
models::InputPort<S> read_vehicle_inputs(const sim::Segment& segment, double elapsed_s, bool surface_recorded) {
  const auto value = [&](VehicleInput input) { return S(segment.inputs[index_of(input)].at(elapsed_s)); };
  models::InputPort<S> inputs;
  inputs.speed_m_s = value(VehicleInput::kSpeed);
  inputs.acceleration_m_s2 = S(segment.inputs[index_of(VehicleInput::kSpeed)].slope_per_s);
  inputs.load_N = S(0.0);
  inputs.ambient_K = value(VehicleInput::kAmbient);
  inputs.surface_recorded = surface_recorded;
  inputs.surface_K = surface_recorded ? value(VehicleInput::kSurface) : inputs.ambient_K;
  inputs.longitudinal_force_N = S(0.0);
  inputs.brake_force_N = S(0.0);
  inputs.slope = value(VehicleInput::kSlope);
  inputs.wind_m_s = value(VehicleInput::kWind);
  inputs.air_density_ratio = S(1.0);
  return inputs;
}

/// How a run of a vehicle starts: every tire at one temperature and pressure.
template <class S>
using VehicleStart = DrumStart<S>;

}  // namespace rollrig::rigs
