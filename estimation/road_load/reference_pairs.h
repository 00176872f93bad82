#pragma once
/// Pairs of runs in opposite headings: which runs go together, at which reference speeds, and parts of split runs.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace rollrig::estimation {

/// What one run gave at reference speeds. Runs need not have the same ones: a driver begins at 134 or at 136 km/h, and
/// a split run has a part of them.
struct ReferenceRun {
  std::string name;
  std::string session;
  int heading = 0;
  std::map<int, double> values;  // by the reference speed in km/h: a time, or a torque
  double position = 0.0;         // orders the runs of a session; of equals, the first in the file comes first
};

/// Two runs of opposite headings in a session.
struct ReferencePair {
  std::size_t plus = 0;  // runs
  std::size_t minus = 0;
  std::vector<int> speeds;  // reference speeds in km/h that both runs have, falling
  int part = 0;             // of split runs: 0 has the highest speeds
  std::string rejected;     // why; empty where it counts
  bool is_windy = false;    // whether that is the wind

  bool has(int speed) const;
};

struct PairedRuns {
  std::vector<ReferencePair> pairs;  // part by part, in each in the order of the runs
  std::vector<std::size_t> alone;    // runs without a partner
};

/// Pairs the runs that go together, session by session: in their order, no pair across another one, as many as
/// possible, and partners as near in the order as possible. So runs in turn are paired with their neighbors, also where
/// one is missing, and the n-th of one heading with the n-th of the other where one heading was driven after the other.
/// Runs without a heading or without a reference speed are not looked at.
///
/// Two runs go together if more than two thirds of the reference speeds of the one that has fewer are in both: the ends
/// of runs scatter, and a run may begin late, but the parts of a split test have little in common. The pairs fall into
/// parts by the same rule.
/// Source    UN GTR 15 Annex 4, 4.3.1.3 (opposite headings in turn; split runs with a speed in common).
///           Assumed: two thirds
/// Checked   tests/estimation/reference_speeds_test.cpp
PairedRuns pair_runs(const std::vector<ReferenceRun>& runs);

}  // namespace rollrig::estimation
