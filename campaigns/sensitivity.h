#pragma once
/// How much of a result's spread comes from each factor.

#include <cstdint>
#include <string>
#include <vector>

namespace rollrig::campaigns {

/// An estimate with its interval of 95 %, from resampling of the design's points (percentile bootstrap). Resamples of
/// which no estimate can be made are left out.
struct Index {
  double value = 0.0;
  double low_95 = 0.0;
  double high_95 = 0.0;
};

/// Results of a design's items in their order; NaN where an item failed or has no such result. All items of a point
/// that lacks one are left out.
using ItemResults = std::vector<double>;

/// Sobol' indices of each factor.
struct SobolIndices {
  std::size_t points = 0;    // those that count
  double mean = 0.0;         // of the result
  double variance = 0.0;     // V
  std::vector<Index> first;  // share of the variance that the factor causes by itself
  std::vector<Index> total;  // and with all others
};

/// For a design kSobolIndices, with f(A), f(B), f(AB_j) of point n:
/// V = variance of f(A) and f(B) together; S_j = mean(f(B) (f(AB_j) - f(A))) / V, with f taken from its mean;
/// T_j = mean((f(A) - f(AB_j))^2) / (2 V).
/// Source    Saltelli et al., Comput. Phys. Commun. 181 (2010) 259, table 2, (b) and (f)
/// Validity  independent factors
/// Errors    InputError: less than 16 points that count; a result that is the same in all or nearly all items
/// Checked   tests/campaigns/sensitivity_test.cpp
SobolIndices calc_sobol_indices(const ItemResults& results, std::size_t factors, std::uint64_t seed);

/// Elementary effects of each factor, in the unit of the result.
struct MorrisMeasures {
  std::size_t points = 0;         // trajectories that count
  std::vector<Index> mean_size;   // mu*: mean of |effect|
  std::vector<double> mean;       // mu: mean of the effect, with its sign
  std::vector<double> deviation;  // sigma: standard deviation of the effect, from interactions and curvature
};

/// For a design kMorris: an effect is the change of the result as the factor goes up by kMorrisStep of its
/// probability: a uniform one by half of its range.
/// Source   Morris, Technometrics 33 (1991) 161; mu*: Campolongo, Cariboni, Saltelli, Environ. Model. Softw. 22
///          (2007) 1509
/// Errors   InputError: less than 4 trajectories that count
/// Checked  tests/campaigns/sensitivity_test.cpp
MorrisMeasures calc_morris_measures(const ItemResults& results, std::size_t factors, std::uint64_t seed);

}  // namespace rollrig::campaigns
