#include "rigs/vehicle_channels.h"

#include <boost/algorithm/string/predicate.hpp>

#include "sim/core/units.h"
#include "sim/energy_audit.h"

namespace rollrig::rigs {
namespace {

// Errors that do not matter, for the integrator's control: see drum_channels.cpp. A drive cycle moves a
// few 1e6 J in stretches of a second.
constexpr double kForceTime_N_s = 0.1;
constexpr double kDistance_m = 1e-3;
constexpr double kTime_s = 1e-3;
constexpr double kEnergy_J = 0.002;  // of one step; a multi-cycle test has 1e5
constexpr double kYardstick_J = 1e4;

}  // namespace

std::vector<sim::Integral> make_vehicle_integrals(const VehicleLayout& layout) {
  using Role = sim::Integral::Role;
  std::vector<sim::Integral> integrals{
      {"traction", Role::kChannel, kForceTime_N_s},
      {"distance", Role::kChannel, kDistance_m},
      {"counted_time", Role::kChannel, kTime_s},
      {"counted_distance", Role::kChannel, kDistance_m},
      {"drive_energy", Role::kChannel, kYardstick_J},
      {"recuperated_energy", Role::kChannel, kYardstick_J},
      {sim::kMotorWork, Role::kWorkIn, kEnergy_J},
      {is_tied_down(layout.machine) ? "rollers" : "rest_of_vehicle", Role::kWorkIn, kEnergy_J},
      {"throughput", Role::kThroughput, kYardstick_J},
      {"load_changes", Role::kWorkIn, kEnergy_J},
      {"tire_loss", Role::kDissipated, kEnergy_J},
      {"slip_loss", Role::kDissipated, kEnergy_J},
      {"bearing_loss", Role::kDissipated, kEnergy_J},
      {"brake_loss", Role::kDissipated, kEnergy_J},
      {"drag_loss", Role::kDissipated, kEnergy_J},
      {"tire_damper", Role::kDissipated, kEnergy_J},
      {"suspension_damper", Role::kDissipated, kEnergy_J},
      {"heat_generated", Role::kHeatIn, kEnergy_J},
      {"heat_to_air", Role::kHeatOut, kEnergy_J},
      {"heat_to_road", Role::kHeatOut, kEnergy_J},
  };
  for (std::size_t wheel = 0; wheel < layout.wheels.size(); ++wheel) {
    const auto add = [&](const char* name, double tolerance) {
      integrals.push_back({name, Role::kChannel, tolerance});
    };
    add("loss_force", kForceTime_N_s);
    add_tire_integrals(integrals);
    add("rolling_resistance", kForceTime_N_s);
    add("parasitic", kForceTime_N_s);
    add("longitudinal_force", kForceTime_N_s);
    add("contact_load", kForceTime_N_s);
    add("rolling_energy", kEnergy_J);
    add("counted_rolling_energy", kEnergy_J);
    add("counted_rrc", kTime_s);
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

std::string wheel_channel(const std::string& name, const std::string& position) {
  if (position.empty()) return name;
  const std::string quantity = name_without_unit(name);
  return quantity + "_" + position + name.substr(quantity.size());
}

std::optional<std::string> without_position(const std::string& channel, const std::string& position) {
  const std::string quantity = name_without_unit(channel);
  const std::string mark = "_" + position;
  if (position.empty() || !boost::ends_with(quantity, mark)) return std::nullopt;
  return quantity.substr(0, quantity.size() - mark.size()) + channel.substr(quantity.size());
}

std::string name_at_wheel(const std::string& recorded, const VehicleLayout& layout, std::size_t wheel) {
  for (std::size_t i = 0; i < layout.wheels.size(); ++i) {
    const std::optional<std::string> name = without_position(recorded, layout.wheels[i].position);
    if (name.has_value()) return i == wheel ? *name : std::string();
  }
  return wheel == 0 ? recorded : std::string();
}

std::vector<sim::Channel> make_vehicle_channels(const VehicleLayout& layout,
                                                const std::vector<std::vector<models::CornerState>>& states,
                                                bool surface_recorded) {
  std::vector<sim::Channel> channels{{"speed_km_h"}, {"ambient_degC"}};
  if (surface_recorded) channels.push_back({"surface_temperature_degC"});
  channels.push_back({"traction_force_N", index_of(VehicleIntegral::kTraction)});
  for (std::size_t i = 0; i < layout.wheels.size(); ++i) {
    const auto mean = [&](const char* name, WheelIntegral integral) {
      channels.push_back({wheel_channel(name, layout.wheels[i]), index_of(integral, i)});
    };
    channels.push_back({wheel_channel("load_N", layout.wheels[i])});
    mean("longitudinal_force_N", WheelIntegral::kLongitudinalForce);
    mean("loss_force_N", WheelIntegral::kLossForce);
    std::size_t reading = index_of(WheelIntegral::kTireReadings, i);
    for (const models::TireChannel& tire : models::kTireChannels) {
      channels.push_back({wheel_channel(tire.quantity.header(), layout.wheels[i]), reading++});
    }
    mean("rolling_resistance_N", WheelIntegral::kRollingResistance);
    mean("parasitic_N", WheelIntegral::kParasitic);
    mean("contact_load_N", WheelIntegral::kContactLoad);
    for (std::size_t k = 2; k < states[i].size(); ++k) {  // after rubber and gas
      channels.push_back({wheel_channel(states[i][k].key, layout.wheels[i])});
    }
  }
  return channels;
}

}  // namespace rollrig::rigs
