#include "rigs/drum_channels.h"

#include "sim/energy_audit.h"

namespace rollrig::rigs {
namespace {

namespace quantities = models::quantities;

// Errors that do not matter, for the integrator's control: of a mean over one second a few 1e-5 of its
// usual size, of an energy a few 1e-9 of a test's motor work (1e6 J).
constexpr double kDrumForceTimeError_N_s = 1e-3;
constexpr double kDrumEnergyError_J = 5e-3;
constexpr double kDrumThroughputError_J = 1e3;  // has a kink where the motor turns to braking; wanted to a few digits

}  // namespace

std::vector<sim::Integral> make_drum_integrals(Detail detail) {
  using Role = sim::Integral::Role;
  std::vector<sim::Integral> integrals{{"force_reading", Role::kChannel, kDrumForceTimeError_N_s}};
  add_tire_integrals(integrals);
  if (detail == Detail::kMeasured) return integrals;
  const std::vector<sim::Integral> further{
      {"rolling_resistance", Role::kChannel, kDrumForceTimeError_N_s},
      {"parasitic", Role::kChannel, kDrumForceTimeError_N_s},
      {"spindle_force", Role::kChannel, kDrumForceTimeError_N_s},
      {"contact_load", Role::kChannel, kDrumForceTimeError_N_s},
      {sim::kMotorWork, Role::kWorkIn, kDrumEnergyError_J},
      {"motor_throughput", Role::kThroughput, kDrumThroughputError_J},
      {"load_actuator", Role::kWorkIn, kDrumEnergyError_J},
      {"load_changes", Role::kWorkIn, kDrumEnergyError_J},
      {"tire_loss", Role::kDissipated, kDrumEnergyError_J},
      {"slip_loss", Role::kDissipated, kDrumEnergyError_J},
      {"bearing_loss", Role::kDissipated, kDrumEnergyError_J},
      {"tire_damper", Role::kDissipated, kDrumEnergyError_J},
      {"cylinder_damper", Role::kDissipated, kDrumEnergyError_J},
      {"heat_generated", Role::kHeatIn, kDrumEnergyError_J},
      {"heat_to_air", Role::kHeatOut, kDrumEnergyError_J},
      {"heat_to_road", Role::kHeatOut, kDrumEnergyError_J},
  };
  integrals.insert(integrals.end(), further.begin(), further.end());
  return integrals;
}

std::vector<sim::Store> make_drum_stores(Detail detail) {
  using Role = sim::Store::Role;
  if (detail == Detail::kMeasured) return {};
  return {{"kinetic", Role::kMechanical},
          {"gravity", Role::kMechanical},
          {"tire_spring", Role::kMechanical},
          {"slip_spring", Role::kMechanical},
          {"stored_heat", Role::kHeat}};
}

std::vector<sim::Channel> make_drum_channels(const models::MachineTraits& machine,
                                             const std::vector<models::CornerState>& states, bool surface_recorded,
                                             Detail detail) {
  std::vector<sim::Channel> channels;
  const auto add = [&](const Quantity& quantity, DrumIntegral integral) {
    channels.push_back({quantity, index_of(integral)});
  };
  if (detail == Detail::kFull) {
    channels = {{quantities::kSpeed}, {quantities::kLoad}, {quantities::kAmbient}};
    if (surface_recorded) channels.push_back({quantities::kSurfaceTemperature});
  }
  add(machine.force, DrumIntegral::kForceReading);
  std::size_t reading = index_of(DrumIntegral::kTireReadings);
  for (const models::TireChannel& tire : models::kTireChannels) channels.push_back({tire.quantity, reading++});
  if (detail == Detail::kMeasured) return channels;
  add(quantities::kRollingResistance, DrumIntegral::kRollingResistance);
  add(quantities::kParasiticLoss, DrumIntegral::kParasitic);
  add(quantities::kSpindleForce, DrumIntegral::kSpindleForce);
  add(quantities::kContactLoad, DrumIntegral::kContactLoad);
  add(quantities::kMotorPower, DrumIntegral::kMotorWork);
  for (std::size_t i = 2; i < states.size(); ++i) channels.push_back({states[i].quantity});  // after rubber and gas
  return channels;
}

}  // namespace rollrig::rigs
