#pragma once
/// Steps of a fixed grid that grow while nothing changes.

#include <vector>

#include "sim/program.h"

namespace rollrig::sim {

/// How steps grow after a change of an input: `first_s` at most for N = `steps_before_doubling` such steps, then twice
/// as long, and so on, up to `most_s`. Steps that have grown are between 1/N and 2/N of the time since the change: what
/// has not settled by then changes about as slowly as that time is long. Assumed: N = 80.
struct StepGrowth {
  double first_s = 0.0;
  double most_s = 0.0;
  double steps_before_doubling = 80.0;

  double find_longest_s(double since_change_s) const;
};

/// Appends the parts of a segment in which no input changes; in each, steps are equally long. The last change was
/// `since_change_s` before the segment.
void append_held_parts(const Segment& segment, double since_change_s, const StepGrowth& growth,
                       std::vector<Segment>& parts);

/// The same program with growing steps wherever all inputs are constant. The start of a phase counts as a change.
/// Phases that may end early keep their steps: there the state changes although no input does, such as the speed of a
/// coastdown.
/// Checked   tests/sim/held_steps_test.cpp
Program lengthen_held_steps(Program program, double most_s, double steps_before_doubling = 80.0);

}  // namespace rollrig::sim
