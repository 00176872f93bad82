#pragma once
/// Rows of a run merged where the machine holds still, so that a run of many hours takes few rows to simulate.

#include <cstddef>
#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::measurements {

/// A run with fewer rows, and what became of each row of the original.
struct MergedRun {
  MeasuredRun run;                  // a merged row has the mean time and the mean values of its rows; NaN: none had any
  std::vector<std::size_t> row_of;  // of each row of the original: the merged row that holds it
};

/// Merges neighboring rows of a tire on a drum or a belt, where speed, load and every other given column keep their
/// values but for temperatures. The 2 min after a change and the 10 s before the next one are left as they are, and so
/// are all rows of other specimens: the rows of a driving vehicle change all the time.
///
/// Length    of merged rows: 10 s, and a tenth of the time since the last change where that is more, but never above
///           `longest_s`: what has not settled by then bends with a time constant of that time or more
/// Cuts      rows at which a merged row has to begin
/// Checked   tests/measurements/merged_rows_test.cpp
MergedRun merge_steady_rows(const MeasuredRun& run, const MachineKind& kind, std::vector<std::size_t> cuts,
                            double longest_s);

}  // namespace rollrig::measurements
