#include "diagnosis/findings/balance.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/comparison/evidence.h"
#include "diagnosis/comparison/linear_fit.h"
#include "diagnosis/comparison/log_determinant.h"
#include "diagnosis/findings/perturbations.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

constexpr auto kKnots = static_cast<Eigen::Index>(kPerturbationKnots);
constexpr int kAmplitudes = 10;  // 0.5, 1, 2 .. 256 noise floors
constexpr double kSignificantOdds = 100.0;

/// Amplitude of each family: 0 for none, else k for 0.25 * 2^k noise floors.
using Choice = std::vector<int>;

double amplitude_of(int chosen) { return chosen == 0 ? 0.0 : 0.25 * std::exp2(chosen); }

/// Largest rms by channel that a constant perturbation of size 1 makes, in noise floors.
double measure_constant(const PreparedSet& set, const RowMatrix& columns) {
  std::vector<double> squares(set.channels().size(), 0.0);
  std::vector<double> counts(set.channels().size(), 0.0);
  for (const Series& series : set.series()) {
    const auto rows = series.rows_of(columns);
    squares[series.channel] += rows.rowwise().sum().squaredNorm() / (series.floor * series.floor);
    counts[series.channel] += static_cast<double>(series.size());
  }
  double largest = 0.0;
  for (std::size_t c = 0; c < squares.size(); ++c) {
    if (counts[c] > 0.0) largest = std::max(largest, squares[c] / counts[c]);
  }
  return std::sqrt(largest);
}

/// The linear model of all perturbations, in noise floors, run by run: perturbations of two runs meet in the null's
/// unknowns alone.
class PerturbationModel {
 public:
  PerturbationModel(const PreparedSet& set, const LinearFit& null, const std::vector<PerturbationFamily>& families)
      : null_curvature_(null.curvature), count_(families.size()) {
    RowMatrix columns(to_index(set.residual_count()), to_index(count_) * kKnots);
    for (std::size_t f = 0; f < count_; ++f) {
      const double largest = measure_constant(set, families[f].columns);
      columns.middleCols(to_index(f) * kKnots, kKnots) = families[f].columns / (largest > 0.0 ? largest : 1.0);
    }
    null.whiten(columns);
    const Eigen::Index n = columns.cols();
    const Eigen::Index unknowns = null.jacobian.cols();
    runs_.assign(set.runs().size(),
                 {Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, unknowns), Eigen::VectorXd::Zero(n)});
    for (const Series& series : set.series()) {
      const auto rows = series.rows_of(columns);
      OfRun& of = runs_[series.run];
      of.square += rows.transpose() * rows;
      of.with_null += rows.transpose() * series.rows_of(null.jacobian);
      of.score += rows.transpose() * series.rows_of(null.residual);
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(null_curvature_);
    null_log_determinant_ = calc_log_determinant(factor);
  }

  std::size_t family_count() const { return count_; }

