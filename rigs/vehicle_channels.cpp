#include "rigs/vehicle_channels.h"

#include <boost/algorithm/string/predicate.hpp>

#include "sim/energy_audit.h"

namespace rollrig::rigs {
namespace {

namespace quantities = models::quantities;

// Errors that do not matter, for the integrator's control: see drum_channels.cpp. A drive cycle moves a
// few 1e6 J in stretches of a second.
constexpr double kVehicleIntegralForceTimeError_N_s = 0.1;
constexpr double kVehicleIntegralDistanceError_m = 1e-3;
constexpr double kVehicleIntegralTimeError_s = 1e-3;
constexpr double kVehicleIntegralEnergyError_J = 0.002;  // of one step; a multi-cycle test has 1e5
constexpr double kVehicleIntegralThroughputError_J = 1e4;

}  // namespace

std::vector<sim::Integral> make_vehicle_integrals(const VehicleLayout& layout) {
  using Role = sim::Integral::Role;
  std::vector<sim::Integral> integrals{
      {"traction", Role::kChannel, kVehicleIntegralForceTimeError_N_s},
      {"distance", Role::kChannel, kVehicleIntegralDistanceError_m},
      {"counted_time", Role::kChannel, kVehicleIntegralTimeError_s},
      {"counted_distance", Role::kChannel, kVehicleIntegralDistanceError_m},
      {"drive_energy", Role::kChannel, kVehicleIntegralThroughputError_J},
      {"recuperated_energy", Role::kChannel, kVehicleIntegralThroughputError_J},
      {sim::kMotorWork, Role::kWorkIn, kVehicleIntegralEnergyError_J},
      {is_tied_down(layout.machine) ? "rollers" : "rest_of_vehicle", Role::kWorkIn, kVehicleIntegralEnergyError_J},
      {"throughput", Role::kThroughput, kVehicleIntegralThroughputError_J},
      {"load_changes", Role::kWorkIn, kVehicleIntegralEnergyError_J},
      {"tire_loss", Role::kDissipated, kVehicleIntegralEnergyError_J},
      {"slip_loss", Role::kDissipated, kVehicleIntegralEnergyError_J},
      {"bearing_loss", Role::kDissipated, kVehicleIntegralEnergyError_J},
      {"brake_loss", Role::kDissipated, kVehicleIntegralEnergyError_J},
      {"drag_loss", Role::kDissipated, kVehicleIntegralEnergyError_J},
      {"tire_damper", Role::kDissipated, kVehicleIntegralEnergyError_J},
      {"suspension_damper", Role::kDissipated, kVehicleIntegralEnergyError_J},
      {"heat_generated", Role::kHeatIn, kVehicleIntegralEnergyError_J},
      {"heat_to_air", Role::kHeatOut, kVehicleIntegralEnergyError_J},
      {"heat_to_road", Role::kHeatOut, kVehicleIntegralEnergyError_J},
  };
  for (std::size_t wheel = 0; wheel < layout.wheels.size(); ++wheel) {
    const auto add = [&](const char* name, double tolerance) {
      integrals.push_back({name, Role::kChannel, tolerance});
    };
    add("loss_force", kVehicleIntegralForceTimeError_N_s);
    add_tire_integrals(integrals);
    add("rolling_resistance", kVehicleIntegralForceTimeError_N_s);
    add("parasitic", kVehicleIntegralForceTimeError_N_s);
    add("longitudinal_force", kVehicleIntegralForceTimeError_N_s);
    add("contact_load", kVehicleIntegralForceTimeError_N_s);
    add("rolling_energy", kVehicleIntegralEnergyError_J);
    add("counted_rolling_energy", kVehicleIntegralEnergyError_J);
    add("counted_rrc", kVehicleIntegralTimeError_s);
  }
  if (layout.powertrain_map.has_value()) {
    integrals.push_back({"battery_energy", Role::kChannel, kVehicleIntegralThroughputError_J});
  }
  return integrals;
}

std::vector<sim::Store> make_vehicle_stores() {
  using Role = sim::Store::Role;
  return {{"kinetic", Role::kMechanical},
          {"gravity", Role::kMechanical},
          {"springs", Role::kMechanical},
          {"slip_spring", Role::kMechanical},
          {"stored_heat", Role::kHeat}};
}

Quantity wheel_channel(const Quantity& quantity, const std::string& position) {
  if (position.empty()) return quantity;
  const std::string name = std::string(quantity.name()) + "_" + position;
  return intern_quantity(Quantity(name, quantity.unit_suffix()).header());
}

std::optional<Quantity> without_position(const Quantity& channel, const std::string& position) {
  const std::string mark = "_" + position;
  if (position.empty() || !boost::ends_with(channel.name(), mark)) return std::nullopt;
  return Quantity(channel.name().substr(0, channel.name().size() - mark.size()), channel.unit_suffix());
}

std::optional<Quantity> find_at_wheel(const Quantity& recorded, const VehicleLayout& layout, std::size_t wheel) {
  for (std::size_t i = 0; i < layout.wheels.size(); ++i) {
    const std::optional<Quantity> own = without_position(recorded, layout.wheels[i].position);
    if (own.has_value()) return i == wheel ? own : std::nullopt;
  }
  return wheel == 0 ? std::optional(recorded) : std::nullopt;
}

std::vector<sim::Channel> make_vehicle_channels(const VehicleLayout& layout,
                                                const std::vector<std::vector<models::CornerState>>& states,
                                                bool surface_recorded) {
  std::vector<sim::Channel> channels{{quantities::kSpeed}, {quantities::kAmbient}};
  if (surface_recorded) channels.push_back({quantities::kSurfaceTemperature});
  channels.push_back({quantities::kTractionForce, index_of(VehicleIntegral::kTraction)});
  for (std::size_t i = 0; i < layout.wheels.size(); ++i) {
    const auto mean = [&](const Quantity& quantity, WheelIntegral integral) {
      channels.push_back({wheel_channel(quantity, layout.wheels[i]), index_of(integral, i)});
    };
    channels.push_back({wheel_channel(quantities::kLoad, layout.wheels[i])});
    mean(quantities::kLongitudinalForce, WheelIntegral::kLongitudinalForce);
    mean(quantities::kLossForce, WheelIntegral::kLossForce);
    std::size_t reading = index_of(WheelIntegral::kTireReadings, i);
    for (const models::TireChannel& tire : models::kTireChannels) {
      channels.push_back({wheel_channel(tire.quantity, layout.wheels[i]), reading++});
    }
    mean(quantities::kRollingResistance, WheelIntegral::kRollingResistance);
    mean(quantities::kParasiticLoss, WheelIntegral::kParasitic);
    mean(quantities::kContactLoad, WheelIntegral::kContactLoad);
    for (std::size_t k = 2; k < states[i].size(); ++k) {  // after rubber and gas
      channels.push_back({wheel_channel(states[i][k].quantity, layout.wheels[i])});
    }
  }
  return channels;
}

}  // namespace rollrig::rigs
