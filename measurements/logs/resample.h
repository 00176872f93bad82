#pragma once
/// Logs brought to the rows of a measurement set.

#include <string>
#include <vector>

#include "measurements/logs/clock.h"

namespace rollrig::measurements {

/// Neighboring rows of a set that lack a value, or were left out for want of an input.
struct EmptyRange {
  Quantity column;
  double from_s = 0.0;  // time of the set
  double to_s = 0.0;
  std::size_t rows = 0;
  bool rows_left_out = false;
  std::string reason;
};

struct ResampledRun {
  double start_s = 0.0;                      // of the set's time, on the torque log's clock
  std::vector<double> time_s;                // from there
  QuantityMap<std::vector<double>> columns;  // SI; NaN: no value
  std::vector<EmptyRange> empty;
  QuantityMap<std::size_t> rows_between;  // of a log slower than the rows: empty, in no range
  QuantityMap<double> samples_a_row;      // of measured columns
};

/// What a run is made of: the torque log, and a tire log whose times are already on the torque log's clock.
struct RunSources {
  const Log* torque_log = nullptr;
  const Log* tire_log = nullptr;  // or none
};

/// Rows every `interval_s` from `from_s` to `to_s` of the torque log's clock.
///
/// Given columns: linear between samples; the load is the last one. Measured columns: the mean over half-way to the row
/// before to half-way to the next, each sample standing for its share of the log; from a log slower than the rows,
/// each sample in the row next to it. A row whose interval is not covered by values is left empty, a row without an
/// input is left out.
/// Errors   InputError: inputs missing for longer than the mapping allows; fewer than three rows
/// Source   formats.md: given columns run linearly from row to row, measured ones are means, load holds
/// Checked  tests/measurements/logs/resample_test.cpp
ResampledRun resample_run(const Mapping& mapping, const RunSources& sources, double interval_s, double from_s,
                          double to_s);

}  // namespace rollrig::measurements
