#pragma once
/// Whether a run can be what its set says it is: a coarse comparison with the baseline, before any diagnosis.

#include <optional>
#include <string>
#include <vector>

#include "measurements/measurement_set.h"
#include "sim/recording.h"

namespace rollrig::diagnosis {

/// A run with the inputs that it recorded, simulated with tire and machine as the files give them, no effect on.
/// Throws RunFailure.
sim::Recording<double> resimulate_baseline(const measurements::MeasurementSet& set,
                                           const measurements::MeasuredRun& run);

/// Rows of a channel that are compared, as the set's kind has it; none where the run does not have the channel.
std::vector<std::size_t> find_compared_rows(const measurements::MeasurementSet& set,
                                            const measurements::MeasuredRun& run, const Quantity& channel);

/// How far a second reading of an input, by a scale or a counter, may lie from the input: fixed and in proportion.
struct ReferenceTolerance {
  double fixed_SI = 0.0;
  double share = 0.0;
};
/// None for a channel that is no such reading.
/// Source  Assumed: the largest errors of load and speed in the priors of the catalog, straps of a vehicle among them
std::optional<ReferenceTolerance> find_reference_tolerance(const Quantity& channel);

struct ChannelMisfit {
  Quantity channel;
  std::size_t samples = 0;
  double rms = 0.0;    // of the difference in tolerances, each at most kLargestMisfit, less the sensor's noise
  double ratio = 1.0;  // mean measured over mean simulated, in the unit of the file
};

constexpr double kLargestMisfit = 10.0;

/// How far a run lies from its simulation, in units of what uncertain parameters and effects of the
/// catalog can make.
/// Equation  u = (y - h)/tolerance; tolerance of a force as the set's kind has it (of a drum's torque
///           20 N R + 0.3 |h|), of a temperature 5 K + 0.4 |h - T_amb|, of a pressure 15 kPa + 0.4 |h - p_cold|, of a
///           second reading of load or speed as find_reference_tolerance() has it. rms^2 = mean of u^2 less that of
///           (s/tolerance)^2, and not below 0
/// Symbols   y measured, h simulated, R drum radius [m], s noise and drift of one sample
/// Validity  A channel that has samples but none that can be compared counts as just outside (1.05): its speed column
///           may be wrong.
/// Source    Assumed: an effect at the upper end of its prior, with the pressure record off by 15 kPa and the air
///           at the tire by 6 K, stays below 1; of draws from the priors at most 1 in 100 is above 2
/// Checked   tests/diagnosis/set_checks_test.cpp, tests/diagnosis/wrong_columns_test.cpp
struct RunMisfit {
  std::vector<ChannelMisfit> channels;
  std::string failure;  // why the run could not be simulated; else empty

  double worst() const;
  double sum_of_squares() const;
};
RunMisfit calc_misfit(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                      const sim::Recording<double>& simulated);
/// The same in these rows of each channel, as far as they have samples, whatever the speed.
RunMisfit calc_misfit(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                      const sim::Recording<double>& simulated, const QuantityMap<std::vector<std::size_t>>& rows);
/// The same with a resimulation of its own; a run that cannot be simulated has the largest misfit.
RunMisfit calc_misfit(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run);

/// Every run of a set as the baseline has it.
struct BaselineRuns {
  std::vector<sim::Recording<double>> recordings;  // empty where a run cannot be simulated
  std::vector<RunMisfit> misfits;
};
BaselineRuns resimulate_baseline(const measurements::MeasurementSet& set, int threads);

/// "run a", "runs a, b" in the order of their names, or "all runs", for messages.
std::string name_runs(const measurements::MeasurementSet& set, const std::vector<std::size_t>& runs);

}  // namespace rollrig::diagnosis
