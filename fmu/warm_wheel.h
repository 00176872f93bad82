#pragma once
/// A warm tire on its wheel for another simulator, which gives its motion, load, drive and surroundings: what stands
/// behind the C API and the FMU.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fmu/wheel_model.h"
#include "sim/program.h"

namespace rollrig::fmu {

template <class S>
struct WheelEquations;
class FastestRate;

enum class Role { kInput, kOutput, kState, kRate, kParameter, kTime };

/// A number that another simulator sees, in the unit that its name ends with; ratios have none. der(x) is the rate of
/// the state x, in the unit of x per second.
struct Variable {
  std::string name;
  Role role;
  std::string doc;
  Range range;            // allowed, of an input or a parameter
  Unit unit;              // what "value" means
  double start = 0.0;     // of an input or a parameter
  double nominal = 1.0;   // size that matters, of a state
  std::size_t index = 0;  // among those of the same role
};

/// Times of a wheel are from -kLatest_s to kLatest_s. Farther from 0, doubles are so far apart that a step of the
/// integrator can be lost in rounding: here they are 2e-6 s apart, and the shortest step is 5e-6 s, near standstill at
/// the largest acceleration.
/// Assumed: longer than any simulation, and later than any clock that starts in 1970.
constexpr double kLatest_s = 1e10;
/// Throws InputError for a time that a wheel cannot have.
void require_time(double time_s);

/// A moment of a wheel, from which it goes on as if nothing had been in between. In SI units.
struct Snapshot {
  std::vector<double> parameters;
  std::vector<double> inputs;
  std::vector<double> input_slopes;
  std::vector<double> states;  // empty before initialize()
  double time_s = 0.0;
  std::uint64_t wheel = 0;  // checksum of the numbers that its wheel was made of
};

/// One wheel. Two threads may use two wheels at once, but not one wheel.
///
/// Parameters may be set before initialize() only, inputs always. Inputs, outputs and states are in SI units,
/// parameters in those of files. Inputs hold through advance(), unless they have a slope: then they change linearly
/// through it.
///
/// Equation  rigs/driven_wheel.h; states are those of models/corner.h, and the energy that the tire has lost. advance()
///           steps by sim/fixed_grid_integrator.h on the grid of rigs/standstill_grid.h. Where the states change faster
///           than its steps can follow, steps are shorter: at most 2/FastestRate
/// Errors    InputError: a value that is not allowed, not a number, or set too late. RunFailure: a state that no tire
///           can have. After either, time, states, inputs and parameters are as before the call
/// Checked   tests/fmu/co_simulation_test.cpp
class WarmWheel {
 public:
  explicit WarmWheel(const WheelModel& model);
  ~WarmWheel();
  WarmWheel(const WarmWheel&) = delete;
  WarmWheel& operator=(const WarmWheel&) = delete;

  /// Inputs, outputs, states, rates, parameters, time, in this order.
  const std::vector<Variable>& variables() const { return variables_; }
  std::size_t state_count() const { return state_count_; }
  /// Variables of the first state and of its rate; the others follow.
  std::size_t first_state() const { return first_state_; }
  std::size_t first_rate() const { return first_state_ + state_count_; }

  void set(std::size_t variable, double value);
  bool is_state(std::size_t variable) const;
  /// One of the states, as set_states().
  void set_state(std::size_t variable, double value);
  /// An output, a state or a rate is that of the present inputs and states.
  double get(std::size_t variable);
  /// The value of an input or a parameter; 0 of all else.
  double get_if_settable(std::size_t variable);
  /// Slope of an input, in its unit per second, through the next advance(); then it is 0 again. The slope of the speed
  /// is the input acceleration_m_s2, which stays. The acceleration itself has none.
  void set_input_slope(std::size_t variable, double slope_per_s);
  /// The slope of an input; 0 of all else.
  double get_slope_if_input(std::size_t variable) const;

  bool is_initialized() const { return simulation_ != nullptr; }
  /// Puts the tire at the start: all its temperatures are the parameter start.tire_temperature_degC. `time_s`: at most
  /// kLatest_s from 0, as in set_time() and at the end of advance().
  void initialize(double time_s);
  /// Back to before initialize(): parameters and inputs stay, and may be set.
  void undo_initialize();
  /// Back to how it was created.
  void reset();

  double time_s() const { return time_s_; }
  /// Sets only the time, for a solver of the caller's.
  void set_time(double time_s);
  /// Goes on by `duration_s` [s], more than 0 and at most 1e5 steps of the integrator long. Inputs with a slope end
  /// where it leads. If steps would have to be shorter than kShortestStep_s, throws an InputError that names the
  /// parameter where the parameters alone cause it, else a RunFailure.
  void advance(double duration_s);

  /// In the units of their variables.
  void get_states(double* states) const;
  void set_states(const double* states);
  /// Rates of all states, in the units of their variables.
  void get_rates(double* rates);

  enum class Moment { kPresent, kStart };
  /// Directional derivative, exact (dual numbers), in the units of the variables.
  /// Equation  derivative[i] = sum over k of d unknown[i]/d known[k] direction[k]
  /// Symbols   unknown: outputs, states and rates; known: inputs, and at the present states as well. At the start,
  ///           states follow from the inputs
  std::vector<double> differentiate(const std::vector<std::size_t>& unknown, const std::vector<std::size_t>& known,
                                    const std::vector<double>& direction, Moment moment = Moment::kPresent);

  Snapshot take_snapshot() const;
  /// Throws InputError where the snapshot is not one of such a wheel.
  void restore(const Snapshot& snapshot);

 private:
  struct Simulation;

  void list_parameters();
  void list_variables();
  void add_variable(Variable variable);
  const Variable& variable(std::size_t index) const;
  const Variable& state(std::size_t index) const { return variables_[first_state_ + index]; }
  void require_initialized() const;
  double find_slope(std::size_t input) const;
  std::unique_ptr<Simulation> make_simulation(double time_s) const;
  sim::Segment make_segment(double duration_s) const;
  void evaluate();
  void forget_derivatives();
  double choose_step_s(const sim::Segment& piece, const double* states);

  WheelModel original_model_;   // for reset()
  std::uint64_t checksum_ = 0;  // of the original model
  WheelModel model_;
  std::vector<double*> parameters_;  // into model_, SI
  std::vector<Variable> variables_;
  std::size_t first_state_ = 0;
  std::size_t state_count_ = 0;
  std::vector<double> inputs_;
  std::vector<double> input_slopes_;
  std::vector<double> states_;
  double time_s_ = 0.0;
  bool is_evaluated_ = false;
  std::vector<double> rates_;
  std::vector<double> outputs_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<WheelEquations<Jet>> jet_simulation_;  // made when a derivative is asked for
  std::unique_ptr<FastestRate> fastest_rate_;            // made by the first advance()
};

}  // namespace rollrig::fmu
