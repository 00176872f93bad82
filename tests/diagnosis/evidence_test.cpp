#include "diagnosis/comparison/evidence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/diagnosis/gap_sets.h"

using namespace rollrig;
using diagnosis::AmplitudePrior;
using diagnosis::Amplitudes;
using diagnosis::Discrepancy;
using diagnosis::Evidence;
using diagnosis::PreparedSet;
using diagnosis::RowMatrix;
using diagnosis::to_index;

namespace {

const PreparedSet& short_set() {
  static const PreparedSet set([] {
    constexpr std::size_t kRows = 600;
    measurements::MeasurementSet cut = tests::make_gap_set({}, 1);
    cut.runs.front().time_s.resize(kRows);
    for (auto& [name, column] : cut.runs.front().columns) column.resize(kRows);
    return cut;
  }());
  return set;
}

/// A linear problem: whitened residuals r at u, that change by `jacobian`.
struct Problem {
  explicit Problem(Eigen::Index unknowns) : discrepancy(short_set()) {
    std::srand(5);  // Eigen's Random
    const Eigen::Index n = to_index(short_set().residual_count());
    fit.jacobian = 0.05 * RowMatrix::Random(n, unknowns);
    fit.unknowns = 0.5 * Eigen::VectorXd::Random(unknowns);
    fit.residuals = Eigen::VectorXd::Random(n) + 3.0 * fit.jacobian.col(0);
  }

  Evidence evidence() const { return {discrepancy, fit}; }

  /// The whole covariance of the whitened residuals, from the discrepancy's parts.
  Eigen::MatrixXd make_sigma(const Amplitudes& amplitudes) const {
    Eigen::MatrixXd sigma = Eigen::MatrixXd::Identity(fit.residuals.size(), fit.residuals.size());
    for (const Discrepancy::Basis& basis : discrepancy.bases()) {
      const auto& series = short_set().series()[basis.series.front()];
      const double square = amplitudes[basis.channel] * amplitudes[basis.channel];
      const Eigen::Index first = to_index(series.first_residual);
      const Eigen::Index size = to_index(series.size());
      sigma.block(first, first, size, size) +=
          square * basis.directions * basis.strengths.asDiagonal() * basis.directions.transpose();
    }
    return sigma;
  }

  Discrepancy discrepancy;
  diagnosis::Fit fit;
};

/// Likelihood times prior at unknowns, as logarithm, less what all hypotheses share: the powers of 2 pi.
class Density {
 public:
  Density(const Problem& problem, const Amplitudes& amplitudes)
      : problem_(problem), sigma_(problem.make_sigma(amplitudes)) {
    log_determinant_ = 2.0 * sigma_.matrixLLT().diagonal().array().log().sum();
  }
  double operator()(const Eigen::VectorXd& v) const {
    const Eigen::VectorXd r = problem_.fit.residuals + problem_.fit.jacobian * (v - problem_.fit.unknowns);
    const double log_likelihood = -0.5 * (r.dot(sigma_.solve(r)) + log_determinant_);
    const double log_prior = -0.5 * v.squaredNorm() -
                             0.5 * static_cast<double>(v.size()) * std::log(boost::math::constants::two_pi<double>());
    return log_likelihood + log_prior;
  }

 private:
  const Problem& problem_;
  Eigen::LLT<Eigen::MatrixXd> sigma_;
  double log_determinant_ = 0.0;
};

/// Integral over a grid from -8 to 8: for a normal density, exact to rounding.
struct Integral {
  double log_value = 0.0;
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

Integral integrate(const Density& density, Eigen::Index unknowns) {
  constexpr double kStep = 0.1;
  constexpr int kSide = 161;
  std::vector<double> logs;
  std::vector<Eigen::VectorXd> points;
  const int outer = unknowns == 2 ? kSide : 1;
  for (int i = 0; i < outer; ++i) {
    for (int j = 0; j < kSide; ++j) {
      Eigen::VectorXd v(unknowns);
      v[0] = -8.0 + kStep * j;
      if (unknowns == 2) v[1] = -8.0 + kStep * i;
      logs.push_back(density(v));
      points.push_back(v);
    }
  }
  const double largest = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  Integral integral{0.0, Eigen::VectorXd::Zero(unknowns), Eigen::MatrixXd::Zero(unknowns, unknowns)};
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const double weight = std::exp(logs[i] - largest);
    sum += weight;
    integral.mean += weight * points[i];
    integral.covariance += weight * points[i] * points[i].transpose();
  }
  integral.mean /= sum;
  integral.covariance = integral.covariance / sum - integral.mean * integral.mean.transpose();
  integral.log_value = largest + std::log(sum * std::pow(kStep, static_cast<double>(unknowns)));
  return integral;
}

}  // namespace

