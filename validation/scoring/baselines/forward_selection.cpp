#include <algorithm>
#include <cmath>

#include "validation/scoring/baselines/naming.h"

namespace rollrig::validation {
namespace {

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

}  // namespace

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

}  // namespace rollrig::validation
