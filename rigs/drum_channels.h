#pragma once
/// Inputs, channels, integrals and stores of a drum rig, or of a belt in the place of the drum: one list for both
/// fidelities.

#include <vector>

#include "models/corner.h"
#include "rigs/rig_system.h"

namespace rollrig::rigs {

/// Inputs of a drum rig's program, in the order of Segment::inputs.
enum class DrumInput : std::size_t { kSpeed, kLoad, kAmbient, kSurface };
constexpr std::size_t kDrumInputCount = 4;

/// Integrals, in this order: means of measured channels, means of others, energies.
enum class DrumIntegral : std::size_t {
  kForceReading,
  kTireReadings,  // one each of models::kTireChannels
  kRollingResistance = kTireReadings + models::kTireChannels.size(),
  kParasitic,
  kSpindleForce,
  kContactLoad,
  kMotorWork,
  kMotorThroughput,
  kLoadActuatorWork,
  kKnotWork,
  kTireLoss,
  kSlipLoss,
  kBearingLoss,
  kTireDamperLoss,
  kCylinderDamperLoss,
  kHeatGenerated,
  kHeatToAir,
  kHeatToRoad,
  kCount
};

constexpr std::size_t index_of(DrumInput input) { return static_cast<std::size_t>(input); }
constexpr std::size_t index_of(DrumIntegral integral) { return static_cast<std::size_t>(integral); }

std::vector<sim::Integral> make_drum_integrals(Detail detail);
std::vector<sim::Store> make_drum_stores(Detail detail);

/// Recorded channels: given ones first, then measured ones, as in formats.md; then what only a
/// simulation knows; then the states of further thermal nodes and of effects.
std::vector<sim::Channel> make_drum_channels(const models::MachineTraits& machine,
                                             const std::vector<models::CornerState>& states, bool surface_recorded,
                                             Detail detail);

/// Puts what is recorded at a time into `inputs`, all else as on a drum without effects.
template <class S>
void read_drum_inputs(const PresentProgram& present, double time_s, models::InputPort<S>& inputs) {
  const double elapsed_s = present.elapsed_s(time_s);
  const sim::Ramps& given = present.segment.inputs;
  const auto value = [&](DrumInput input) { return S(given[index_of(input)].at(elapsed_s)); };
  inputs.speed_m_s = value(DrumInput::kSpeed);
  inputs.acceleration_m_s2 = S(given[index_of(DrumInput::kSpeed)].slope_per_s);
  inputs.load_N = value(DrumInput::kLoad);
  inputs.ambient_K = value(DrumInput::kAmbient);
  inputs.surface_recorded = present.surface_recorded;
  inputs.surface_K = present.surface_recorded ? value(DrumInput::kSurface) : inputs.ambient_K;
}

/// The same without a former reading.
template <class S>
models::InputPort<S> read_drum_inputs(const PresentProgram& present, double time_s) {
  models::InputPort<S> inputs;
  inputs.air_density_ratio = S(1.0);
  read_drum_inputs(present, time_s, inputs);
  return inputs;
}

/// What goes into a drum rig and is lost in it at an instant, beside slip and heat.
template <class S>
struct DrumPowers {
  S motor_W{};
  S load_actuator_W{};
  S tire_W{};
  S bearing_W{};
  S tire_damper_W{};
  S cylinder_damper_W{};
};

/// Integrands of the measured channels.
template <class S>
void put_drum_readings(const models::Instant<S>& now, const S& force_reading, S* integrands) {
  integrands[index_of(DrumIntegral::kForceReading)] = force_reading;
  put_tire_readings(now, &integrands[index_of(DrumIntegral::kTireReadings)]);
}

/// All further integrands.
template <class S>
void put_drum_powers(const models::Instant<S>& now, const DrumPowers<S>& power, S* integrands) {
  using std::abs;
  const auto put = [integrands](DrumIntegral integral, const S& value) { integrands[index_of(integral)] = value; };
  put(DrumIntegral::kRollingResistance, now.rolling_resistance_N);
  put(DrumIntegral::kParasitic, now.parasitic_N);
  put(DrumIntegral::kSpindleForce, now.motion.longitudinal_force_N);
  put(DrumIntegral::kContactLoad, now.motion.load_N);
  put(DrumIntegral::kMotorWork, power.motor_W);
  put(DrumIntegral::kMotorThroughput, abs(power.motor_W));
  put(DrumIntegral::kLoadActuatorWork, power.load_actuator_W);
  put(DrumIntegral::kKnotWork, zero<S>());
  put(DrumIntegral::kTireLoss, power.tire_W);
  put(DrumIntegral::kSlipLoss, now.motion.slip_power_W);
  put(DrumIntegral::kBearingLoss, power.bearing_W);
  put(DrumIntegral::kTireDamperLoss, power.tire_damper_W);
  put(DrumIntegral::kCylinderDamperLoss, power.cylinder_damper_W);
  put_heat(now.heat, &integrands[index_of(DrumIntegral::kHeatGenerated)]);
}

}  // namespace rollrig::rigs
