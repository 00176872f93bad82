#include "validation/scoring/baselines/baselines.h"

#include <algorithm>
#include <filesystem>

#include "validation/scoring/baselines/gaussian_process.h"
#include "validation/scoring/baselines/linearized_set.h"

namespace rollrig::validation {
namespace {

using diagnosis::Diagnosis;
using diagnosis::to_index;
using diagnosis::Verdict;

Diagnosis shrink_by_gaussian_process(const LinearizedSet& set) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::kUnexplained;
  diagnosis.probability = {{"none", 0.0}, {"unknown", 1.0}};
  diagnosis.gap = set.find_gap({}, subtract_gaussian_process);
  diagnosis::Gap& gap = diagnosis.gap;
  gap.shrink_percent = gap.black_box_percent;
  gap.recalibrated.after = (1.0 - gap.shrink_percent.value_or(0.0) / 100.0) * gap.recalibrated.before;
  return diagnosis;
}

/// The chosen effects, at the amplitudes of least squares.
std::vector<ChosenEffect> find_amplitudes(const std::vector<TriedEffect>& tried, const LinearData& data,
                                          const std::vector<std::size_t>& columns) {
  const LeastSquares::Fit fit = LeastSquares(data).fit(columns);
  std::vector<ChosenEffect> chosen;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    chosen.push_back({tried[columns[i]], fit.amplitudes[to_index(i)], fit.sd[to_index(i)]});
  }
  return chosen;
}

diagnosis::Cause make_cause(const Naming& naming, const LinearData& data, const std::vector<ChosenEffect>& chosen) {
  diagnosis::Cause cause;
  cause.effects = find_named(data, naming.chosen);
  cause.probability = naming.named_probability;
  for (const std::string& effect : cause.effects) {
    const auto of = std::find_if(chosen.begin(), chosen.end(),
                                 [&effect](const ChosenEffect& one) { return one.tried.term.term->name() == effect; });
    cause.parameters.push_back(estimate_size(*of));
  }
  return cause;
}

Diagnosis name_effects(const BaselineMethod& method, const LinearizedSet& set) {
  const std::vector<TriedEffect> tried = set.try_effects();
  const LinearData data = set.project(tried);
  const Naming naming = method.name(data);
  Diagnosis diagnosis;
  diagnosis.probability = naming.probability;
  if (naming.chosen.empty()) {
    diagnosis.gap = set.find_gap({});
    return diagnosis;
  }
  const std::vector<ChosenEffect> chosen = find_amplitudes(tried, data, naming.chosen);
  diagnosis.verdict = Verdict::kExplained;
  diagnosis.causes = {make_cause(naming, data, chosen)};
  diagnosis.gap = set.find_gap(chosen);
  return diagnosis;
}

}  // namespace

const std::vector<BaselineMethod>& all_baselines() {
  static const std::vector<BaselineMethod> methods{
      {"nearest", "nearest signature", name_by_nearest_signature},
      {"aic", "forward, AIC", name_by_aic},
      {"bic", "forward, BIC", name_by_bic},
      {"sparse", "LASSO", name_by_sparse_regression},
      {"gp", "Gaussian process", nullptr},
  };
  return methods;
}

std::string baseline_folder(const std::string& set, const BaselineMethod& method) {
  return (std::filesystem::path(set) / ("answers-" + std::string(method.id))).string();
}

Diagnosis diagnose_by(const BaselineMethod& method, const measurements::MeasurementSet& measured,
                      const Settings& settings) {
  const LinearizedSet set(measured, settings);
  Diagnosis diagnosis = method.name == nullptr ? shrink_by_gaussian_process(set) : name_effects(method, set);
  diagnosis.set = measured.name;
  return diagnosis;
}

std::vector<BaselineScore> score_baselines(const ScoreOrder& order, const ScoreOptions& options) {
  std::vector<BaselineScore> scores;
  if (order.truth_was_left_out) return scores;
  for (const BaselineMethod& method : all_baselines()) {
    ScoreOrder of_method = order;
    of_method.by_baseline = true;
    of_method.answers = baseline_folder(order.set, method);
    of_method.next_tests.clear();  // they were proposed by the diagnosis
    of_method.drawn_tests.clear();
    if (!std::filesystem::is_directory(of_method.answers)) continue;
    BaselineScore score{method.id, method.label, {}};
    for (const Figure& figure : find_figures(read_cases(of_method), options)) {
      const bool is_judged = method.name != nullptr || figure.id.rfind("shrinkage", 0) == 0;
      if (is_judged && figure.value.has_value()) score.values[figure.id] = *figure.value;
    }
    scores.push_back(std::move(score));
  }
  return scores;
}

void put_beside(std::vector<BaselineScore> baselines, Score& score) {
  for (Figure& figure : score.figures) {
    for (const BaselineScore& baseline : baselines) {
      const auto at = baseline.values.find(figure.id);
      if (at == baseline.values.end()) continue;
      const double best = figure.best_baseline.value_or(at->second);
      const bool is_better = figure.more_is_better ? at->second > best : at->second < best;
      if (figure.best_baseline.has_value() && !is_better) continue;
      figure.best_baseline = at->second;
      figure.best_baseline_id = baseline.id;
    }
  }
  score.baselines = std::move(baselines);
}

}  // namespace rollrig::validation