TEST_CASE("the evidence of a linear problem is the integral over its unknowns", "[fast]") {
  for (const Eigen::Index unknowns : {1, 2}) {
    const Problem problem(unknowns);
    const Amplitudes all[] = {{0.0, 0.0, 0.0}, {0.3, 2.0, 0.7}};
    for (const Amplitudes& amplitudes : all) {
      INFO(unknowns << " unknowns, amplitude " << amplitudes[0]);
      const Integral expected = integrate(Density(problem, amplitudes), unknowns);
      const Evidence::Solution solution = problem.evidence().solve(amplitudes, true);
      CHECK(solution.log_value == Approx(expected.log_value).margin(1e-6));
      CHECK((problem.fit.unknowns + solution.step - expected.mean).norm() < 1e-6);
      CHECK((solution.covariance - expected.covariance).norm() < 1e-6);
    }
  }
}

TEST_CASE("the evidence of a parameter with a range is the integral over that range", "[fast]") {
  Problem problem(1);
  const diagnosis::Term& term = diagnosis::find_term("load_exponent");
  problem.fit.hypothesis = diagnosis::Hypothesis{}.with({&term, 1});
  const auto [lower, upper] = diagnosis::list_own_bounds(problem.fit.hypothesis).front();
  const Amplitudes amplitudes{0.3, 2.0, 0.7};
  const Eigen::VectorXd residuals = problem.fit.residuals;
  for (const double pull : {0.0, 30.0, 45.0, 60.0}) {  // towards the lower end of the range, and beyond
    problem.fit.residuals = residuals + pull * problem.fit.jacobian.col(0);
    const Density density(problem, amplitudes);
    const Evidence::Solution solution = problem.evidence().solve(amplitudes);
    constexpr double kStep = 1e-3;
    double within = 0.0;  // in units of the evidence
    double prior = 0.0;
    for (double u = lower + 0.5 * kStep; u < std::min(upper, 12.0); u += kStep) {
      within += kStep * std::exp(density(Eigen::VectorXd::Constant(1, u)) - solution.log_value);
      prior += kStep * std::exp(-0.5 * u * u) * boost::math::constants::one_div_root_two_pi<double>();
    }
    INFO("pull " << pull << ", unbounded optimum " << problem.fit.unknowns[0] + solution.step[0]);
    CHECK(std::log(within / prior) == Approx(0.0).margin(2e-3));
  }
}

TEST_CASE("a discrepancy that stands on another counts both", "[fast]") {
  // The process of conditions has no size here, so that the one below is all there is.
  const Problem problem(2);
  const Amplitudes below{0.3, 2.0, 0.7};
  const Discrepancy of_conditions(problem.discrepancy, below);
  const Evidence above(of_conditions, problem.fit);
  CHECK(above.solve({0.0, 0.0, 0.0}).log_value == Approx(problem.evidence().solve(below).log_value).margin(1e-6));
}

TEST_CASE("the step leads to the best unknowns, from wherever the problem is expanded", "[fast]") {
  const Problem problem(3);
  const Amplitudes amplitudes{0.3, 2.0, 0.7};
  const Evidence::Solution solution = problem.evidence().solve(amplitudes);
  const Eigen::VectorXd best = problem.fit.unknowns + solution.step;
  const Density density(problem, amplitudes);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (const double off : {-0.1, 0.1}) {
      Eigen::VectorXd beside = best;
      beside[i] += off;
      CHECK(density(beside) < density(best));
    }
  }
  Problem moved(3);
  moved.fit.unknowns = best;
  moved.fit.residuals += moved.fit.jacobian * solution.step;
  const Evidence::Solution there = moved.evidence().solve(amplitudes);
  CHECK(there.step.norm() < 1e-9);
  CHECK(there.log_value == Approx(solution.log_value).margin(1e-7));
  CHECK(there.chi2 == Approx(solution.chi2));
}

