#pragma once
/// Coastdowns that are in a file twice, in whole or in part.

#include <string>
#include <vector>

#include "estimation/road_load/coastdown_file.h"
#include "estimation/run_checks/run_doubt.h"

namespace rollrig::estimation {

/// A run as messages call it: "run '7'", with its session where the data have several.
std::string call_run(const CoastdownData& data, std::size_t run);

/// Takes out of the data what repeats another run, and says what. Of two runs that are alike, the first stays; of a run
/// that is a part of another, the longer one; of runs that share a part, the part stays in the first.
/// Equation  times through bins: neighboring bins repeat where N product(p) < 0.01, N = pairs of runs times bins of the
///           run, p = chance that two runs agree to the resolution in one bin, by the scatter of the runs in it;
///           traces: find_series_repeats()
/// Checked   tests/estimation/planted_mistakes_test.cpp
std::vector<RunDoubt> leave_out_repeats(CoastdownData& data);

}  // namespace rollrig::estimation
