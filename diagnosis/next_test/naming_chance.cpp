#include "diagnosis/next_test/naming_chance.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "diagnosis/comparison/eigen_index.h"
#include "diagnosis/comparison/log_determinant.h"
#include "sim/core/random.h"

namespace rollrig::diagnosis {
namespace {

constexpr Eigen::Index kDraws = 64;

/// Averages over all hypotheses, each true in turn, and over their draws.
struct Told {
  double log_posterior = 0.0;  // of the true hypothesis
  double chance = 0.0;         // that its probability reaches the level
};

/// Tests done together: sums of their log-likelihoods, with a matrix (as OutcomeDraws) for each hypothesis that is
/// true.
class DoneTests {
 public:
  explicit DoneTests(std::size_t count) : sums_(count, Eigen::MatrixXd::Zero(kDraws, to_index(count))), count_(count) {}

  DoneTests with(const OutcomeDraws& test) const {
    DoneTests more = *this;
    for (std::size_t i = 0; i < count_; ++i) more.sums_[i] += test.log_likelihoods(i);
    return more;
  }

  Told tell(const std::vector<double>& probabilities, double level) const {
    const Eigen::Map<const Eigen::ArrayXd> w(probabilities.data(), to_index(probabilities.size()));
    Told told;
    for (std::size_t i = 0; i < count_; ++i) {
      const Eigen::VectorXd own = sums_[i].col(to_index(i));
      const Eigen::ArrayXXd ratios = (sums_[i].colwise() - own).array().exp().rowwise() * w.transpose();
      const Eigen::ArrayXd posterior = w[to_index(i)] / ratios.rowwise().sum();
      told.log_posterior += w[to_index(i)] * posterior.max(1e-300).log().mean();
      told.chance += w[to_index(i)] * static_cast<double>((posterior >= level).count()) / kDraws;
    }
    return told;
  }

 private:
  std::vector<Eigen::MatrixXd> sums_;
  std::size_t count_;
};

}  // namespace

OutcomeDraws::OutcomeDraws(const std::vector<PredictedOutcome>& outcomes, const std::string& name) {
  constexpr std::uint64_t kSeed = 1;
  RandomStream random(kSeed, "outcome/" + name);
  std::vector<Eigen::LLT<Eigen::MatrixXd>> factors;
  for (const PredictedOutcome& one : outcomes) factors.emplace_back(one.covariance);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    Eigen::MatrixXd z(outcomes[i].mean.size(), kDraws);
    for (double& value : z.reshaped()) value = random.normal();
    const Eigen::MatrixXd spread = factors[i].matrixL() * z;
    const Eigen::MatrixXd drawn = spread.colwise() + outcomes[i].mean;
    Eigen::MatrixXd log_likelihood(kDraws, to_index(outcomes.size()));
    for (std::size_t j = 0; j < outcomes.size(); ++j) {
      const Eigen::MatrixXd apart = drawn.colwise() - outcomes[j].mean;
      const Eigen::MatrixXd whitened = factors[j].matrixL().solve(apart);
      log_likelihood.col(to_index(j)) =
          -0.5 * (whitened.colwise().squaredNorm().transpose().array() + calc_log_determinant(factors[j]));
    }
    log_likelihoods_.push_back(std::move(log_likelihood));
  }
}

std::vector<double> find_naming_chances(const std::vector<double>& probabilities,
                                        const std::vector<PossibleTest>& tests, double hours, double level) {
  const DoneTests none(probabilities.size());
  const auto chance_from = [&](std::size_t first) {
    DoneTests done = none.with(tests[first].draws);
    Told told = done.tell(probabilities, level);
    double left_h = hours - tests[first].hours;
    std::vector<bool> is_done(tests.size(), false);
    is_done[first] = true;
    constexpr double kSure = 0.999;
    while (told.chance < kSure) {
      double best_rate = 0.0;
      std::size_t best = tests.size();
      for (std::size_t i = 0; i < tests.size(); ++i) {
        if (is_done[i] || tests[i].hours > left_h) continue;
        const double gain = done.with(tests[i].draws).tell(probabilities, level).log_posterior - told.log_posterior;
        if (gain / tests[i].hours <= best_rate) continue;
        best_rate = gain / tests[i].hours;
        best = i;
      }
      if (best == tests.size()) break;
      is_done[best] = true;
      left_h -= tests[best].hours;
      done = done.with(tests[best].draws);
      told = done.tell(probabilities, level);
    }
    return told.chance;
  };
  std::vector<double> chances;
  for (std::size_t i = 0; i < tests.size(); ++i) chances.push_back(tests[i].hours > hours ? 0.0 : chance_from(i));
  return chances;
}

}  // namespace rollrig::diagnosis
