#pragma once
/// What speaks against runs of a set of coastdowns.

#include <set>
#include <vector>

#include "estimation/drum_deceleration/drum_coastdown.h"

namespace rollrig::estimation {

/// Takes out what repeats another run, and says what: of two recordings that are alike, the first stays; of recordings
/// that share a part, the part stays in the first.
/// Checked   tests/estimation/coast_doubts_test.cpp
std::vector<RunDoubt> leave_out_repeated_coasts(const CoastSet& set, std::vector<CoastAnalysis>& analyses);

struct CoastDoubts {
  std::vector<RunDoubt> doubts;
  std::set<std::size_t> set_aside;  // runs of the set that the results of the others do without
};

/// Compares the runs with each other.
/// * State: a run whose deceleration is that of the other state, at less than half of the distance from its own.
/// * Load: different loads at one pressure are different levels.
/// * Exchanged pressures: two runs that make runs at one pressure repeat four times as well if exchanged.
/// * Odd runs: find_odd_run() on decelerations in bins of 2 m/s. A lifted run, and a loaded run at a pressure with
/// three
///   runs or more, is compared with the median of the others. Of two runs at a pressure, the odd one is the one that is
///   farther from what the other pressures say; where that does not tell, both are named.
/// * Lifted wheel: find_odd_run() on the logarithms of the mean decelerations of the wheel over the speeds that all of
///   its runs pass, each beside the median of the others, or of two beside each other; then both are named.
/// Validity  fewer than half of the runs of a state are wrong
/// Source    Assumed: limits
/// Checked   tests/estimation/coast_doubts_test.cpp, tests/estimation/planted_mistakes_test.cpp
CoastDoubts check_coasts(const CoastSet& set, const std::vector<CoastAnalysis>& analyses);

}  // namespace rollrig::estimation
