#pragma once
/// Scatter within groups.

#include <vector>

namespace rollrig::estimation {

/// Sum of squared residuals, with their degrees of freedom.
struct PooledScatter {
  double squares = 0.0;
  double degrees_of_freedom = 0.0;

  /// The residuals of values about their mean.
  void add_group(const std::vector<double>& values);

  /// Of a single value; not defined without degrees of freedom.
  double variance() const { return squares / degrees_of_freedom; }
};

}  // namespace rollrig::estimation
