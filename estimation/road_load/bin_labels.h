#pragma once
/// Speeds, times and distances of the same run, held against each other.

#include <vector>

#include "estimation/road_load/coastdown_file.h"
#include "estimation/run_checks/run_doubt.h"

namespace rollrig::estimation {

/// A doubt about the labels, times or distance of a run; `run` is its index.
struct LabelDoubt {
  std::size_t run = 0;
  RunDoubt doubt;
};

/// Runs whose speed bins contradict the times and distances of the same file.
/// Equation  sum(dt) against the total time; mean speed of the labels, sum(v dt)/sum(dt), against distance over time; a
///           start against the end of the run before. The likely mistake is the one of a list (labels in another unit,
///           shifted by whole bins, of another width; distance in another unit; a bin missing) that explains the mean
///           speed best
/// Symbols   v mean speed of a bin: the middle, corrected for the curvature of speed over time
/// Validity  a run has its total time or its distance in the file; contradictions above 1 %
/// Source    Assumed: 1 %, three times the largest difference in measured bins
/// Checked   tests/estimation/bin_labels_test.cpp
std::vector<LabelDoubt> check_bin_labels(const CoastdownData& data);

}  // namespace rollrig::estimation
