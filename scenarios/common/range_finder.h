#pragma once
/// Finds where a test measured and where it skimmed, from the load signal alone (source B.2).

#include <vector>

namespace rollrig::scenarios {

/// A stretch of constant load and speed.
struct LoadRange {
  bool loaded = false;  // else at skim load
  double load_N = 0.0;
  double start_s = 0.0;
  double end_s = 0.0;

  double duration_s() const { return end_s - start_s; }
};

/// Part of a range that is averaged.
struct Window {
  double start_s = 0.0;
  double end_s = 0.0;
};

/// Splits a load signal at each change by more than 1 % or across the skim limit, and where the speed
/// leaves that of the range's start by more than 1 %. A row's load holds until the next row. Ranges
/// shorter than `shortest_s` are left out.
/// Symbols   `skim_limit_N` load at or below which the tire counts as skimming (formats.md: 1.5 times
///           the rig's skim load)
std::vector<LoadRange> find_load_ranges(const std::vector<double>& time_s, const std::vector<double>& load_N,
                                        const std::vector<double>& speed_m_s, double skim_limit_N, double shortest_s);

/// The last `window_s` of a range, `margin_s` before its end; shorter when the range, less both margins,
/// is shorter. An empty window (end <= start) when nothing is left.
Window find_last_window(const LoadRange& range, double window_s, double margin_s);

/// Mean of samples whose whole averaging interval lies in the window; NaN samples are left out. Throws
/// RunFailure where there is none.
double calc_window_mean(const std::vector<double>& time_s, const std::vector<double>& values, const Window& window,
                        double interval_s);

/// How many samples calc_window_mean averages.
int count_window_samples(const std::vector<double>& time_s, const std::vector<double>& values, const Window& window,
                         double interval_s);

}  // namespace rollrig::scenarios
