#pragma once
/// What can be said of a set's samples before any of them is simulated.

#include "diagnosis/checks/set_checks.h"

namespace rollrig::diagnosis {

/// Samples of its best measured channel below which a run is warned of: only an effect far beyond its usual size would
/// show in fewer.
constexpr std::size_t kFewSamples = 30;  // Assumed: half a minute at 1 Hz; any phase of a test has more

/// Warns of runs and channels without samples (find_missing_samples), of a force that never settles, runs of fewer than
/// kFewSamples, one run alone, the same samples in two runs, and rows far apart. Leaves out samples that stand alone:
/// spikes (measurements/spikes.h, 20 standard deviations), and what a logger writes where it has no sample.
/// Errors  InputError: nothing was measured at all
/// Checked tests/diagnosis/set_checks_test.cpp, tests/diagnosis/left_out_samples_test.cpp
void check_samples(const measurements::MeasurementSet& set, SetChecks& checks);

/// What was not measured, a sentence each: runs without any sample, channels without one in a run, channels that the
/// set lacks.
/// Errors    InputError: nothing was measured at all
std::vector<std::string> find_missing_samples(const measurements::MeasurementSet& set);

}  // namespace rollrig::diagnosis