TEST_CASE("an unknown that nothing depends on costs nothing", "[fast]") {
  const Problem one(1);
  Problem two(2);
  two.fit.residuals = one.fit.residuals;
  two.fit.unknowns << one.fit.unknowns[0], 0.0;
  two.fit.jacobian.col(0) = one.fit.jacobian.col(0);
  two.fit.jacobian.col(1).setZero();
  const Amplitudes amplitudes{0.3, 2.0, 0.7};
  CHECK(two.evidence().solve(amplitudes).log_value == Approx(one.evidence().solve(amplitudes).log_value).margin(1e-9));
}

TEST_CASE("an evidence over amplitudes is the sum over all their combinations", "[fast]") {
  const Problem problem(2);
  const Evidence evidence = problem.evidence();
  const std::vector<AmplitudePrior> priors{
      {{0.1, 1.0}, {0.4, 0.6}}, {{0.2, 2.0, 8.0}, {0.5, 0.3, 0.2}}, {{0.5}, {1.0}}};
  std::vector<double> logs;
  std::vector<Amplitudes> combinations;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      combinations.push_back({priors[0].amplitudes[i], priors[1].amplitudes[j], 0.5});
      logs.push_back(std::log(priors[0].weights[i] * priors[1].weights[j]) +
                     evidence.solve(combinations.back()).log_value);
    }
  }
  const Evidence::Sum sum = evidence.integrate(priors);
  CHECK(sum.log_value == Approx(diagnosis::log_sum_exp(logs)).margin(1e-9));
  for (std::size_t channel = 0; channel < 3; ++channel) {
    double mean = 0.0;
    for (std::size_t k = 0; k < logs.size(); ++k) mean += std::exp(logs[k] - sum.log_value) * combinations[k][channel];
    CHECK(sum.mean[channel] == Approx(mean));
  }
}

TEST_CASE("amplitudes near a middle are as likely half as twice it", "[fast]") {
  const AmplitudePrior prior = diagnosis::near_amplitude(0.4);
  double sum = 0.0;
  double mean_log = 0.0;
  for (std::size_t i = 0; i < prior.weights.size(); ++i) {
    sum += prior.weights[i];
    mean_log += prior.weights[i] * std::log(prior.amplitudes[i]);
  }
  CHECK(sum == Approx(1.0));
  CHECK(std::exp(mean_log) == Approx(0.4));
}

TEST_CASE("a law may be better than the share of a huge effect", "[fast]") {
  const auto weight_below = [](const AmplitudePrior& prior, double amplitude) {
    double sum = 0.0;
    for (std::size_t i = 0; i < prior.weights.size(); ++i)
      sum += prior.amplitudes[i] < amplitude ? prior.weights[i] : 0;
    return sum;
  };
  const AmplitudePrior huge = diagnosis::law_amplitude(0.1, 8.0);
  CHECK(weight_below(huge, 1e9) == Approx(1.0));
  CHECK(weight_below(huge, 1.0) == Approx(0.3));
  CHECK(weight_below(huge, 0.1) == 0.0);
  CHECK(weight_below(diagnosis::near_amplitude(8.0), 1.0) == 0.0);
  // Of a small effect the middle is next to the least already.
  CHECK(diagnosis::law_amplitude(0.1, 0.3).amplitudes == diagnosis::near_amplitude(0.3).amplitudes);
}

TEST_CASE("log sum exp holds where exp does not", "[fast]") {
  using diagnosis::log_sum_exp;
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  CHECK(log_sum_exp({std::log(2.0), std::log(3.0)}) == Approx(std::log(5.0)));
  CHECK(log_sum_exp({2000.0, 2000.0}) == Approx(2000.0 + std::log(2.0)));
  CHECK(log_sum_exp({-2000.0, -2001.0}) == Approx(-2000.0 + std::log(1.0 + std::exp(-1.0))));
  CHECK(log_sum_exp({7.0, kNever}) == 7.0);
  CHECK(log_sum_exp({kNever, kNever}) == kNever);
}
