#pragma once
/// Which mistakes with columns and units were made in which runs of a set, by their probability.

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/checks/plausibility.h"
#include "diagnosis/checks/repairs.h"

namespace rollrig::diagnosis {

/// A mistake of some runs, and what it may be instead.
struct FoundMistake {
  Mistake mistake;
  std::vector<std::size_t> runs;                        // in which it was made
  double probability = 0.0;                             // of the least certain of these runs
  std::vector<std::pair<std::string, double>> instead;  // other mistakes that may be meant, the likeliest first
};

/// Decides which mistakes of list_mistakes() were made, if any. A mistake, or two, are undone in each run, and the run
/// is simulated again. The hypotheses are: nothing was mistaken; one mistake in all runs; in each run nothing, one
/// mistake, or two, whatever it was in the other runs.
///
/// Equation  P(H | data) ~ P(H) sum_s P(s) sum_m P(m | s) prod_r L_r(H, s, m)
/// Symbols   L likelihood of a run (mistake_evidence.h); s size of the unknown effects, the same in all runs; m parts
///           that the runs have in common, none or as fitted to them; P(H) before the data: a mistake in all runs 3 in
///           100, in one run 1 in 100, two in one run 1 in 100 000, divided among the mistakes by weight (Assumed)
/// Validity  A run is named if it is mistaken with 90 % or more. A mistake counts only if every channel is within its
///           tolerance once it is undone (RunMisfit of at most 1). On machines that measure a loss by itself, effects
///           show far above the noise. There undoing a mistake also has to take half of the squares of the misfit, on
///           rollers of a run that lies 0.15 tolerances off; for exchanged columns, for two mistakes, and against a
///           constant coefficient nine tenths, of a run that lies 0.3 tolerances off
/// Cost      Runs within 0.1 tolerances are not tried, but on the road. Two wrong units are tried where one mistake
///           alone leaves a channel 0.3 tolerances off, on the road where one is likely
/// `tells`   whether a mistake is considered in a run
/// Checked   tests/diagnosis/planted_mistakes_test.cpp, tests/diagnosis/wrong_columns_test.cpp
std::vector<FoundMistake> find_mistakes(const measurements::MeasurementSet& set, const BaselineRuns& baseline,
                                        int threads, const std::function<bool(const Mistake&, std::size_t run)>& tells);

/// "in run a it looks as if speed_km_h holds mph (probability 97 %)", for messages. Of a mistake below 90 % that may be
/// another, it says that the set cannot tell them apart.
std::string describe(const measurements::MeasurementSet& set, const FoundMistake& found);

}  // namespace rollrig::diagnosis
