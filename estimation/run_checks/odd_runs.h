#pragma once
/// The run that does not agree with the others.

#include <cstddef>
#include <optional>
#include <vector>

namespace rollrig::estimation {

/// How far the force of one run lies from what the other runs say, by speed.
struct RunDeviation {
  std::size_t run = 0;
  std::size_t group = 0;          // runs of a group scatter alike: those of a session, or of a state
  std::vector<double> speed_m_s;  // falling
  std::vector<double> relative;   // force over that of the others, less 1
};

/// What is known of the scatter before the runs are looked at.
struct ScatterPrior {
  double run_sd = 0.02;    // from run to run, relative. Assumed
  double freedom = 6.0;    // what this counts, in degrees of freedom. Assumed
  double alarms = 0.005;   // chance of an alarm in a set without an odd run. Assumed
  std::size_t fewest = 3;  // runs of a group that are looked at
};

/// A stretch of a run that deviates more than scatter explains.
struct OddRun {
  std::size_t run = 0;
  double relative = 0.0;  // mean over the stretch
  double high_m_s = 0.0;  // ends of the stretch
  double low_m_s = 0.0;
  bool is_whole = false;  // the stretch is the run
  double sds = 0.0;       // deviation over its standard deviation
};

/// The run with the largest deviation over any stretch, if it is beyond what chance makes.
/// Equation  z = mean(e)/sqrt(s_r^2 + s_s^2 x^2 + s_b^2/n) over every stretch of n > 1 neighboring values of each run;
/// the
///           limit is Student's quantile at `alarms` shared out among the values
/// Symbols   e relative deviation; s_r, s_s, s_b scatter of the runs' levels, of their slopes over speed, and along a
///           run, by medians over the group; x speed, -1 to 1 over the group
/// Validity  fewer than half of the runs of a group are odd
/// Checked   tests/estimation/odd_runs_test.cpp
std::optional<OddRun> find_odd_run(const std::vector<RunDeviation>& deviations, const ScatterPrior& prior = {});

}  // namespace rollrig::estimation
