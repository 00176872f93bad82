#pragma once
/// How the sessions of coastdowns differ, and what the difference looks like.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "estimation/road_load/recorded_wind.h"

namespace rollrig::estimation {

/// How sessions differ by the mean forces of their runs.
struct SessionDifference {
  double p_value = 1.0;      // of sessions that do not differ
  double relative_sd = 0.0;  // of the sessions' mean forces, over the fitted force
  std::string farthest;      // the session that is farthest from the mean of the others; of two, the second by name
  std::string other;         // of two sessions, the first
  double relative = 0.0;     // by how much its mean force is above theirs, over the fitted force
};

/// Whether the fit that the deviations are from has a wind for each session.
enum class SessionWinds { kInDeviations, kFitted };

/// Absent where fewer than two sessions have all headings that there are, or nothing shows the scatter of runs. A slope
/// or a wind that shifts the headings apart does not count, however many runs each heading has.
/// Equation  F = (sum_s w_s (g_s - g)^2/(k - 1)) / s^2, F distribution with k - 1 and nu degrees of freedom;
///           g_s = mean over h of g_sh; 1/w_s = sum_h 1/n_sh / (headings)^2; g = sum w_s g_s / sum w_s;
///           s^2 = sum_r (g_r - g_sh)^2/nu, nu = n - c, or, where that has more degrees of freedom,
///           s^2 = sum_sh (g_sh - g_s - g_h + mean g_sh)^2/nu, nu = (k - 1)(headings - 1), g_h mean over s of g_sh
///           (not where winds are fitted, which take up what the headings of a session differ by);
///           relative_sd^2 = sum_s (g_s - mean g_s)^2/(k - 1)
/// Symbols   g_r mean of (force - fit)/fit of run r, here `deviations`; g_sh mean of the n_sh runs of session s with
///           heading h; k sessions that have all headings; c pairs of session and heading and n runs of all sessions
/// Source    analysis of variance of unweighted means
/// Validity  the second s has the wind of a session in it
/// Checked   tests/estimation/session_differences_test.cpp
std::optional<SessionDifference> compare_sessions(const CoastdownData& data,
                                                  const std::map<std::size_t, double>& deviations,
                                                  SessionWinds winds);

/// A warning where that p value is below 0.01 and the standard deviation is at least 0.1 %.
std::optional<std::string> doubt_session_difference(const CoastdownData& data,
                                                    const std::map<std::size_t, double>& deviations,
                                                    SessionWinds winds);

/// Where forces over speed come from.
struct MeasuredForce {
  bool is_from_speeds = true;  // m dv/dt
  std::string speed_columns;   // as files name them
};

MeasuredForce force_of_coastdowns(const CoastdownData& data);

/// Sessions whose forces over speed agree with those of the others if their speeds are in another unit (mph, m/s), and
/// do not agree as they stand.
/// Equation  e(v) = d F_s(v)/F_o(c v) - 1, root of its mean square over the speeds that both have; c = 1: the unit of
///           the column, c = 1.609 or 3.6: mph or m/s; where 1/c agrees instead, the others are in mph or m/s, and this
///           session in the unit of the column
/// Symbols   F_s, F_o parabolas through the forces of a session and of the others, by relative least squares; d = c
///           where the force is found from the speeds (m dv/dt), d = 1 where it is measured
/// Validity  five points and a ratio of speeds of 1.5 at least
/// Assumed: doubted where the root is above 0.1 as it stands, and below 0.05 and a third of that in the other unit
/// Checked   tests/estimation/session_differences_test.cpp
std::vector<std::string> doubt_session_units(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                             const MeasuredForce& force);

}  // namespace rollrig::estimation
