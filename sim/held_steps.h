#pragma once
/// Steps of a fixed grid that grow while nothing changes.

#include <functional>
#include <optional>

#include "sim/program.h"

namespace rollrig::sim {

/// How steps grow after a change of an input: N = `steps_before_doubling` steps of at most `first_s`, then steps twice
/// as long, and so on, up to `most_s`. A step that has grown is between 1/N and 2/N of the time since the change. That is
/// fine enough: what decays quickly has settled by then, and what is left changes slowly. Assumed: N = 80.
struct StepGrowth {
  double first_s = 0.0;
  double most_s = 0.0;
  double steps_before_doubling = 80.0;

  double find_longest_s(double since_change_s) const;
};

/// Decides what counts as a change of the inputs.
struct InputChanges {
  /// The longest step of a segment whose steps must not grow; `first_s` limits it as well. Nothing if they may grow.
  std::function<std::optional<double>(const Segment&)> find_step_s;
  /// Whether `after` starts with the inputs of `before`, which are constant.
  std::function<bool(const Segment& before, const Segment& after)> continues;
};

/// Cuts the segments of a phase into parts with equally long steps, which grow while inputs do not change. The start of
/// the phase counts as a change. Throws std::invalid_argument where `first_s` is not above 0.
/// Checked   tests/sim/held_steps_test.cpp, tests/measurements/resimulation_test.cpp
void lengthen_held_steps(const StepGrowth& growth, const InputChanges& changes, Phase& phase);

/// The same program with growing steps wherever all inputs are constant. The start of a phase counts as a change.
/// Phases that may end early keep their steps: there the state changes although no input does, such as the speed of a
/// coastdown.
/// Checked   tests/sim/held_steps_test.cpp
Program lengthen_held_steps(Program program, double most_s, double steps_before_doubling = 80.0);

}  // namespace rollrig::sim
