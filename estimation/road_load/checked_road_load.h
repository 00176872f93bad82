#pragma once
/// A road load from runs that were looked at first: repeats, labels, odd runs.

#include <set>
#include <vector>

#include "estimation/road_load/coastdown_file.h"
#include "estimation/road_load/road_load_fit.h"

namespace rollrig::estimation {

/// What speaks against runs, and the runs that the fit of the others does without.
struct CheckedCoastdowns {
  std::vector<RunDoubt> doubts;
  std::set<std::size_t> set_aside;  // indices in the data, as they are after the check
};

/// Takes repeats out of the data, holds labels, times and distances against each other, and looks for odd runs.
CheckedCoastdowns check_coastdowns(CoastdownData& data, const RoadLoadFitOptions& options);

/// fit_road_load() of a file, with what speaks against its runs. Repeats are taken out of `file`. Runs that are doubted
/// stay in the fit; `others` is the fit without them. Where the runs have no fit together, the result is that of the
/// others.
/// Errors    those of fit_road_load(); a RunFailure names the run that may be its cause
/// Checked   tests/estimation/checked_road_load_test.cpp, tests/estimation/planted_mistakes_test.cpp
RoadLoadFit fit_checked_road_load(CoastdownFile& file, const RoadLoadFitOptions& options);

}  // namespace rollrig::estimation
