#pragma once
/// Steps of a fixed grid that grow while nothing changes.

#include <vector>

#include "sim/program.h"

namespace rollrig::sim {

/// Steps after a change: of `first_s` at most for so many steps, then twice as long, and so on, up to `most_s`.
/// What is left to settle takes as long as it has taken so far, so that a step stays between a fortieth and an
/// eightieth of that time, of 80 steps. Assumed: 80.
struct StepGrowth {
  double first_s = 0.0;
  double most_s = 0.0;
  double steps_before_doubling = 80.0;

  double find_longest_s(double since_change_s) const;
};

/// Parts of a segment without a change, in each of which steps are equally long. The last change was `since_change_s`
/// before the segment.
void append_held_parts(const Segment& segment, double since_change_s, const StepGrowth& growth,
                       std::vector<Segment>& parts);

/// The same program, its steps growing from those of each phase where all inputs are held. A phase is a change. Not in
/// phases that may end early, where something is not in balance with its inputs.
/// Checked   tests/sim/held_steps_test.cpp
Program lengthen_held_steps(Program program, double most_s, double steps_before_doubling = 80.0);

}  // namespace rollrig::sim
