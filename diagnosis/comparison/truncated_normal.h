#pragma once
/// A normal distribution that is cut off at limits.

namespace rollrig::diagnosis {

struct TruncatedNormal {
  double mean = 0.0;  // of the normal distribution before it is cut, as is `sd`
  double sd = 1.0;
  double lower = 0.0;  // may be infinite, as may `upper`
  double upper = 0.0;
};

/// Logarithm of the probability that the normal distribution has between the limits. Precise far out in its tails.
/// Checked tests/diagnosis/truncated_normal_test.cpp
double calc_log_mass(const TruncatedNormal& distribution);

/// Where a truncated normal distribution lies.
struct TruncatedSpread {
  double sd = 0.0;
  double low_95 = 0.0;  // the shortest interval of 95 %
  double high_95 = 0.0;
};

/// The shortest interval contains the most likely value. It ends at a limit where the distribution is cut there.
/// Equation  variance = s^2 (1 + (a phi(a) - b phi(b))/Z - ((phi(a) - phi(b))/Z)^2), Z = Phi(b) - Phi(a)
/// Symbols   a, b limits less the mean, divided by s; phi, Phi density and distribution function of the standard normal
/// Source    the moments of a truncated normal distribution
/// Checked   tests/diagnosis/truncated_normal_test.cpp
TruncatedSpread find_spread(const TruncatedNormal& distribution);

}  // namespace rollrig::diagnosis
