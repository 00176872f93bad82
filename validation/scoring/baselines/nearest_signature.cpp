#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>

#include "validation/scoring/baselines/naming.h"

namespace rollrig::validation {

using diagnosis::at;

Naming name_by_nearest_signature(const LinearData& data) {
  constexpr double kLevel = 0.01;
  const LeastSquares squares(data);
  const boost::math::chi_squared distribution(static_cast<double>(data.residual.size()));
  const bool is_gap = squares.chi2() > boost::math::quantile(boost::math::complement(distribution, kLevel));
  // The probability of "none" is the test's own, the effects share the rest as models with a size each.
  std::vector<CandidateModel> effects;
  for (std::size_t column = 0; column < data.effects.size(); ++column) {
    const double along = std::max(0.0, squares.along()[at(column)]);
    effects.push_back({{column}, -along * along});
  }
  const auto nearest = std::min_element(effects.begin(), effects.end());
  const bool is_named = is_gap && nearest != effects.end() && nearest->criterion < 0.0;
  if (effects.empty()) effects.push_back({{}, 0.0});
  Naming naming = weigh(data, effects, is_named ? nearest->columns : std::vector<std::size_t>{});
  const double none = is_named ? kLevel : 1.0 - kLevel;
  for (auto& [name, probability] : naming.probability) probability *= 1.0 - none;
  naming.probability["none"] = none;
  naming.named_probability = is_named ? (1.0 - none) * naming.named_probability : none;
  return naming;
}

}  // namespace rollrig::validation
