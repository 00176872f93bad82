#pragma once
/// Inputs, channels, integrals and stores of a drum rig: one list for both fidelities.

#include <string>
#include <vector>

#include "models/corner.h"
#include "sim/ode_system.h"

namespace rollrig::rigs {

/// Inputs of a drum rig's program, in the order of Segment::inputs.
enum class DrumInput : std::size_t { kSpeed, kLoad, kAmbient, kSurface };
constexpr std::size_t kDrumInputCount = 4;

/// Commands that a phase may give.
constexpr const char* kSetPressure = "set_pressure_Pa";  // gauge, at the gas's present temperature
constexpr const char* kMotor = "motor";                  // 1 on, 0 off: the drum coasts

/// Quantities that a phase may watch.
constexpr const char* kWatchSpeed = "speed_m_s";
constexpr const char* kWatchTireTemperature = "tire_temperature_K";

/// Integrals, in this order: means of measured channels, means of others, energies.
enum class DrumIntegral : std::size_t {
  kDrumTorque,
  kLinerTemperature,
  kCavityPressure,
  kGasTemperature,
  kRollingResistance,
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

/// How much of a run is integrated: the four channels that a rig can measure (for identification, where
/// every integral costs), or everything that the recording and the audits want.
enum class Detail { kMeasured, kFull };

/// Stores of energy, in this order.
enum class DrumStore : std::size_t { kKinetic, kGravity, kTireSpring, kSlipSpring, kHeat, kCount };

constexpr std::size_t index_of(DrumInput input) { return static_cast<std::size_t>(input); }
constexpr std::size_t index_of(DrumIntegral integral) { return static_cast<std::size_t>(integral); }
constexpr std::size_t index_of(DrumStore store) { return static_cast<std::size_t>(store); }

std::vector<sim::Integral> make_drum_integrals(Detail detail);
std::vector<sim::Store> make_drum_stores(Detail detail);

/// Recorded channels: given ones first, then measured ones, as in formats.md; then what only a
/// simulation knows; then the states of further thermal nodes and of effects.
std::vector<sim::Channel> make_drum_channels(const std::vector<models::CornerState>& states, bool surface_recorded,
                                             Detail detail);

/// How a run starts: the tire soaked at one temperature and inflated.
template <class S>
struct DrumStart {
  S tire_temperature_K{};
  S cold_pressure_Pa{};            // gauge, at that temperature
  S ambient_pressure_Pa{};         // absolute
  models::InitialPort<S> history;  // its load is that of the first instant, which the rig knows

  models::InitialPort<S> history_under(const S& load_N) const {
    models::InitialPort<S> under = history;
    under.load_N = load_N;
    return under;
  }

  models::Inflation<S> inflation() const { return {cold_pressure_Pa, tire_temperature_K, ambient_pressure_Pa}; }
};

/// Puts the recorded inputs of a segment at a time into `inputs`, all else as on a drum without effects.
template <class S>
void read_drum_inputs(const sim::Segment& segment, double elapsed_s, bool surface_recorded,
                      models::InputPort<S>& inputs) {
  const auto value = [&](DrumInput input) { return S(segment.inputs[index_of(input)].at(elapsed_s)); };
  inputs.speed_m_s = value(DrumInput::kSpeed);
  inputs.acceleration_m_s2 = S(segment.inputs[index_of(DrumInput::kSpeed)].slope_per_s);
  inputs.load_N = value(DrumInput::kLoad);
  inputs.ambient_K = value(DrumInput::kAmbient);
  inputs.surface_recorded = surface_recorded;
  inputs.surface_K = surface_recorded ? value(DrumInput::kSurface) : inputs.ambient_K;
}

/// The recorded inputs of a segment at a time.
template <class S>
models::InputPort<S> read_drum_inputs(const sim::Segment& segment, double elapsed_s, bool surface_recorded) {
  models::InputPort<S> inputs;
  inputs.air_density_ratio = S(1.0);
  read_drum_inputs(segment, elapsed_s, surface_recorded, inputs);
  return inputs;
}

}  // namespace rollrig::rigs
