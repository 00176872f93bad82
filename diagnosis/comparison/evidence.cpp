#include "diagnosis/comparison/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/comparison/log_determinant.h"
#include "diagnosis/comparison/truncated_normal.h"
#include "diagnosis/thresholds.h"

namespace rollrig::diagnosis {

double log_sum_exp(const std::vector<double>& logs) {
  const double largest = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(largest)) return largest;
  double sum = 0.0;
  for (const double value : logs) sum += std::exp(value - largest);
  return largest + std::log(sum);
}

AmplitudePrior near_amplitude(double middle) {
  AmplitudePrior prior;
  double sum = 0.0;
  for (int step = -2; step <= 2; ++step) {
    prior.amplitudes.push_back(middle * std::exp2(step));
    prior.weights.push_back(std::exp(-0.5 * step * step));  // standard deviation: a factor of two
    sum += prior.weights.back();
  }
  for (double& weight : prior.weights) weight /= sum;
  return prior;
}

AmplitudePrior law_amplitude(double least, double middle) {
  AmplitudePrior prior = near_amplitude(middle);
  constexpr double kStep = 4.0;
  std::vector<double> below;
  for (double amplitude = prior.amplitudes.front() / kStep; amplitude >= least; amplitude /= kStep) {
    below.push_back(amplitude);
  }
  if (below.empty()) return prior;
  for (double& weight : prior.weights) weight *= 1.0 - thresholds::kExactLaw;
  prior.amplitudes.insert(prior.amplitudes.end(), below.begin(), below.end());
  prior.weights.resize(prior.amplitudes.size(), thresholds::kExactLaw / static_cast<double>(below.size()));
  return prior;
}

AmplitudePrior free_amplitude(double smallest) {
  AmplitudePrior prior{{smallest}, {0.5}};
  for (double larger = std::max(0.4, 4.0 * smallest); larger < 100.0; larger *= 2.0) prior.amplitudes.push_back(larger);
  const auto count = static_cast<double>(prior.amplitudes.size() - 1);
  prior.weights.resize(prior.amplitudes.size(), 0.5 / count);
  return prior;
}

Evidence::Evidence(const Discrepancy& discrepancy, const Fit& fit)
    : discrepancy_(discrepancy), unknowns_(fit.unknowns), own_bounds_(list_own_bounds(fit.hypothesis)) {
  RowMatrix columns = fit.jacobian;
  Eigen::VectorXd r = fit.residuals;
  discrepancy.whiten_below(columns);
  discrepancy.whiten_below(r);
  log_determinant_below_ = discrepancy.log_determinant_below();
  for (const Discrepancy::Basis& basis : discrepancy.bases()) {
    const Eigen::MatrixXd rows = discrepancy.gather(basis, columns);
    const Eigen::VectorXd of_basis = discrepancy.gather(basis, r);
    parts_.push_back({rows.transpose() * rows, rows.transpose() * of_basis, of_basis.squaredNorm(),
                      basis.directions.transpose() * rows, basis.directions.transpose() * of_basis});
  }
}

Evidence::Sums& Evidence::Sums::operator+=(const Sums& other) {
  curvature += other.curvature;
  gradient += other.gradient;
  square += other.square;
  log_determinant += other.log_determinant;
  return *this;
}

Evidence::Sums Evidence::make_empty() const {
  const Eigen::Index n = unknowns_.size();
  return {Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
}

Evidence::Sums Evidence::sum_channel(std::size_t channel, double amplitude) const {
  Sums sum = make_empty();
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const Discrepancy::Basis& basis = discrepancy_.bases()[b];
    if (basis.channel != channel) continue;
    const Part& of = parts_[b];
    const Eigen::ArrayXd scaled = amplitude * amplitude * basis.strengths.array();
    const Eigen::VectorXd taken = (scaled / (1.0 + scaled)).matrix();
    sum.curvature += of.curvature - of.along.transpose() * taken.asDiagonal() * of.along;
    sum.gradient += of.gradient - of.along.transpose() * taken.cwiseProduct(of.along_residual);
    sum.square += of.square - of.along_residual.cwiseAbs2().dot(taken);
    sum.log_determinant += (1.0 + scaled).log().sum();
  }
  return sum;
}

