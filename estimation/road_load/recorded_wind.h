#pragma once
/// Wind and slope as they were recorded, held against what the runs of both headings show of them.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "estimation/road_load/coastdown_file.h"

namespace rollrig::estimation {

/// Resistance of one run over speed, as tested. The wind is in it; the slope is, unless SlopeForce says otherwise.
struct RunResistance {
  std::size_t run = 0;  // in the data
  std::vector<double> speed_m_s;
  std::vector<double> force_N;
};

/// A quantity along the road in one run, positive against (or uphill in) the + heading: recorded, and as something else
/// shows it.
struct RecordedAndShown {
  int heading = 0;
  std::string session;
  double recorded = 0.0;
  double shown = 0.0;
};

/// The wind of each run with a recorded one, and the one that its force shows.
/// Equation  w = h b/(2 C), b slope over speed of the run's force less A + B v + C v^2 of all runs
/// Symbols   h heading; C drag per square of speed [N s2/m2]
/// Validity  means over both headings alone: what b has besides wind is taken to be the same in both
/// Checked   tests/estimation/recorded_wind_test.cpp
std::vector<RecordedAndShown> list_winds_by_force(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                                  double drag_N_s2_per_m2);

/// The slope of the road that the force of a run shows, positive uphill in the + heading.
struct ShownSlope {
  std::size_t run = 0;  // in the data
  double slope = 0.0;
};

/// Equation  h a/(m g), a force of the run less A + B v + C v^2 of all runs, at standstill by a line over speed
/// Symbols   h heading; m mass [kg]
/// Validity  means over both headings alone, and runs of four speeds at least; others have none
std::vector<ShownSlope> list_shown_slopes(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                          double mass_kg);

bool has_recorded_slopes(const CoastdownData& data);

/// Whether the forces of runs contain that of the recorded slope.
enum class SlopeForce { kIncluded, kSubtracted };

/// The slope of each run with a recorded one, and the one that its force shows. If the force of the recorded slope was
/// subtracted, the recorded slope is added to what the force shows.
std::vector<RecordedAndShown> list_slopes_by_force(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                                   double mass_kg, SlopeForce slope_force);

/// What contradicts the recorded winds, session by session: "the headings show 2.0 m/s, wind_m_s has -1.9 m/s: ...".
/// `shown_by` is the subject, such as "the headings show"; `column` that of the records.
/// Equation  difference D of the means over both headings; doubted where |D| > 0.5 m/s, |D| > 0.5 |w| of what was
///           recorded, and |D| > t s, t of Student with a probability of 0.005, s by the scatter within the headings.
///           0.1 m/s in place of 0.5 where the records are opposite in the headings, as a headwind is
/// Source    Assumed: limits
/// Checked   tests/estimation/recorded_wind_test.cpp
std::vector<std::string> doubt_winds(const std::vector<RecordedAndShown>& runs, const std::string& shown_by,
                                     const std::string& column);
/// The same of slopes, with 0.002 in place of 0.5 m/s and 0.0002 in place of 0.1 m/s.
std::vector<std::string> doubt_slopes(const std::vector<RecordedAndShown>& runs);

/// By how much what is shown differs from the records in the first session in which it is more than `least`, more than
/// half of the records and, by the rule of doubt_winds(), more than the scatter explains; absent where it is not.
std::optional<double> find_contradiction(const std::vector<RecordedAndShown>& runs, double least);

}  // namespace rollrig::estimation
