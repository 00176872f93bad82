#include "estimation/uncertainty/budget.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "sim/core/error.h"
#include "sim/core/interrupt.h"

namespace rollrig::estimation {
namespace {

/// Half of the difference of the results between an input that is moved up and down by a step.
std::vector<double> calc_half_difference(const MeasurementModel& model, std::vector<double> inputs, std::size_t moved,
                                         double step) {
  const double center = inputs[moved];
  inputs[moved] = center + step;
  std::vector<double> moves = model.evaluate(inputs);
  inputs[moved] = center - step;
  const std::vector<double> below = model.evaluate(inputs);
  for (std::size_t i = 0; i < moves.size(); ++i) moves[i] = 0.5 * (moves[i] - below[i]);
  return moves;
}

/// How far each result moves when one input moves by its standard uncertainty, per result. Where the model fails so far
/// away, as for numbers that no tire has, from a tenth of it.
std::vector<double> calc_moves(const MeasurementModel& model, const std::vector<double>& inputs, std::size_t moved) {
  const double u = model.inputs[moved].standard_uncertainty;
  if (u == 0.0) return std::vector<double>(model.measurands.size(), 0.0);
  try {
    return calc_half_difference(model, inputs, moved, u);
  } catch (const RunFailure&) {
    constexpr double kShare = 0.1;
    std::vector<double> moves = calc_half_difference(model, inputs, moved, kShare * u);
    for (double& move : moves) move /= kShare;
    return moves;
  }
}

/// Adds a line, or, to one of the same name, its variance.
void add_contribution(const UncertainInput& input, double move, std::vector<Contribution>& lines) {
  const auto line = std::find_if(lines.begin(), lines.end(),
                                 [&input](const Contribution& other) { return other.input.name == input.name; });
  if (line == lines.end()) {
    const double sensitivity = input.standard_uncertainty == 0.0 ? 0.0 : move / input.standard_uncertainty;
    lines.push_back({input, sensitivity, std::abs(move), 0.0});
    return;
  }
  line->contribution = std::hypot(line->contribution, move);
  line->is_group = true;
  if (input.distribution == Distribution::kMultivariateT) line->input.distribution = input.distribution;
}

void combine_lines(UncertaintyBudget& budget) {
  double variance = 0.0;
  std::map<std::string, std::pair<double, double>> pools;  // variance, degrees of freedom
  for (const Contribution& line : budget.contributions) {
    const double own = line.contribution * line.contribution;
    variance += own;
    auto& pool = pools
                     .emplace(line.input.pool.empty() ? line.input.name : line.input.pool,
                              std::pair(0.0, line.input.degrees_freedom))
                     .first->second;
    pool.first += own;
  }
  double fourth = 0.0;
  for (const auto& [name, pool] : pools) fourth += pool.first * pool.first / pool.second;
  budget.combined = std::sqrt(variance);
  budget.degrees_freedom = fourth > 0.0 ? variance * variance / fourth : std::numeric_limits<double>::infinity();
  constexpr double kRounding = 1e-9;  // of the combined uncertainty
  for (Contribution& line : budget.contributions) {
    if (line.contribution < kRounding * budget.combined) line.contribution = line.sensitivity = 0.0;
    line.share = variance > 0.0 ? line.contribution * line.contribution / variance : 0.0;
  }
  budget.coverage_factor = calc_coverage_factor(budget.degrees_freedom);
  budget.expanded = budget.coverage_factor * budget.combined;
}

}  // namespace

double calc_coverage_factor(double degrees_freedom) {
  constexpr double kUpper = 0.5 * (1.0 + kCoverage);
  constexpr double kMany = 1e6;  // beyond which t is the normal distribution to six digits
  if (degrees_freedom > kMany) return boost::math::quantile(boost::math::normal(), kUpper);
  return boost::math::quantile(boost::math::students_t(std::max(1.0, degrees_freedom)), kUpper);
}

std::vector<UncertaintyBudget> calc_budgets(const MeasurementModel& model, const std::function<void(double)>& advance) {
  std::vector<double> inputs;
  for (const UncertainInput& input : model.inputs) inputs.push_back(input.value);
  const std::vector<double> values = model.evaluate(inputs);
  std::vector<UncertaintyBudget> budgets;
  for (std::size_t i = 0; i < values.size(); ++i) {
    budgets.emplace_back();
    budgets.back().measurand = model.measurands[i];
    budgets.back().value = values[i];
  }
  for (std::size_t k = 0; k < model.inputs.size(); ++k) {
    throw_if_interrupted();
    const std::vector<double> moves = calc_moves(model, inputs, k);
    if (advance) advance(static_cast<double>(k + 1) / static_cast<double>(model.inputs.size()));
    for (std::size_t i = 0; i < budgets.size(); ++i) {
      add_contribution(model.inputs[k], moves[i], budgets[i].contributions);
    }
  }
  for (UncertaintyBudget& budget : budgets) combine_lines(budget);
  return budgets;
}

}  // namespace rollrig::estimation
