#pragma once
/// Checks of a measurement set before and beside the comparison: what cannot be diagnosed, what is doubtful, what
/// cannot be true.

#include <cstddef>
#include <string>
#include <vector>

#include "diagnosis/checks/stuck_sensors.h"
#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

struct SetChecks {
  std::vector<std::string> warnings;   // a sentence each
  std::vector<DoubtfulRows> left_out;  // rows of stuck sensors and samples that stand alone
  std::string suspicion;               // why columns, units or files cannot be what they are said to be; else empty
  std::string doubt;                   // the suspicion and what a diagnosis makes of it; one of the warnings, or empty

  /// Whether no cause is to be named.
  bool is_implausible() const { return !doubt.empty(); }
};

/// Samples of its best measured channel below which a run is warned of: only an effect far beyond its usual size would
/// show in fewer.
constexpr std::size_t kFewSamples = 30;  // Assumed: half a minute at 1 Hz; any phase of a test has more

/// Looks at a set before it is diagnosed.
///
/// Warns of runs and channels without samples (find_missing_samples), runs of fewer than kFewSamples, rows far apart,
/// one run alone, the same samples in two runs, and what tire_checks.h says. Marks rows of stuck sensors
/// (stuck_sensors.h) and samples that stand alone (measurements/spikes.h, 20 standard deviations). Marks a set
/// implausible when one mistake with columns or units, undone, takes nine tenths of what is odd in it (repairs.h), or
/// when a channel of a run lies far outside what uncertain parameters and effects of the catalog can make
/// (plausibility.h).
/// Validity  a wrong tire of the same class is warned of at most: its loss lies within what an effect can make
/// Errors    InputError: nothing measured; a sensor without any noise; every sensor stuck;
///           a run that cannot be simulated
/// Checked   tests/diagnosis/set_checks_test.cpp
SetChecks check_set(const measurements::MeasurementSet& set, int threads = 0);

/// What was not measured, a sentence each: runs without any sample, channels without one in a run, channels that the
/// set lacks.
/// Errors    InputError: nothing was measured at all
std::vector<std::string> find_missing_samples(const measurements::MeasurementSet& set);

/// The set without the samples of those rows.
measurements::MeasurementSet leave_out(measurements::MeasurementSet set, const std::vector<DoubtfulRows>& rows);

}  // namespace rollrig::diagnosis
