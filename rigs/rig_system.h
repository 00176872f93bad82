#pragma once
/// What every rig is towards the simulator: its lists, the commands and watches of its program, how a run starts.

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "models/tire_channels.h"
#include "sim/ode_system.h"

namespace rollrig::rigs {

/// Commands that a phase may give.
constexpr const char* kSetPressure = "set_pressure_Pa";  // gauge, of every tire, at its gas's present temperature
constexpr const char* kDrive = "drive";  // 1: motor or driver follow the program's speed; 0: the rig coasts

/// Quantities that a phase may watch.
constexpr const char* kWatchSpeed = "speed_m_s";
constexpr const char* kWatchTireTemperature = "tire_temperature_K";  // of the first tire

/// How much of a run is integrated: the channels that a rig can measure (for identification, where every integral
/// costs), or everything that the recording and the audits want.
enum class Detail { kMeasured, kFull };

/// Stores of energy of a rig in motion, in this order.
enum class RigStore : std::size_t { kKinetic, kGravity, kSprings, kSlipSpring, kHeat, kCount };
constexpr std::size_t index_of(RigStore store) { return static_cast<std::size_t>(store); }

/// How a run starts: every tire soaked at one temperature and inflated.
template <class S>
struct RigStart {
  S tire_temperature_K{};
  S cold_pressure_Pa{};            // gauge, at that temperature
  S ambient_pressure_Pa{};         // absolute
  models::InitialPort<S> history;  // its load is that of the first instant, which the rig knows

  /// What came before the run: it follows another one, or a standstill of a known length, or (neither) a long soak.
  void set_history(bool started_warm, const std::optional<double>& rest_before_s) {
    history.started_warm = started_warm;
    history.rest_before_s = S(rest_before_s.value_or(0.0));
    history.soaked = !started_warm && !rest_before_s.has_value();
  }

  models::InitialPort<S> history_under(const S& load_N) const {
    models::InitialPort<S> under = history;
    under.load_N = load_N;
    return under;
  }

  /// Of a tire with a pressure of its own, or 0.
  models::Inflation<S> inflation(double own_pressure_Pa = 0.0) const {
    const S pressure_Pa = own_pressure_Pa > 0.0 ? S(own_pressure_Pa) : cold_pressure_Pa;
    return {pressure_Pa, tire_temperature_K, ambient_pressure_Pa};
  }
};

/// What a run's program asks for at present.
struct PresentProgram {
  sim::Segment segment;
  double segment_start_s = 0.0;
  bool surface_recorded = false;
  bool drive_on = true;

  void take(const sim::Segment& next, double time_s) {
    segment = next;
    segment_start_s = time_s;
  }
  double elapsed_s(double time_s) const { return time_s - segment_start_s; }
};

template <class S>
class RigSystem : public sim::OdeSystem<S> {
 public:
  const std::vector<sim::Integral>& integrals() const override { return lists_.integrals; }
  const std::vector<sim::Store>& stores() const override { return lists_.stores; }
  const std::vector<sim::Channel>& channels() const override { return lists_.channels; }

  void begin_phase(const sim::Phase& phase, double, S* state) override {
    for (const sim::Command& command : phase.commands) {
      if (command.name == kSetPressure) {
        set_pressure(command.value_SI, state);
      } else if (command.name == kDrive) {
        set_drive(command.value_SI != 0.0, state);
      } else {
        throw std::invalid_argument("rig: unknown command " + command.name);
      }
    }
  }

  S watch(const std::string& name, double time_s, const S* state) override {
    if (name == kWatchTireTemperature) return state[tire_temperature_state()];
    if (name != kWatchSpeed) throw std::invalid_argument("rig: cannot watch " + name);
    return find_recorded_speed_m_s(time_s, state);
  }

 protected:
  struct Lists {
    std::vector<sim::Integral> integrals;
    std::vector<sim::Store> stores;
    std::vector<sim::Channel> channels;
  };

  RigSystem(Lists lists, bool surface_recorded) : lists_(std::move(lists)) {
    present_.surface_recorded = surface_recorded;
  }

  virtual void set_pressure(double pressure_Pa, S* state) = 0;
  virtual void set_drive(bool on, S* /*state*/) { present_.drive_on = on; }
  /// Of the surface as it moves, whether something drives it or not.
  virtual S find_recorded_speed_m_s(double time_s, const S* state) = 0;
  /// Index of the first tire's rubber temperature.
  virtual std::size_t tire_temperature_state() const = 0;

  PresentProgram present_;

 private:
  Lists lists_;
};

/// Integrals of what a tire's sensors read, in the order of models::kTireChannels.
inline void add_tire_integrals(std::vector<sim::Integral>& integrals) {
  for (const models::TireChannel& channel : models::kTireChannels) {
    integrals.push_back(
        {std::string(channel.quantity.name()), sim::Integral::Role::kChannel, channel.family.mean_tolerance_SI});
  }
}

/// Their integrands.
template <class S>
void put_tire_readings(const models::Instant<S>& now, S* readings) {
  for (const models::TireChannel& channel : models::kTireChannels) {
    *readings++ = std::get<models::TireReading<S>>(channel.read)(now);
  }
}

/// Heat generated, given to the air and to the road.
template <class S>
void put_heat(const models::HeatFlows<S>& heat, S* powers_W) {
  powers_W[0] = heat.heat_in_W;
  powers_W[1] = heat.to_air_W;
  powers_W[2] = heat.to_road_W;
}

}  // namespace rollrig::rigs
