#pragma once
/// What an integrator and a recorder need to know of a system. `sim` knows states, rates, integrals,
/// events and channels; what they mean is the system's own.

#include <cstddef>
#include <string>
#include <vector>

#include "sim/core/quantity.h"
#include "sim/program.h"

namespace rollrig::sim {

/// A quantity that is integrated over the run: an energy, or a channel whose mean is recorded.
struct Integral {
  enum class Role { kChannel, kWorkIn, kDissipated, kHeatIn, kHeatOut, kThroughput };
  std::string name;
  Role role = Role::kChannel;
  double tolerance_SI = 1.0;  // absolute, of an integrator with error control
};

/// An energy that the system stores; its change enters one of the two audits.
struct Store {
  enum class Role { kMechanical, kHeat };
  std::string name;
  Role role = Role::kMechanical;
};

/// A recorded column: the mean over a sample of an integral's rate, or a value at the sample's time.
struct Channel {
  static constexpr std::size_t kInstant = static_cast<std::size_t>(-1);
  Quantity quantity;
  std::size_t integral = kInstant;  // index of the integral whose mean it is

  bool is_mean() const { return integral != kInstant; }
};

/// A coordinate of a body, for an animation: a state.
struct PoseCoordinate {
  Quantity quantity;
  std::size_t state = 0;  // its index
};

template <class S>
class OdeSystem {
 public:
  virtual ~OdeSystem() = default;

  virtual std::size_t state_count() const = 0;
  /// Absolute tolerance of each state, in SI units, for an integrator with error control.
  virtual std::vector<double> state_tolerances() const = 0;
  virtual const std::vector<Integral>& integrals() const = 0;
  virtual const std::vector<Store>& stores() const = 0;
  virtual const std::vector<Channel>& channels() const = 0;
  /// Where the bodies are; none for a system without bodies.
  virtual std::vector<PoseCoordinate> poses() const { return {}; }

  /// Sets the state at the start of the run, for the inputs of its first segment.
  virtual void initialize(const Segment& first, double time_s, S* state) = 0;
  /// Carries out the phase's commands.
  virtual void begin_phase(const Phase& phase, double time_s, S* state) = 0;
  /// Takes over a segment's inputs. May move the state and the integrals where an input jumps.
  virtual void begin_segment(const Segment& segment, double time_s, S* state, S* integrals) = 0;

  /// Rates of the states and of the integrals; either pointer may be null.
  virtual void evaluate(double time_s, const S* state, S* rates, S* integrands) = 0;
  /// Asked after each step. Throws RunFailure where the state is none that the system can have: an integrator may
  /// follow a run-away for ever, in ever smaller steps.
  virtual void require_possible(const S* state) const = 0;
  /// The value of a quantity that a StopCondition may watch. Throws std::invalid_argument for an unknown one.
  virtual S watch(const std::string& name, double time_s, const S* state) = 0;
  /// Values of the channels that are not means, in the order of channels(), SI units.
  virtual void observe(double time_s, const S* state, S* values) = 0;
  /// Energy in each store [J].
  virtual void calc_stored(double time_s, const S* state, S* stored_J) = 0;
};

/// Steps a system through a segment and interpolates inside the last step.
template <class S>
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Starts a run, its state and integrals zero.
  virtual void begin_run(double time_s) = 0;
  /// Starts a phase, whose commands may have changed the system. Called before the first segment of each phase.
  virtual void begin_phase() {}
  /// Starts a segment from the present state and integrals. Remembers nothing across the knot, unless an integrator's
  /// own comment says so.
  virtual void begin_segment(double max_step_s, const StopCondition* stop) = 0;
  /// Takes one step, at most to `end_time_s`; true when the stop condition was met at time_s().
  virtual bool step(double end_time_s) = 0;
  virtual double time_s() const = 0;
  /// At time_s(), until the next step; may be moved before a segment.
  virtual S* state() = 0;
  virtual S* integrals() = 0;
  /// At a time inside the last step.
  virtual void interpolate_state(double time_s, S* state) = 0;
  virtual void interpolate_integrals(double time_s, S* integrals) = 0;
};

}  // namespace rollrig::sim
