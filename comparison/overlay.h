#pragma once
/// Recordings over one time.

#include <string>
#include <vector>

#include "comparison/compared.h"

namespace rollrig::comparison {

/// A recording to be laid over others.
struct OverlaidRun {
  std::vector<double> time_s;
  std::vector<std::size_t> phase;                                     // of each row
  std::vector<OverlayPhase> phases;                                   // in order, with its own times
  std::vector<std::pair<std::string, std::vector<double>>> channels;  // heading, values in its unit
};

/// Lays runs over each other: of every channel that all have a line each.
///
/// If all have the same phases in the same order, each phase begins at one time for all and lasts as long as the
/// longest: a shorter one ends in a gap. Otherwise all begin with the first phase that all have, and keep their times;
/// then `warnings` gets a sentence.
/// Checked  tests/comparison/overlay_test.cpp
Overlay overlay_runs(const std::vector<OverlaidRun>& runs, const std::vector<std::string>& names,
                     const std::string& title, std::vector<std::string>& warnings);

}  // namespace rollrig::comparison
