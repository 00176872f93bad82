#include "estimation/normal_prior.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace rollrig::estimation {
namespace {

FreeParameter* find_with_prior(std::vector<FreeParameter>& parameters, const std::string& key) {
  const auto found = std::find_if(parameters.begin(), parameters.end(), [&](const FreeParameter& parameter) {
    return parameter.key == key && parameter.prior_sd_SI > 0.0;
  });
  return found == parameters.end() ? nullptr : &*found;
}

}  // namespace

void put_correlations(const std::vector<models::CorrelatedPair>& pairs, std::vector<FreeParameter>& parameters) {
  for (const models::CorrelatedPair& pair : pairs) {
    FreeParameter* first = find_with_prior(parameters, pair.first);
    FreeParameter* second = find_with_prior(parameters, pair.second);
    if (first == nullptr || second == nullptr) continue;
    first->prior_correlations[pair.second] = pair.correlation;
    second->prior_correlations[pair.first] = pair.correlation;
  }
}

Eigen::MatrixXd calc_prior_factor(const std::vector<FreeParameter>& parameters) {
  std::vector<const FreeParameter*> known;
  for (const FreeParameter& parameter : parameters) {
    if (parameter.prior_sd_SI > 0.0) known.push_back(&parameter);
  }
  const auto n = static_cast<Eigen::Index>(known.size());
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto& of = known[static_cast<std::size_t>(i)]->prior_correlations;
      const auto with = of.find(known[static_cast<std::size_t>(j)]->key);
      if (with != of.end()) correlation(i, j) = with->second;
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(correlation);
  if (factor.info() != Eigen::Success)
    throw std::invalid_argument("the correlation matrix of the priors is not positive definite");
  return factor.matrixL();
}

}  // namespace rollrig::estimation
