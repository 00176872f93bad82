#include "diagnosis/comparison/information.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace rollrig::diagnosis {
namespace {

double calc_log_determinant(const Eigen::LLT<Eigen::MatrixXd>& factor) {
  return 2.0 * factor.matrixLLT().diagonal().array().log().sum();
}

double calc_log_determinant(const Eigen::MatrixXd& covariance) {
  return calc_log_determinant(Eigen::LLT<Eigen::MatrixXd>(covariance));
}

}  // namespace

double calc_entropy_bits(const std::vector<double>& probabilities) {
  double sum = 0.0;
  for (const double p : probabilities) sum -= p > 0.0 ? p * std::log2(p) : 0.0;
  return sum;
}

double calc_divergence_nats(const PredictedOutcome& truth, const PredictedOutcome& other) {
  const Eigen::LLT<Eigen::MatrixXd> factor(other.covariance);
  const Eigen::VectorXd apart = truth.mean - other.mean;
  const double trace = factor.solve(truth.covariance).trace();
  const double ratio = calc_log_determinant(factor) - calc_log_determinant(truth.covariance);
  return 0.5 * (trace - static_cast<double>(apart.size()) + apart.dot(factor.solve(apart)) + ratio);
}

double calc_overlap_distance_nats(const PredictedOutcome& a, const PredictedOutcome& b) {
  const Eigen::LLT<Eigen::MatrixXd> factor(0.5 * (a.covariance + b.covariance));
  const Eigen::VectorXd apart = a.mean - b.mean;
  const double spread = 0.5 * (calc_log_determinant(a.covariance) + calc_log_determinant(b.covariance));
  return 0.125 * apart.dot(factor.solve(apart)) + 0.5 * (calc_log_determinant(factor) - spread);
}

double calc_information_bits(const std::vector<double>& probabilities, const std::vector<PredictedOutcome>& outcomes) {
  const std::size_t count = outcomes.size();
  Eigen::MatrixXd overlap =
      Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = std::max(0.0, calc_overlap_distance_nats(outcomes[i], outcomes[j]));  // rounding
      overlap(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = std::exp(-distance);
      overlap(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = std::exp(-distance);
    }
  }
  const Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(probabilities.data(), static_cast<Eigen::Index>(count));
  const Eigen::VectorXd density = overlap * w;
  double bits = 0.0;
  for (Eigen::Index i = 0; i < w.size(); ++i) bits -= w[i] > 0.0 ? w[i] * std::log2(density[i]) : 0.0;
  return std::max(0.0, bits);
}

}  // namespace rollrig::diagnosis
