#pragma once
/// Sessions of coastdowns whose headings look exchanged.

#include <optional>
#include <string>
#include <vector>

#include "estimation/road_load/recorded_wind.h"

namespace rollrig::estimation {

/// The slope of a road is the same in all sessions. If some sessions show it with the opposite sign and about the same
/// size, their headings may be exchanged. For forces that contain that of the slope; where slopes were recorded,
/// doubt_slopes() tells more.
/// Equation  s = (mean of h a/(m g) over the runs of the + heading + that over the - heading)/2, session by session;
///           counts if |s| > 0.001 and |s| > t r sqrt(1/n_+ + 1/n_-)/2
/// Symbols   h a/(m g) slope that a run shows, list_shown_slopes(); n_+, n_- numbers of runs of the headings; r standard
///           deviation of these slopes within session and heading, pooled over all sessions; t two-sided quantile of
///           Student's distribution
/// Validity  sessions with both headings, and a heading that is repeated in one session at least
/// Assumed: slopes below 0.001 do not count, t at p = 0.005, the means of both signs are within a factor of 2
/// Checked   tests/estimation/session_headings_test.cpp
std::optional<std::string> doubt_session_headings(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                                  double mass_kg);

}  // namespace rollrig::estimation
