#include <algorithm>
#include <cmath>
#include <set>

#include "validation/scoring/baselines/naming.h"

namespace rollrig::validation {
namespace {

using diagnosis::at;

/// Amplitudes of unit signatures under one penalty, from those under the one before.
void descend(const LeastSquares& squares, double lambda, Eigen::VectorXd& amplitudes) {
  constexpr int kMostSweeps = 1000;
  constexpr double kSettled = 1e-6;  // of the residual's standard deviation
  double moved = 1.0;
  for (int sweep = 0; sweep < kMostSweeps && moved > kSettled; ++sweep) {
    moved = 0.0;
    for (Eigen::Index j = 0; j < amplitudes.size(); ++j) {
      const double rest = squares.along()[j] - squares.products().row(j).dot(amplitudes) + amplitudes[j];
      const double next = std::max(0.0, rest - lambda);
      moved = std::max(moved, std::abs(next - amplitudes[j]));
      amplitudes[j] = next;
    }
  }
}

/// The columns that have an amplitude, the largest first.
std::vector<std::size_t> find_support(const Eigen::VectorXd& amplitudes) {
  std::vector<std::size_t> columns;
  for (std::size_t j = 0; j < static_cast<std::size_t>(amplitudes.size()); ++j) {
    if (amplitudes[at(j)] > 0.0) columns.push_back(j);
  }
  std::stable_sort(columns.begin(), columns.end(),
                   [&](std::size_t a, std::size_t b) { return amplitudes[at(a)] > amplitudes[at(b)]; });
  return columns;
}

}  // namespace

Naming name_by_sparse_regression(const LinearData& data) {
  constexpr int kPenalties = 100;  // Assumed: glmnet's usual path
  constexpr double kLeast = 1e-3;  // Assumed: of the penalty at which the first effect enters
  const LeastSquares squares(data);
  const double penalty = std::log(static_cast<double>(data.residual.size()));
  std::vector<CandidateModel> path{{{}, squares.chi2()}};
  std::set<std::set<std::size_t>> known;
  Eigen::VectorXd amplitudes = Eigen::VectorXd::Zero(squares.along().size());
  const double first = amplitudes.size() == 0 ? 0.0 : std::max(0.0, squares.along().maxCoeff());
  for (int i = 1; i < kPenalties && first > 0.0; ++i) {
    descend(squares, first * std::pow(kLeast, i / (kPenalties - 1.0)), amplitudes);
    const std::vector<std::size_t> support = find_support(amplitudes);
    if (!known.insert({support.begin(), support.end()}).second) continue;
    path.push_back({support, squares.fit(support).chi2 + penalty * static_cast<double>(support.size())});
  }
  return weigh(data, path, std::min_element(path.begin(), path.end())->columns);
}

}  // namespace rollrig::validation
