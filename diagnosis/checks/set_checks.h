#pragma once
/// Checks of a measurement set before and beside the comparison: what cannot be diagnosed, what is doubtful, what
/// cannot be true.

#include <string>
#include <vector>

#include "diagnosis/checks/stuck_sensors.h"
#include "include/rollrig/progress.h"
#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

struct SetChecks {
  std::vector<std::string> warnings;   // a sentence each
  std::vector<DoubtfulRows> left_out;  // rows of stuck sensors and samples that stand alone
  std::string suspicion;               // why columns, units or files cannot be what they are said to be; else empty
  std::string doubt;                   // the suspicion and what a diagnosis makes of it; one of the warnings, or empty
  std::vector<std::size_t> mistaken_runs;  // those of the suspicion, where it is of some runs

  /// Whether no cause is to be named.
  bool is_implausible() const { return !doubt.empty(); }
};

/// Looks at a set before it is diagnosed.
///
/// Warns of what samples tell by themselves (sample_checks.h) and of what tire_checks.h says. Marks rows of stuck
/// sensors (stuck_sensors.h) and samples that stand alone. Marks a set implausible if a run has a mistake with columns
/// or units with a probability of at least 90 % (mistakes.h), if an input is constant that should vary
/// (still_inputs.h), or if a channel of a run lies far outside what uncertain parameters and effects of the catalog can
/// make (plausibility.h).
/// Validity  a wrong tire of the same class is warned of at most: its loss lies within what an effect can make
/// Errors    InputError: nothing measured; a sensor without noise, or with less than any has (find_least_noise); every
///           sensor stuck; a run that cannot be simulated
/// Checked   tests/diagnosis/set_checks_test.cpp
SetChecks check_set(const measurements::MeasurementSet& set, int threads = 0, const Progress& progress = {});

/// The set without the samples of those rows.
measurements::MeasurementSet leave_out(measurements::MeasurementSet set, const std::vector<DoubtfulRows>& rows);

}  // namespace rollrig::diagnosis
