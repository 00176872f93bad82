#pragma once
/// Sessions of coastdowns whose headings look exchanged.

#include <optional>
#include <string>
#include <vector>

#include "estimation/road_load/recorded_wind.h"

namespace rollrig::estimation {

/// The slope of a road is the same in all sessions; where some show it with the opposite sign and about the same size,
/// their headings may be exchanged. Absent where the slope was recorded: doubt_slopes() compares it then.
/// Equation  s = (mean of h a/(m g) over the runs of the + heading + that over the - heading)/2, session by session;
///           counts where |s| > 0.001 and |s| > t r sqrt(1/n_+ + 1/n_-)/2
/// Symbols   h a/(m g) slope that a run shows, list_shown_slopes(); n_+, n_- runs of the headings; r their standard
///           deviation within session and heading, over all sessions; t of Student with a probability of 0.005
/// Validity  a session with both headings, one of them repeated; both signs with means that are within a factor of two
/// Assumed: limits
/// Checked   tests/estimation/session_headings_test.cpp
std::optional<std::string> doubt_session_headings(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                                  double mass_kg);

}  // namespace rollrig::estimation
