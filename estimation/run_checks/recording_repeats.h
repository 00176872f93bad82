#pragma once
/// Recordings that are there twice, in whole or in part.

#include <cstddef>
#include <string>
#include <vector>

namespace rollrig::estimation {

/// A speed over time as it was recorded.
struct RecordedSeries {
  std::vector<double> time_s;  // increasing
  std::vector<double> speed_m_s;
};

/// Rows [begin, end) of the second series are those of a part of the first.
struct SeriesRepeat {
  std::size_t first = 0;
  std::size_t second = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The step in which values were written: the coarsest of 1, 0.5, 0.2, 0.1 ... of one of the units that all of them are
/// multiples of.
double find_resolution(const std::vector<double>& values, const std::vector<double>& units);

/// The largest repeat of each pair of series. The second may be shifted in time, written in other units, or rounded.
/// Equation  a stretch is a repeat where n p^k < 0.001, n = rows of the one times rows of the other, p = chance that
/// two
///           recordings with noise agree to the resolution in one row; without noise, where all of it agrees. The speed
///           falls by a tenth of the top at least: shorter stretches may be alike by the steps of a clock
/// Symbols   k rows that agree
/// Source    Assumed: limits
/// Checked   tests/estimation/recording_repeats_test.cpp
std::vector<SeriesRepeat> find_series_repeats(const std::vector<RecordedSeries>& series);

}  // namespace rollrig::estimation
