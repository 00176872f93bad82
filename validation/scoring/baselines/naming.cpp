#include "validation/scoring/baselines/naming.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <set>

#include "validation/scoring/case.h"

namespace rollrig::validation {
namespace {

using diagnosis::to_index;

bool has_effect_of(const LinearData& data, const std::vector<std::size_t>& columns, std::size_t column) {
  return std::any_of(columns.begin(), columns.end(),
                     [&](std::size_t other) { return data.effects[other] == data.effects[column]; });
}

/// All models with one effect more whose amplitudes may be so.
std::vector<CandidateModel> add_one(const LinearData& data, const LeastSquares& squares, double penalty,
                                    const std::vector<std::size_t>& chosen) {
  std::vector<CandidateModel> models;
  for (std::size_t column = 0; column < data.effects.size(); ++column) {
    if (has_effect_of(data, chosen, column)) continue;
    std::vector<std::size_t> columns = chosen;
    columns.push_back(column);
    const LeastSquares::Fit fit = squares.fit(columns);
    if (fit.amplitudes.minCoeff() < 0.0) continue;
    models.push_back({columns, fit.chi2 + penalty * static_cast<double>(columns.size())});
  }
  return models;
}

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
    if (amplitudes[to_index(j)] > 0.0) columns.push_back(j);
  }
  std::stable_sort(columns.begin(), columns.end(),
                   [&](std::size_t a, std::size_t b) { return amplitudes[to_index(a)] > amplitudes[to_index(b)]; });
  return columns;
}

}  // namespace

std::vector<std::string> find_named(const LinearData& data, const std::vector<std::size_t>& chosen) {
  std::vector<std::string> named;
  for (const std::size_t column : chosen) {
    const std::string& effect = data.effects[column];
    const bool is_new = std::find(named.begin(), named.end(), effect) == named.end();
    if (is_new && named.size() < kLargestNamedSet) named.push_back(effect);
  }
  return named;
}

Naming weigh(const LinearData& data, const std::vector<CandidateModel>& models, std::vector<std::size_t> chosen) {
  Naming naming;
  naming.chosen = std::move(chosen);
  naming.probability = {{"none", 0.0}, {"unknown", 0.0}};
  for (const std::string& effect : data.effects) naming.probability[effect] = 0.0;
  const std::vector<std::string> named = find_named(data, naming.chosen);
  const double best = std::min_element(models.begin(), models.end())->criterion;
  double sum = 0.0;
  for (const CandidateModel& model : models) sum += std::exp(0.5 * (best - model.criterion));
  for (const CandidateModel& model : models) {
    const double weight = std::exp(0.5 * (best - model.criterion)) / sum;
    std::set<std::string> effects;
    for (const std::size_t column : model.columns) effects.insert(data.effects[column]);
    for (const std::string& effect : effects) naming.probability[effect] += weight;
    if (effects.empty()) naming.probability["none"] += weight;
    const bool has_named = std::all_of(named.begin(), named.end(),
                                       [&effects](const std::string& effect) { return effects.count(effect) > 0; });
    if (has_named && (!named.empty() || effects.empty())) naming.named_probability += weight;
  }
  return naming;
}

Naming name_by_nearest_signature(const LinearData& data) {
  constexpr double kLevel = 0.01;
  const LeastSquares squares(data);
  const boost::math::chi_squared distribution(static_cast<double>(data.residual.size()));
  const bool is_gap = squares.chi2() > boost::math::quantile(boost::math::complement(distribution, kLevel));
  // The probability of "none" is the test's own, the effects share the rest as models with a size each.
  std::vector<CandidateModel> effects;
  for (std::size_t column = 0; column < data.effects.size(); ++column) {
    const double along = std::max(0.0, squares.along()[to_index(column)]);
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

Naming name_by_forward_selection(const LinearData& data, double penalty) {
  const LeastSquares squares(data);
  CandidateModel best{{}, squares.chi2()};
  std::vector<CandidateModel> tried{best};
  while (true) {
    const std::vector<CandidateModel> models = add_one(data, squares, penalty, best.columns);
    tried.insert(tried.end(), models.begin(), models.end());
    const auto next = std::min_element(models.begin(), models.end());
    if (next == models.end() || next->criterion >= best.criterion) break;
    best = *next;
  }
  return weigh(data, tried, best.columns);
}

Naming name_by_aic(const LinearData& data) { return name_by_forward_selection(data, 2.0); }

Naming name_by_bic(const LinearData& data) {
  return name_by_forward_selection(data, std::log(static_cast<double>(data.residual.size())));
}

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
