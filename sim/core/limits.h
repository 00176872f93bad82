#pragma once
/// Comparisons of a computed number with a limit that it may reach.

#include <cmath>

namespace rollrig {

/// What a number may lack of a limit, relative to the limit. Assumed: far above rounding errors of binary numbers, by
/// which 9.3 - 6.3 is not 3, and far below what any limit means.
inline constexpr double kLimitTolerance = 1e-9;

inline bool is_at_least(double value, double limit) { return value >= limit - kLimitTolerance * std::abs(limit); }
inline bool is_at_most(double value, double limit) { return value <= limit + kLimitTolerance * std::abs(limit); }

/// The number rounded up to a whole one, unless it is above one by no more than the tolerance.
inline double round_up(double value) { return std::ceil(value - kLimitTolerance * std::abs(value)); }

}  // namespace rollrig
