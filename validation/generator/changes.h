#pragma once
/// Where the effects of a case change the readings.

#include <string>
#include <vector>

#include "validation/generator/measurement_set.h"

namespace rollrig::generator {

/// A stretch of a run in one channel, its end left out.
struct Place {
  std::string channel;
  std::string run;
  double start_s = 0.0;
  double end_s = 0.0;
};

/// In noise floors: of means over 10 samples that are compared.
struct Change {
  std::size_t blocks = 0;
  double mean = 0.0;
  double rms = 0.0;
};

struct ChangeAt {
  Change of_effects;      // the set with its effects less the same without them, both without noise
  Change after_retuning;  // what of it is left after KnownSet::find_change_after_retuning()
};

/// Checked   tests/validation/generator/changes_test.cpp
/// Errors    InputError: a place in no channel or run of the case
std::vector<ChangeAt> find_changes(const SetOrder& order, const std::vector<Place>& places);

}  // namespace rollrig::generator
