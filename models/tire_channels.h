#pragma once
/// Channels of sensors in and at a tire: the table that says all there is to know of each on any machine. To add one:
/// docs/architecture.md, "A measured channel".

#include <array>
#include <stdexcept>
#include <tuple>

#include "models/ports.h"
#include "models/quantities.h"
#include "models/sensor.h"

namespace rollrig::models {

/// What all channels of one kind of quantity have in common.
struct ChannelFamily {
  /// From which a channel rises while its tire works: the recorded air, or the pressure of the cold tire.
  enum class Rest { kAmbient, kColdPressure };
  Range range;  // that a file may hold, in its unit
  Rest rest;
  double tolerance_SI;       // by which a plausible sample may differ from its simulation: this, and
  double share_of_rise;      // this share of the simulated rise
  double mean_tolerance_SI;  // absolute, of the integral over a second, for an integrator with error control
};

/// In degC. Assumed: wider than any tire or test cell.
constexpr Range kTemperatureRange = between(-80.0, 250.0);

/// Assumed: tolerances as diagnosis/checks/plausibility.h has them.
constexpr ChannelFamily kTemperatures{kTemperatureRange, ChannelFamily::Rest::kAmbient, 5.0, 0.4, 1e-3};
constexpr ChannelFamily kPressures{between(-100.0, 3000.0), ChannelFamily::Rest::kColdPressure, 15e3, 0.4, 10.0};

/// A channel's value in the state of a corner.
template <class S>
using TireReading = S (*)(const Instant<S>& now);

template <class Read>
constexpr ForEachScalar<TireReading> read_by(Read read) {
  return {read, read, read};
}

/// What is recorded is the mean of `read` over a sample.
struct TireChannel {
  Quantity quantity;
  const char* doc;
  ChannelFamily family;
  SensorParameters usual_sensor;  // SI
  const char* sensor;             // what the balance of a diagnosis calls its sensor
  bool is_expected;               // a set that lacks it is warned of
  ForEachScalar<TireReading> read;
};

/// Usual sensors: as assets/sensors/source.toml; their numbers in the order of SensorParameters.
inline constexpr std::array kTireChannels{
    TireChannel{quantities::kLinerTemperature,
                "temperature of the inner liner",
                kTemperatures,
                {0.25, 0.05, 60.0, 0.1, 0.1},
                "temperature sensor",
                true,
                read_by([](const auto& now) { return now.thermal.temperature_K[index_of(Node::kLiner)]; })},
    TireChannel{quantities::kCavityPressure,
                "gauge pressure",
                kPressures,
                {250.0, 100.0, 120.0, 50.0, 100.0},
                "pressure sensor",
                true,
                read_by([](const auto& now) { return now.pressure_Pa; })},
    // Where it was measured, H can be fitted (3.16).
    TireChannel{quantities::kGasTemperature,
                "temperature of the inflation gas",
                kTemperatures,
                {0.25, 0.05, 60.0, 0.1, 0.1},
                "gas temperature sensor",
                false,
                read_by([](const auto& now) { return now.thermal.temperature_K[index_of(Node::kGas)]; })}};

/// nullptr where no sensor of a tire reads it.
constexpr const TireChannel* find_tire_channel(const Quantity& quantity) {
  for (const TireChannel& channel : kTireChannels) {
    if (channel.quantity == quantity) return &channel;
  }
  return nullptr;
}

/// Throws std::invalid_argument where there is none.
constexpr const TireChannel& get_tire_channel(const Quantity& quantity) {
  if (const TireChannel* channel = find_tire_channel(quantity)) return *channel;
  throw std::invalid_argument("no sensor of a tire reads this");
}
/// Its place in the table.
constexpr std::size_t index_of_tire_channel(const Quantity& quantity) {
  return static_cast<std::size_t>(&get_tire_channel(quantity) - kTireChannels.data());
}

}  // namespace rollrig::models
