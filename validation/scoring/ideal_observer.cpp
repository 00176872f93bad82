// What an ideal observer of the same cases would reach.
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "diagnosis/thresholds.h"
#include "validation/scoring/score.h"

namespace rollrig::validation {

std::optional<double> find_chance_of_detection(const Case& one) {
  constexpr double kOneInHundred = 2.326;  // quantile of the normal distribution
  if (!one.d_prime.has_value()) return std::nullopt;
  return cdf(boost::math::normal(), *one.d_prime - kOneInHundred);
}

std::optional<double> find_chance_of_small_set(const Case& one) {
  if (one.log_bayes_factors.empty()) return std::nullopt;
  const auto twins = std::count_if(one.log_bayes_factors.begin(), one.log_bayes_factors.end(),
                                   [](double nats) { return nats < diagnosis::thresholds::kToldApart_nats; });
  return static_cast<std::size_t>(twins) < kLargestNamedSet ? 1.0 : 0.0;
}

std::optional<double> find_chance_of_pair(const Case& one, double detectable_d_prime) {
  if (!one.d_prime.has_value() || !one.identifiable.has_value()) return std::nullopt;
  return *one.d_prime >= detectable_d_prime && *one.identifiable ? 1.0 : 0.0;
}

std::optional<bool> is_pair_named_by_ideal(const Case& one) {
  if (!one.is_pair() || one.log_bayes_factors.empty()) return std::nullopt;
  const diagnosis::ComparisonPriors priors;
  // A pair is compared with all effects that the generator has for the case.
  const double others = std::max(1.0, static_cast<double>(one.log_bayes_factors.size()) - 1.0);
  const double prior_odds = 2.0 * priors.pairs / (others * priors.singles);
  double against = 0.0;
  for (const double nats : one.log_bayes_factors) {
    against += std::exp(-nats) * std::sqrt(1.0 + 2.0 * nats) / prior_odds;
  }
  return against < 1.0;
}

std::optional<double> find_mean_chance(const std::vector<Case>& cases, const Chance& chance) {
  if (cases.empty()) return std::nullopt;
  double sum = 0.0;
  for (const Case& one : cases) {
    const std::optional<double> of_one = chance(one);
    if (!of_one.has_value()) return std::nullopt;
    sum += *of_one;
  }
  return sum / static_cast<double>(cases.size());
}

}  // namespace rollrig::validation
