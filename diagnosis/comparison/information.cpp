#include "diagnosis/comparison/information.h"

#include <cmath>

#include "diagnosis/comparison/eigen_index.h"
#include "diagnosis/comparison/log_determinant.h"

namespace rollrig::diagnosis {

double calc_overlap_distance_nats(const PredictedOutcome& a, const PredictedOutcome& b) {
  const Eigen::LLT<Eigen::MatrixXd> factor(0.5 * (a.covariance + b.covariance));
  const Eigen::VectorXd apart = a.mean - b.mean;
  const double spread = 0.5 * (calc_log_determinant(a.covariance.llt()) + calc_log_determinant(b.covariance.llt()));
  return 0.125 * apart.dot(factor.solve(apart)) + 0.5 * (calc_log_determinant(factor) - spread);
}

double calc_information_bits(const std::vector<double>& probabilities, const std::vector<PredictedOutcome>& outcomes) {
  const std::size_t count = outcomes.size();
  Eigen::MatrixXd overlap = Eigen::MatrixXd::Identity(to_index(count), to_index(count));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = std::max(0.0, calc_overlap_distance_nats(outcomes[i], outcomes[j]));  // rounding
      overlap(to_index(i), to_index(j)) = overlap(to_index(j), to_index(i)) = std::exp(-distance);
    }
  }
  const Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(probabilities.data(), to_index(count));
  const Eigen::VectorXd density = overlap * w;
  double bits = 0.0;
  for (Eigen::Index i = 0; i < w.size(); ++i) bits -= w[i] > 0.0 ? w[i] * std::log2(density[i]) : 0.0;
  return std::max(0.0, bits);
}

}  // namespace rollrig::diagnosis