  struct Result {
    double log_gain = 0.0;              // evidence over that of no perturbation
    std::vector<double> contributions;  // a_f.b_f
  };
  Result evaluate(const Choice& choice) const {
    std::vector<std::size_t> acting;
    for (std::size_t f = 0; f < count_; ++f) {
      if (choice[f] > 0) acting.push_back(f);
    }
    std::vector<Solved> solved;
    Eigen::MatrixXd curvature = null_curvature_;
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(curvature.cols());
    double square = 0.0;
    double log_determinant = -null_log_determinant_;
    for (const OfRun& run : runs_) {
      solved.push_back(solve(run, choice, acting));
      const Solved& one = solved.back();
      curvature -= one.half_with_null.transpose() * one.half_with_null;
      pull -= one.half_with_null.transpose() * one.half_score;
      square += one.half_score.squaredNorm();
      log_determinant += calc_log_determinant(one.factor);
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(curvature);
    log_determinant += calc_log_determinant(factor);
    const Eigen::VectorXd unknowns = factor.solve(pull);
    Result result{0.5 * (square + pull.dot(unknowns) - log_determinant), std::vector<double>(count_, 0.0)};
    for (const Solved& one : solved) {
      const Eigen::VectorXd sizes = one.factor.matrixU().solve(one.half_score - one.half_with_null * unknowns);
      for (std::size_t i = 0; i < acting.size(); ++i) {
        result.contributions[acting[i]] +=
            sizes.segment(to_index(i) * kKnots, kKnots).dot(one.score.segment(to_index(i) * kKnots, kKnots));
      }
    }
    return result;
  }

 private:
  struct OfRun {
    Eigen::MatrixXd square;     // X^T X
    Eigen::MatrixXd with_null;  // X^T J
    Eigen::VectorXd score;      // X^T r
  };
  /// A run's part under given amplitudes, in units of those: 1 + X^T X = L L^T.
  struct Solved {
    Eigen::LLT<Eigen::MatrixXd> factor;
    Eigen::MatrixXd half_with_null;  // L^-1 X^T J
    Eigen::VectorXd half_score;      // L^-1 X^T r
    Eigen::VectorXd score;
  };

  Solved solve(const OfRun& run, const Choice& choice, const std::vector<std::size_t>& acting) const {
    const Eigen::Index n = to_index(acting.size()) * kKnots;
    Eigen::MatrixXd square = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd with_null(n, run.with_null.cols());
    Solved solved;
    solved.score.resize(n);
    for (std::size_t i = 0; i < acting.size(); ++i) {
      const double amplitude = amplitude_of(choice[acting[i]]);
      const Eigen::Index from = to_index(acting[i]) * kKnots;
      for (std::size_t j = 0; j < acting.size(); ++j) {
        square.block(to_index(i) * kKnots, to_index(j) * kKnots, kKnots, kKnots) +=
            amplitude * amplitude_of(choice[acting[j]]) *
            run.square.block(from, to_index(acting[j]) * kKnots, kKnots, kKnots);
      }
      with_null.middleRows(to_index(i) * kKnots, kKnots) = amplitude * run.with_null.middleRows(from, kKnots);
      solved.score.segment(to_index(i) * kKnots, kKnots) = amplitude * run.score.segment(from, kKnots);
    }
    solved.factor.compute(square);
    solved.half_with_null = solved.factor.matrixL().solve(with_null);
    solved.half_score = solved.factor.matrixL().solve(solved.score);
    return solved;
  }

  Eigen::MatrixXd null_curvature_;
  double null_log_determinant_ = 0.0;
  std::size_t count_;
  std::vector<OfRun> runs_;
};

/// Log probability before the measurement, over that of no perturbation: none at all is as likely as any.
double log_prior_odds(const Choice& choice) {
  const double absent = std::pow(0.5, 1.0 / static_cast<double>(choice.size()));
  const double odds = (1.0 - absent) / absent / kAmplitudes;
  const auto acting = choice.size() - static_cast<std::size_t>(std::count(choice.begin(), choice.end(), 0));
  return static_cast<double>(acting) * std::log(odds);
}

/// Choices that differ by one family, one amplitude, or one family in another's stead.
std::vector<Choice> find_neighbors(const Choice& choice) {
  std::vector<Choice> neighbors;
  for (std::size_t f = 0; f < choice.size(); ++f) {
    for (int amplitude = 0; amplitude <= kAmplitudes; ++amplitude) {
      if (amplitude == choice[f]) continue;
      Choice changed = choice;
      changed[f] = amplitude;
      neighbors.push_back(changed);
      if (choice[f] > 0 || amplitude == 0) continue;
      for (std::size_t other = 0; other < choice.size(); ++other) {
        if (choice[other] == 0) continue;
        Choice swapped = changed;
        swapped[other] = 0;
        neighbors.push_back(std::move(swapped));
      }
    }
  }
  return neighbors;
}

struct Weighed {
  Choice choice;
  PerturbationModel::Result result;
  double log_odds = 0.0;  // over no perturbation, after the measurement
};

Weighed weigh(const PerturbationModel& model, const Choice& choice) {
  Weighed weighed{choice, model.evaluate(choice), 0.0};
  weighed.log_odds = weighed.result.log_gain + log_prior_odds(choice);
  return weighed;
}

/// Uphill from no perturbation to a choice better than all its neighbors; that choice and those.
std::vector<Weighed> search(const PerturbationModel& model, int threads) {
  Weighed best = weigh(model, Choice(model.family_count(), 0));
  while (true) {
    const std::vector<Choice> neighbors = find_neighbors(best.choice);
    std::vector<Weighed> weighed(neighbors.size());
    parallel_for(neighbors.size(), threads, [&](std::size_t i) { weighed[i] = weigh(model, neighbors[i]); });
    const auto top = std::max_element(weighed.begin(), weighed.end(),
                                      [](const Weighed& a, const Weighed& b) { return a.log_odds < b.log_odds; });
    if (!(top->log_odds > best.log_odds)) {
      weighed.push_back(std::move(best));
      return weighed;
    }
    best = std::move(*top);
  }
}

std::vector<double> average_shares(const std::vector<Weighed>& all, double log_sum) {
  std::vector<double> shares(all.front().choice.size(), 0.0);
  for (const Weighed& one : all) {
    double whole = 0.0;
    for (const double part : one.result.contributions) whole += std::max(0.0, part);
    if (!(whole > 0.0)) continue;
    const double weight = std::exp(one.log_odds - log_sum);
    for (std::size_t f = 0; f < shares.size(); ++f) {
      shares[f] += weight * std::max(0.0, one.result.contributions[f]) / whole;
    }
  }
  return shares;
}

}  // namespace

std::vector<BalanceShare> find_balance(const Study& study) {
  const std::vector<PerturbationFamily> families = calc_perturbations(study);
  const PerturbationModel model(study.set, LinearFit(study.discrepancy, study.null), families);
  const std::vector<Weighed> all = search(model, study.settings.threads);
  std::vector<double> logs;
  for (const Weighed& one : all) logs.push_back(one.log_odds);
  const double log_sum = log_sum_exp(logs);
  if (log_sum < std::log(kSignificantOdds)) return {};
  const std::vector<double> shares = average_shares(all, log_sum);
  std::vector<BalanceShare> balance;
  for (std::size_t f = 0; f < families.size(); ++f) {
    constexpr double kWorthListing_percent = 1.0;
    const double share_percent = 100.0 * shares[f];
    if (share_percent >= kWorthListing_percent) balance.push_back({families[f].name, share_percent});
  }
  std::stable_sort(balance.begin(), balance.end(),
                   [](const BalanceShare& a, const BalanceShare& b) { return a.share_percent > b.share_percent; });
  return balance;
}

}  // namespace rollrig::diagnosis
