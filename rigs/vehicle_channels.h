#pragma once
/// Inputs, channels, integrals and stores of a vehicle on rollers or on the road: one list for both fidelities.

#include <optional>
#include <string>
#include <vector>

#include "models/corner.h"
#include "rigs/rig_system.h"
#include "rigs/vehicle_layout.h"

namespace rollrig::rigs {

/// Inputs of a vehicle's program, in the order of Segment::inputs. kCounted is 1 on stretches that the
/// evaluation counts (above the speed from which the source trusts its model, §4.2.1), else 0.
enum class VehicleInput : std::size_t { kSpeed, kAmbient, kSurface, kSlope, kWind, kCounted };
constexpr std::size_t kVehicleInputCount = 6;

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
  kTireReadings,  // one each of models::kTireChannels
  kRollingResistance = kTireReadings + models::kTireChannels.size(),
  kParasitic,
  kLongitudinalForce,
  kContactLoad,
  kRollingEnergy,         // F_rr v
  kCountedRollingEnergy,  // the same, on counted stretches
  kCountedRrc,            // F_rr/Fz, on counted stretches
  kCount
};

constexpr std::size_t index_of(VehicleInput input) { return static_cast<std::size_t>(input); }
constexpr std::size_t index_of(VehicleIntegral integral) { return static_cast<std::size_t>(integral); }
constexpr std::size_t index_of(WheelIntegral integral, std::size_t wheel) {
  return index_of(VehicleIntegral::kCount) + wheel * static_cast<std::size_t>(WheelIntegral::kCount) +
         static_cast<std::size_t>(integral);
}

/// Those of the vehicle, those of each wheel, and with a map of the powertrain the energy of the battery.
std::vector<sim::Integral> make_vehicle_integrals(const VehicleLayout& layout);

/// Index of the energy of the battery, where the layout has a map of the powertrain.
inline std::size_t find_battery_integral(const VehicleLayout& layout) {
  return index_of(VehicleIntegral::kCount) + layout.wheels.size() * static_cast<std::size_t>(WheelIntegral::kCount);
}
std::vector<sim::Store> make_vehicle_stores();

/// Recorded channels: given ones first, then measured ones, as in formats.md, wheel by wheel; then what only
/// a simulation knows; then the states of further thermal nodes and of effects. `states` are those of each wheel.
std::vector<sim::Channel> make_vehicle_channels(const VehicleLayout& layout,
                                                const std::vector<std::vector<models::CornerState>>& states,
                                                bool surface_recorded);

/// One corner a wheel.
template <class S>
std::vector<sim::Channel> make_vehicle_channels(const VehicleLayout& layout,
                                                const std::vector<models::Corner<S>>& corners, bool surface_recorded) {
  std::vector<std::vector<models::CornerState>> states;
  for (const models::Corner<S>& corner : corners) states.push_back(corner.states());
  return make_vehicle_channels(layout, states, surface_recorded);
}

/// A channel of one wheel: "liner_temperature_front_left" in degC.
Quantity wheel_channel(const Quantity& quantity, const std::string& position);
inline Quantity wheel_channel(const Quantity& quantity, const WheelPlace& wheel) {
  return wheel_channel(quantity, wheel.position);
}
/// The channel without a wheel's position; nothing where it is not of that wheel.
std::optional<Quantity> without_position(const Quantity& channel, const std::string& position);

/// A recorded channel as one wheel's effects know it: without the wheel's position; the vehicle's own channels are the
/// first wheel's; none for those of other wheels.
std::optional<Quantity> find_at_wheel(const Quantity& recorded, const VehicleLayout& layout, std::size_t wheel);

/// Puts what is recorded at a time into `inputs`. Load, longitudinal and brake force are the rig's to fill.
template <class S>
void read_vehicle_inputs(const PresentProgram& present, double time_s, models::InputPort<S>& inputs) {
  const double elapsed_s = present.elapsed_s(time_s);
  const sim::Ramps& given = present.segment.inputs;
  const auto value = [&](VehicleInput input) { return given[index_of(input)].at(elapsed_s); };
  inputs.speed_m_s = S(value(VehicleInput::kSpeed));
  inputs.acceleration_m_s2 = S(given[index_of(VehicleInput::kSpeed)].slope_per_s);
  inputs.ambient_K = S(value(VehicleInput::kAmbient));
  inputs.surface_recorded = present.surface_recorded;
  inputs.surface_K = S(value(present.surface_recorded ? VehicleInput::kSurface : VehicleInput::kAmbient));
  inputs.slope = S(value(VehicleInput::kSlope));
  inputs.wind_m_s = S(value(VehicleInput::kWind));
  inputs.air_density_ratio = S(1.0);
}

