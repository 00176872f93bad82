#include "validation/scoring/baselines/comparison.h"

#include <filesystem>

#include "validation/scoring/baselines/baselines.h"
#include "validation/scoring/figures.h"

namespace rollrig::validation {

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
