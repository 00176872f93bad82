#pragma once
/// A speed trace, condensed to times at which nominal speeds are passed.

#include <limits>
#include <optional>
#include <vector>

#include "estimation/road_load/coastdown_file.h"

namespace rollrig::estimation {

/// Deceleration and its first two derivatives by speed, at one speed.
struct DecelerationCurve {
  double value_m_s2 = 0.0;
  double slope_per_s = 0.0;
  double bend_per_m = 0.0;
};

/// Neighboring samples of a trace, as what their mean needs.
struct SpeedCell {
  double nominal_speed_m_s = 0.0;  // exact: no sample enters it
  double high_m_s = 0.0;           // where it begins and ends
  double low_m_s = 0.0;
  int samples = 0;
  double length_s = 0.0;
  double mean_time_s = 0.0;
  double mean_speed_m_s = 0.0;
  double time_moment_2_s2 = 0.0;  // central moments of the sample times
  double time_moment_3_s3 = 0.0;
  double scatter_m2_s2 = 0.0;  // sum of squares about a line over time
  std::size_t first_sample = 0;
  std::size_t end_sample = 0;
};

struct CellOptions {
  double width_m_s = 5.0 / 3.6;  // Assumed: 5 km/h
  double low_m_s = 0.0;
  double high_m_s = std::numeric_limits<double>::infinity();
};

/// The coasting part of a trace, cut into cells between fixed speeds: from the highest speed to where it
/// falls below the lowest or rises again. Every sample is in one cell at most. Too short a trace gives none.
/// Checked   tests/estimation/coastdown_points_test.cpp
std::vector<SpeedCell> cut_into_cells(const CoastdownRun& run, const CellOptions& options);

/// A passing of a speed, for which a trace may have too few samples.
struct SpeedPassing {
  double speed_m_s = 0.0;
  std::optional<double> time_s;
};

/// Times at which a trace falls below speeds: by a parabola over time through the samples within 2.5 km/h of each.
/// Where these are fewer than five, the nearest five samples within 10 km/h; four of them at least, else no time.
/// Speeds that the coasting part of the trace does not pass are left out.
/// Source    Assumed: window and numbers. The third power of time adds 0.01 m/s at the ends of 10 s
/// Checked   tests/estimation/coastdown_points_test.cpp
std::vector<SpeedPassing> find_passing_times(const CoastdownRun& run, const std::vector<double>& speeds_m_s);

/// Time at which the vehicle passes the nominal speed of a cell.
/// Equation  mean(v_i) = mean(u - a s + a a' s^2/2 - (a a'^2 + a^2 a'') s^3/6),  s = t_i - t
/// Symbols   u nominal speed [m/s], a deceleration at u [m/s2], a', a'' its derivatives by speed; t wanted [s]
/// Validity  a > 0; error of the fourth order of the cell's length
/// Checked   tests/estimation/coastdown_points_test.cpp
double calc_passing_time_s(const SpeedCell& cell, const DecelerationCurve& deceleration);

}  // namespace rollrig::estimation