/// What goes into a vehicle, is stored by no spring and lost at an instant.
template <class S>
struct VehiclePowers {
  S motor_W{};   // of the motor at the simulated hubs
  S drive_W{};   // of all of it
  S roller_W{};  // of rollers, or slope, and of the rest of the vehicle on what is simulated
  S tire_W{};
  S slip_W{};
  S bearing_W{};
  S brake_W{};
  S drag_W{};
  S tire_damper_W{};
  S suspension_damper_W{};
  models::HeatFlows<S> heat;

  void add_slip_and_heat(const models::Instant<S>& wheel) {
    slip_W += wheel.motion.slip_power_W;
    heat.heat_in_W += wheel.heat.heat_in_W;
    heat.to_air_W += wheel.heat.to_air_W;
    heat.to_road_W += wheel.heat.to_road_W;
  }
};

/// 1 where the program counts, else 0.
inline double read_counted(const PresentProgram& present) {
  return present.segment.inputs[index_of(VehicleInput::kCounted)].start;
}

/// Integrands of the vehicle as a whole; `traction_N` as in VehicleIntegral::kTraction.
template <class S>
void put_vehicle_integrands(const PresentProgram& present, const S& traction_N, const S& speed_m_s,
                            const VehiclePowers<S>& power, S* integrands) {
  using std::abs;
  const auto put = [integrands](VehicleIntegral integral, const S& value) { integrands[index_of(integral)] = value; };
  const S counted(read_counted(present));
  put(VehicleIntegral::kTraction, traction_N);
  put(VehicleIntegral::kDistance, speed_m_s);
  put(VehicleIntegral::kCountedTime, counted);
  put(VehicleIntegral::kCountedDistance, counted * speed_m_s);
  put(VehicleIntegral::kDriveEnergy, positive_part(power.drive_W));
  put(VehicleIntegral::kRecuperated, positive_part(S(-power.drive_W)));
  put(VehicleIntegral::kDriveWork, power.motor_W);
  put(VehicleIntegral::kRollerWork, power.roller_W);
  put(VehicleIntegral::kThroughput, S(abs(power.motor_W)) + S(abs(power.roller_W)));
  put(VehicleIntegral::kKnotWork, zero<S>());
  put(VehicleIntegral::kTireLoss, power.tire_W);
  put(VehicleIntegral::kSlipLoss, power.slip_W);
  put(VehicleIntegral::kBearingLoss, power.bearing_W);
  put(VehicleIntegral::kBrakeLoss, power.brake_W);
  put(VehicleIntegral::kDragLoss, power.drag_W);
  put(VehicleIntegral::kTireDamperLoss, power.tire_damper_W);
  put(VehicleIntegral::kSuspensionDamperLoss, power.suspension_damper_W);
  put_heat(power.heat, &integrands[index_of(VehicleIntegral::kHeatGenerated)]);
}

/// Power of the battery for what is simulated, by the map of the whole vehicle; nothing without a map.
template <class S>
void put_battery_integrand(const VehicleLayout& layout, const S& speed_m_s, const S& drive_W, S* integrands) {
  if (!layout.powertrain_map.has_value()) return;
  const S share(layout.share);
  integrands[find_battery_integral(layout)] =
      share * models::calc_battery_W(*layout.powertrain_map, speed_m_s, S(drive_W / share));
}

/// Integrands of a wheel whose first one is `first`.
template <class S>
void put_wheel_integrands(const PresentProgram& present, const models::Instant<S>& now, const S& loss_force_N,
                          S* first) {
  const auto put = [first](WheelIntegral integral, const S& value) {
    first[static_cast<std::size_t>(integral)] = value;
  };
  const S counted(read_counted(present));
  const S rolling_W = now.rolling_resistance_N * now.motion.rolling_speed_m_s;
  const bool touches = value_of(now.motion.load_N) > 0.0;
  put(WheelIntegral::kLossForce, loss_force_N);
  put_tire_readings(now, first + static_cast<std::size_t>(WheelIntegral::kTireReadings));
  put(WheelIntegral::kRollingResistance, now.rolling_resistance_N);
  put(WheelIntegral::kParasitic, now.parasitic_N);
  put(WheelIntegral::kLongitudinalForce, now.recorded.longitudinal_force_N);
  put(WheelIntegral::kContactLoad, now.motion.load_N);
  put(WheelIntegral::kRollingEnergy, rolling_W);
  put(WheelIntegral::kCountedRollingEnergy, counted * rolling_W);
  put(WheelIntegral::kCountedRrc, touches ? S(counted * now.rolling_resistance_N / now.motion.load_N) : zero<S>());
}

}  // namespace rollrig::rigs
