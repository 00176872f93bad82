#pragma once
/// Scatter within groups.

#include <vector>

namespace rollrig::estimation {

/// Sum of the squares of values about the means of their groups.
struct PooledScatter {
  double squares = 0.0;
  double degrees_of_freedom = 0.0;

  void add_group(const std::vector<double>& values);

  /// Of single values; needs a degree of freedom.
  double variance() const { return squares / degrees_of_freedom; }
};

}  // namespace rollrig::estimation
