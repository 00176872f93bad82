#pragma once
/// How the sessions of coastdowns differ.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "estimation/road_load/coastdown_file.h"

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

/// Returns nothing if fewer than two sessions have all headings that there are, or if nothing shows the scatter of
/// runs. A slope or a wind that shifts the headings apart does not count, however many runs each heading has.
/// Equation  F = (sum_s w_s (g_s - g)^2/(k - 1)) / s^2, F distribution with k - 1 and nu degrees of freedom;
///           g_s = mean over h of g_sh; 1/w_s = sum_h 1/n_sh / H^2; g = sum w_s g_s / sum w_s;
///           s^2 = sum_r (g_r - g_sh)^2/nu, nu = n - c, or, where that has more degrees of freedom,
///           s^2 = sum_sh (g_sh - g_s - g_h + mean g_sh)^2/nu, nu = (k - 1)(H - 1), g_h mean over s of g_sh
///           (not where winds are fitted, which take up what the headings of a session differ by);
///           relative_sd^2 = sum_s (g_s - mean g_s)^2/(k - 1)
/// Symbols   g_r mean of (force - fit)/L of run r, here `deviations`; L road load without wind and slope; g_sh mean of
///           the n_sh runs of session s with heading h; H headings; k sessions that have all headings; c pairs of session
///           and heading and n runs of all sessions
/// Source    analysis of variance of unweighted means
/// Validity  the second estimate of s^2 also contains the winds of the sessions
/// Checked   tests/estimation/session_differences_test.cpp
std::optional<SessionDifference> compare_sessions(const CoastdownData& data,
                                                  const std::map<std::size_t, double>& deviations, SessionWinds winds);

/// The sessions that lack a heading that another one has: compare_sessions() leaves them out.
std::vector<std::string> list_partial_sessions(const CoastdownData& data,
                                               const std::map<std::size_t, double>& deviations);

/// A warning if the p value of compare_sessions() is below 0.01 and the standard deviation is at least 0.1 %.
std::optional<std::string> doubt_session_difference(const CoastdownData& data,
                                                    const std::map<std::size_t, double>& deviations,
                                                    SessionWinds winds);

}  // namespace rollrig::estimation