double Evidence::calc_log_within(const Eigen::LLT<Eigen::MatrixXd>& factor, const Eigen::VectorXd& step) const {
  constexpr double kOutOfReach = 5.0;  // prior units: no standard deviation is larger than one of them
  double sum = 0.0;
  for (std::size_t i = 0; i < own_bounds_.size(); ++i) {
    const auto [lower, upper] = own_bounds_[i];
    const double mean = unknowns_[to_index(i)] + step[to_index(i)];
    const double nearest = std::min({upper - mean, mean - lower, upper, -lower});
    if (nearest > kOutOfReach) continue;
    const Eigen::VectorXd column = factor.solve(Eigen::VectorXd::Unit(step.size(), to_index(i)));
    sum += calc_log_mass({mean, std::sqrt(column[to_index(i)]), lower, upper});
    sum -= calc_log_mass({0.0, 1.0, lower, upper});
  }
  return sum;
}

Evidence::Solution Evidence::solve(const Sums& sums, bool with_covariance) const {
  const Eigen::Index n = unknowns_.size();
  const Eigen::MatrixXd m = sums.curvature + Eigen::MatrixXd::Identity(n, n);
  const Eigen::VectorXd g = sums.gradient + unknowns_;
  const Eigen::LLT<Eigen::MatrixXd> factor(m);
  Solution solution;
  solution.step = -factor.solve(g);
  solution.chi2 = sums.square + unknowns_.squaredNorm() + g.dot(solution.step);
  const double log_m = calc_log_determinant(factor);
  solution.log_value = -0.5 * (solution.chi2 + sums.log_determinant + log_determinant_below_ + log_m) +
                       calc_log_within(factor, solution.step);
  // Data that are beyond all rounding, such as rows a nanosecond apart, leave no positive definite matrix.
  if (factor.info() != Eigen::Success || !std::isfinite(solution.log_value)) {
    solution.log_value = -std::numeric_limits<double>::infinity();
  }
  if (with_covariance) solution.covariance = factor.solve(Eigen::MatrixXd::Identity(n, n));
  return solution;
}

Evidence::Solution Evidence::solve(const Amplitudes& amplitudes, bool with_covariance) const {
  Sums sums = make_empty();
  for (std::size_t channel = 0; channel < amplitudes.size(); ++channel) {
    sums += sum_channel(channel, amplitudes[channel]);
  }
  return solve(sums, with_covariance);
}

Evidence::Sum Evidence::integrate(const std::vector<AmplitudePrior>& priors) const {
  std::vector<std::vector<Sums>> channels(priors.size());
  for (std::size_t channel = 0; channel < priors.size(); ++channel) {
    for (const double amplitude : priors[channel].amplitudes) {
      channels[channel].push_back(sum_channel(channel, amplitude));
    }
  }
  std::vector<std::size_t> index(priors.size(), 0);
  std::vector<double> logs;
  std::vector<Amplitudes> combinations;
  while (true) {
    Sums sums = make_empty();
    double log_weight = 0.0;
    Amplitudes amplitudes;
    for (std::size_t channel = 0; channel < priors.size(); ++channel) {
      sums += channels[channel][index[channel]];
      log_weight += std::log(priors[channel].weights[index[channel]]);
      amplitudes.push_back(priors[channel].amplitudes[index[channel]]);
    }
    logs.push_back(log_weight + solve(sums, false).log_value);
    combinations.push_back(std::move(amplitudes));
    std::size_t channel = 0;
    while (channel < priors.size() && ++index[channel] == priors[channel].amplitudes.size()) index[channel++] = 0;
    if (channel == priors.size()) break;
  }
  Sum sum{log_sum_exp(logs), Amplitudes(priors.size(), 0.0)};
  if (!std::isfinite(sum.log_value)) return sum;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const double weight = std::exp(logs[i] - sum.log_value);
    for (std::size_t c = 0; c < priors.size(); ++c) sum.mean[c] += weight * combinations[i][c];
  }
  return sum;
}

}  // namespace rollrig::diagnosis
