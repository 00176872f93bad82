#pragma once
/// Statistics of a score: shares with their intervals, and how far stated probabilities can be relied on.

#include <array>
#include <cstddef>
#include <vector>

namespace rollrig::validation {

struct Interval {
  double low = 0.0;
  double high = 1.0;
};

/// Interval of 95 % of a share, Wilson's score interval.
/// Equation  (p + z^2/2n -+ z sqrt(p (1 - p)/n + z^2/4n^2)) / (1 + z^2/n), p = k/n
/// Symbols   k cases of n, z 1.959964
/// Validity  0 <= k <= n; of no cases the whole of 0 to 1
/// Source    E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209
/// Checked   tests/validation/scoring/statistics_test.cpp
Interval calc_wilson_95(std::size_t k, std::size_t n);

/// A probability that was stated, and whether what it was stated of came true.
struct Stated {
  double probability = 0.0;
  bool right = false;
};

constexpr std::size_t kReliabilityBins = 10;

/// Of probabilities from one tenth to the next. One that lies on a border counts above, 1 in the last.
struct ReliabilityBin {
  std::size_t cases = 0;
  std::size_t right = 0;
  double mean_probability = 0.0;  // of its cases

  void add(const Stated& one);
  double right_share() const { return static_cast<double>(right) / static_cast<double>(cases); }
};
using Reliability = std::array<ReliabilityBin, kReliabilityBins>;
Reliability find_reliability(const std::vector<Stated>& stated);

/// Expected calibration error.
/// Equation  sum over bins of n_b/n |share right in b - mean probability in b|
/// Source    Naeini, Cooper, Hauskrecht, AAAI 2015
/// Checked   tests/validation/scoring/statistics_test.cpp
double calc_ece(const Reliability& reliability);

/// ECE that a forecaster has on average whose probabilities are right, of so many cases: what is below it says nothing.
/// Equation  mean over draws of calc_ece, each outcome right with the probability that was stated
/// Validity  400 draws: the mean is known to a few percent; the same seed each time
/// Checked   tests/validation/scoring/statistics_test.cpp
double calc_ece_noise_floor(const std::vector<Stated>& stated);

/// Brier score of the stated probabilities.
/// Equation  mean of (p - o)^2, o = 1 where right, else 0
/// Source    G. W. Brier, Mon. Weather Rev. 78 (1950) 1, for one event
/// Checked   tests/validation/scoring/statistics_test.cpp
double calc_brier(const std::vector<Stated>& stated);

/// Quantile with straight lines between the order statistics, `share` from 0 to 1; of at least one value.
/// Checked   tests/validation/scoring/statistics_test.cpp
double calc_quantile(std::vector<double> values, double share);

}  // namespace rollrig::validation
