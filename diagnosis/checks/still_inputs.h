#pragma once
/// Given columns that hold one number through a whole run although they should move.

#include <string>
#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

struct StillInput {
  Quantity column;
  std::vector<std::size_t> runs;
  std::string text;         // what is odd about it, a sentence without its stop
  bool is_certain = false;  // else a doubt
};

/// Ambient temperature, and on the road the height, that stand at one number from the first row of a run to the last.
///
/// In some runs  The other runs say how often the column moves. A doubt where it should have moved three times in the
///               run, at the lowest rate of the others. Certain on the road from ten times on, and everywhere where a
///               soaked tire began more than 5 K from the temperature
/// In all runs   The temperature alone, and on the road alone: a laboratory may hold it, and the height of a level road
///               is one number. Certain where it is one number in all of two sessions or more, and a soaked tire began
///               more than 5 K from it or the tires began 5 K or more apart. A doubt where all runs have one number and
///               last 10 min or more
/// Source        Assumed: all limits
/// Checked       tests/diagnosis/still_inputs_test.cpp
std::vector<StillInput> find_still_inputs(const measurements::MeasurementSet& set);

}  // namespace rollrig::diagnosis
