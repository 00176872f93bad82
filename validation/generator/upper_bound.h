#pragma once
/// An upper bound of what can be found in a validation set: what an ideal observer makes of its cases.
///
/// The observer knows the generator's equations, the sensors' noise and the effect, but neither the base parameters,
/// nor the offsets of the sensors. All is linear in those.

#include <map>
#include <string>
#include <vector>

#include "validation/generator/known_set.h"
#include "validation/generator/validation_set.h"

namespace rollrig::generator {

/// Equation  d'^2 = s^T C^-1 s,  C = N + U U^T
/// Symbols   s what the effects change, N noise, U offsets and base parameters by one prior standard deviation
struct UpperBound {
  static constexpr double kDetectable = 5.0;  // d'

  double d_prime = 0.0;
  std::map<std::string, double> log_bayes_factors;  // expected, against each other effect that it could be

  /// Whether the observer sees that something acts, and tells it from all else. Never of an effect outside the catalog.
  bool is_separable() const { return d_prime >= kDetectable && !log_bayes_factors.empty() && twins().empty(); }
  /// Effects that the data do not tell from the truth.
  std::vector<std::string> twins() const;
};

/// Of a case with effects. Those outside of the catalog are compared with no others, a pair with all single effects,
/// an effect with all but itself.
UpperBound find_upper_bound(const KnownSet& set, const SetOrder& order);
/// d' alone, which is a tenth of the work.
UpperBound find_detectability(const KnownSet& set);

struct UpperBoundOrder {
  std::string set;
  std::string out;                 // empty: upper_bound.json in the validation set
  std::vector<std::string> cases;  // empty: all
  bool detection_alone = false;    // d' and not what can be told apart
  int threads = 0;                 // 0: as many as there are cores
};

/// Opens the truth and writes rollrig-blind-ceiling/1 to `order.out`. What the file has of other cases of the same
/// truth stays. Returns of how many cases.
/// Errors  InputError: as open_truth() and require_same_files(); no such case
std::size_t write_upper_bounds(UpperBoundOrder& order, const Progress& progress);

}  // namespace rollrig::generator
