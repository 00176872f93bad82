#include "diagnosis/checks/common_parts.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace rollrig::diagnosis {
namespace {

/// Parts of a channel that fit runs best, the offset left out.
Eigen::VectorXd fit_kept(const std::vector<const ChannelProducts*>& runs, const std::vector<bool>& is_kept) {
  const Eigen::Index parts = runs.front()->projection.size();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(parts, parts);
  Eigen::VectorXd projection = Eigen::VectorXd::Zero(parts);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!is_kept[r]) continue;
    const double noise_squared = std::max(1.0, runs[r]->residual / runs[r]->count);
    gram += runs[r]->gram / noise_squared;
    projection += runs[r]->projection / noise_squared;
  }
  gram.row(parts - 1).setZero();
  gram.col(parts - 1).setZero();
  gram(parts - 1, parts - 1) = 1.0;
  projection[parts - 1] = 0.0;
  return gram.ldlt().solve(projection);
}

/// By how much the squares of a run, in those of its noise, are above what parts of its own leave.
double calc_run_excess(const ChannelProducts& run, const Eigen::VectorXd& common) {
  const Eigen::Index parts = run.projection.size();
  const Eigen::MatrixXd own = run.gram + Eigen::MatrixXd::Identity(parts, parts);
  const double least = run.residual - run.projection.dot(own.ldlt().solve(run.projection));
  return (subtract_common(run, common).residual - least) / std::max(1.0, least / run.count);
}

/// Parts that fit all runs but those that they do not describe.
Eigen::VectorXd fit_channel(const std::vector<const ChannelProducts*>& runs) {
  constexpr double kFew = 10.0;  // Assumed, as kOdd
  constexpr double kOdd = 3.0;   // times the excess of the middle run
  constexpr int kRounds = 4;
  std::vector<bool> is_kept(runs.size(), true);
  Eigen::VectorXd fitted = fit_kept(runs, is_kept);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> excess;
    for (const ChannelProducts* run : runs) excess.push_back(calc_run_excess(*run, fitted));
    const double usual = calc_upper_median(excess);
    for (std::size_t r = 0; r < runs.size(); ++r) is_kept[r] = excess[r] <= kFew + kOdd * usual;
    fitted = fit_kept(runs, is_kept);
  }
  return fitted;
}

}  // namespace

double calc_upper_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

CommonParts fit_common(const std::vector<const RunProducts*>& runs) {
  constexpr std::size_t kFewestRuns = 3;
  CommonParts common;
  for (std::size_t c = 0; !runs.empty() && c < runs.front()->size(); ++c) {
    std::vector<const ChannelProducts*> with;
    for (const RunProducts* run : runs) {
      if ((*run)[c].has_value()) with.push_back(&*(*run)[c]);
    }
    if (with.size() < kFewestRuns) return {};
    common.push_back(fit_channel(with));
  }
  return common;
}

double calc_common_log_prior(const CommonParts& common, const RunProducts& products, double size) {
  double log = 0.0;
  for (std::size_t c = 0; c < common.size(); ++c) {
    if (!products[c].has_value()) continue;
    const Eigen::Index scaled = products[c]->scaled;
    log -= 0.5 * common[c].head(scaled).squaredNorm() / (size * size);
    log -= 0.5 * common[c].tail(common[c].size() - scaled).squaredNorm();
  }
  return log;
}

ChannelProducts subtract_common(ChannelProducts products, const Eigen::VectorXd& common) {
  const Eigen::VectorXd of_gram = products.gram * common;
  products.residual += common.dot(of_gram) - 2.0 * common.dot(products.projection);
  products.projection -= of_gram;
  return products;
}

}  // namespace rollrig::diagnosis
