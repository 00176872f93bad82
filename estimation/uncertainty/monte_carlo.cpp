#include "estimation/uncertainty/monte_carlo.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "include/rollrig/error.h"
#include "sim/core/parallel.h"
#include "sim/core/random.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

constexpr double kMostFailed = 0.1;  // Assumed: beyond it the distribution is that of another measurement

double draw_input(const UncertainInput& input, RandomStream& random) {
  const double u = input.standard_uncertainty;
  if (input.distribution == Distribution::kNormal) return input.value + u * random.normal();
  const double uniform = random.uniform();
  if (input.distribution == Distribution::kRectangular) return input.value + u * std::sqrt(3.0) * (2.0 * uniform - 1.0);
  const double probability = std::max(uniform, std::numeric_limits<double>::min());
  if (input.distribution == Distribution::kMultivariateT) {
    const boost::math::chi_squared squares(input.degrees_freedom);
    return input.value * std::sqrt(input.degrees_freedom / boost::math::quantile(squares, probability));
  }
  return input.value + u * boost::math::quantile(boost::math::students_t(input.degrees_freedom), probability);
}

std::vector<double> draw_inputs(const MeasurementModel& model, RandomStream& random) {
  std::vector<double> inputs;
  for (const UncertainInput& input : model.inputs) inputs.push_back(draw_input(input, random));
  return inputs;
}

/// The results of each trial, one after the other; NaN where the evaluation failed. Inputs are drawn in the order of
/// the trials, on one thread, and so many at a time that they need little memory.
std::vector<double> evaluate_trials(const MeasurementModel& model, const UncertaintyRequest& request,
                                    const std::function<void(double)>& advance) {
  constexpr std::size_t kDrawn = 1 << 14;
  constexpr std::size_t kInRow = 16;  // trials in a row on one thread: some evaluations take less than a microsecond
  const std::size_t width = model.measurands.size();
  const auto trials = static_cast<std::size_t>(request.trials);
  std::vector<double> values(trials * width, std::numeric_limits<double>::quiet_NaN());
  RandomStream random(request.seed, "monte carlo");
  for (std::size_t first = 0; first < trials; first += kDrawn) {
    std::vector<std::vector<double>> drawn(std::min(kDrawn, trials - first));
    for (std::vector<double>& inputs : drawn) inputs = draw_inputs(model, random);
    const auto work = [&](std::size_t row) {
      for (std::size_t i = kInRow * row; i < std::min(drawn.size(), kInRow * (row + 1)); ++i) {
        try {
          const std::vector<double> results = model.evaluate(drawn[i]);
          std::copy(results.begin(), results.end(), values.begin() + static_cast<std::ptrdiff_t>((first + i) * width));
        } catch (const RunFailure&) {
        } catch (const InputError&) {  // a draw beyond what the evaluation takes
        }
      }
    };
    const auto advance_all = [&](double done) {
      const double share = static_cast<double>(drawn.size()) / static_cast<double>(trials);
      if (advance) advance(static_cast<double>(first) / static_cast<double>(trials) + done * share);
    };
    parallel_for((drawn.size() + kInRow - 1) / kInRow, request.threads, work, advance_all);
  }
  return values;
}

/// The value of a place between those of sorted values.
double find_value(const std::vector<double>& sorted, double place) {
  const double last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::clamp(std::round(place), 0.0, last))];
}

/// Half the distance of the order statistics one binomial standard deviation below and above a place.
double calc_end_sd(const std::vector<double>& sorted, double place, double probability) {
  const double step = std::sqrt(static_cast<double>(sorted.size()) * probability * (1.0 - probability));
  return 0.5 * (find_value(sorted, place + step) - find_value(sorted, place - step));
}

/// Student's t has no mean with one degree of freedom, and no variance with two.
void find_moments(const UncertaintyBudget& budget, MonteCarloResult& result) {
  for (const Contribution& line : budget.contributions) {
    if (line.contribution <= 0.0) continue;
    result.has_mean = result.has_mean && line.input.degrees_freedom > 1.0;
    result.has_sd = result.has_sd && line.input.degrees_freedom > 2.0;
  }
}

void compare_with_budget(const UncertaintyBudget& budget, MonteCarloResult& result) {
  find_moments(budget, result);
  const double factor = unit_of_key(budget.measurand.key).factor;  // digits are those of the unit that is shown
  result.tolerance = factor * calc_numerical_tolerance(budget.combined / factor);
  result.gum_low = budget.value - budget.expanded;
  result.gum_high = budget.value + budget.expanded;
  result.low_difference = std::abs(result.gum_low - result.low);
  result.high_difference = std::abs(result.gum_high - result.high);
  const auto is_within = [&](double sds) {
    return result.low_difference + sds * result.low_sd <= result.tolerance &&
           result.high_difference + sds * result.high_sd <= result.tolerance;
  };
  result.verdict = is_within(2.0)    ? GumVerdict::kAgrees
                   : is_within(-2.0) ? GumVerdict::kUndecided
                                     : GumVerdict::kDiffers;
}

MonteCarloResult summarize_trials(std::vector<double> values, const UncertaintyBudget& budget) {
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  MonteCarloResult result;
  result.measurand = budget.measurand;
  result.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.sd = std::sqrt(squares / (count - 1.0));
  // 7.7.2: q = 0.95 M rounded, r = (M - q)/2 rounded up; places count from 1 there.
  const double inside = std::round(kCoverage * count);
  const double low = std::ceil(0.5 * (count - inside)) - 1.0;
  result.low = find_value(values, low);
  result.high = find_value(values, low + inside);
  constexpr double kTail = 0.5 * (1.0 - kCoverage);
  result.low_sd = calc_end_sd(values, low, kTail);
  result.high_sd = calc_end_sd(values, low + inside, kTail);
  compare_with_budget(budget, result);
  constexpr double kPart = 5.0;  // 8.2
  const double times = kPart * std::max(result.low_sd, result.high_sd) / result.tolerance;
  result.trials_wanted = result.tolerance > 0.0 ? std::ceil(count * times * times) : count;
  return result;
}

}  // namespace

double calc_numerical_tolerance(double standard_uncertainty) {
  if (standard_uncertainty <= 0.0) return 0.0;
  double exponent = std::floor(std::log10(standard_uncertainty)) - 1.0;
  if (std::round(standard_uncertainty / std::pow(10.0, exponent)) >= 100.0) exponent += 1.0;
  return 0.5 * std::pow(10.0, exponent);
}

MonteCarlo run_monte_carlo(const MeasurementModel& model, const std::vector<UncertaintyBudget>& budgets,
                           const UncertaintyRequest& request, const std::function<void(double)>& advance) {
  const std::vector<double> values = evaluate_trials(model, request, advance);
  const std::size_t width = model.measurands.size();
  MonteCarlo monte_carlo;
  monte_carlo.trials = request.trials;
  monte_carlo.seed = request.seed;
  for (std::size_t i = 0; i < width; ++i) {
    std::vector<double> own;
    for (std::size_t at = i; at < values.size(); at += width) {
      if (!std::isnan(values[at])) own.push_back(values[at]);
    }
    monte_carlo.failed = std::max(monte_carlo.failed, request.trials - static_cast<int>(own.size()));
    if (monte_carlo.failed > kMostFailed * request.trials) {
      throw RunFailure(
          fmt::format("{} of {} trials of the Monte Carlo method failed", monte_carlo.failed, request.trials));
    }
    monte_carlo.results.push_back(summarize_trials(std::move(own), budgets[i]));
  }
  return monte_carlo;
}

}  // namespace rollrig::estimation
