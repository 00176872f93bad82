#pragma once
/// Fewer points of a series, none of its extremes lost.

#include <cstddef>
#include <vector>

namespace rollrig::report {

/// Indices of the rows that are kept, in order; at most `most` of them (at least 8).
///
/// The first and the last row are kept. The rows between are cut into equal stretches, and of each the first, the last,
/// the least and the greatest value stay, so that every peak of the series is at its own time and a line drawn through
/// them looks as through all; a stretch with a gap (not finite) keeps one row of it. What then lies on the straight
/// line of its neighbors, to `tolerance`, is left out: a series at rest is two points.
/// Source   Jugel et al., Proc. VLDB 7 (2014) 797 (M4)
/// Checked  tests/report/thinning_test.cpp
std::vector<std::size_t> thin(const std::vector<double>& time_s, const std::vector<double>& values, std::size_t most,
                              double tolerance = 0.0);

}  // namespace rollrig::report
