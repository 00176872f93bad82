#include "diagnosis/checks/mistake_trials.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/core/error.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr double kInOneRun = 1e-2;      // Assumed: prior probability of a mistake in a run
constexpr double kTwoInOneRun = 1e-5;   // Assumed: likewise, of two
constexpr double kPlausible = 1.0;      // Assumed: tolerances, within which a run can be what it says
constexpr double kOdd = 0.3;            // Assumed: tolerances, from which a run needs an explanation
constexpr double kOddOnRollers = 0.15;  // Assumed: likewise, for one wrong unit on rollers, where all of a drive counts
constexpr double kHalf = 0.5;           // Assumed: of the sum of squares, what one wrong unit undone may leave
constexpr double kTenth = 0.1;          // Assumed: likewise, exchanged columns or two mistakes undone
constexpr double kSize = 0.25;          // Assumed: of what is not known of a run, where trials are only compared
constexpr std::size_t kFirstOfTwo = 6;  // single mistakes that a second one is tried with

Trial judge_run(const MeasurementSet& set, std::size_t r, const MeasuredRun& run,
                const sim::Recording<double>& simulated) {
  Trial trial;
  const ComparedRows rows = choose_rows(set, set.runs[r]);
  trial.products = calc_products(set, run, simulated, rows, set.runs[r].time_s);
  trial.of_given = calc_given_log_likelihood(set, r, run);
  const RunMisfit misfit = calc_misfit(set, run, simulated, rows);
  trial.worst = misfit.worst();
  trial.squares = misfit.sum_of_squares();
  trial.is_plausible = calc_misfit(set, run, simulated).worst() <= kPlausible;
  trial.is_simulated = true;
  return trial;
}

bool changes_inputs(const MeasurementSet& set, const Mistake& mistake) {
  const std::vector<Quantity> measured = measurements::measured_channels(*set.kind);
  return std::any_of(mistake.columns.begin(), mistake.columns.end(), [&](const Quantity& column) {
    return std::find(measured.begin(), measured.end(), column) == measured.end();
  });
}

/// What the scatter of a measured column says about its unit: numbers that are too small scatter less than the sensor.
/// Equation  w n ln f
/// Symbols   n independent samples, f factor that undoes the mistake; w 0.35, Assumed: less than 1/2, as the noise of a
///           set may be a guess, and more than 1/4, so that no other hypothesis gains by numbers near 0
double calc_log_of_scatter(const MeasurementSet& set, const Mistake& mistake, const RunProducts& products) {
  constexpr double kWeight = 0.35;
  const std::vector<Quantity> channels = measurements::measured_channels(*set.kind);
  double sum = 0.0;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto factor = mistake.log_factors.find(channels[c]);
    if (factor == mistake.log_factors.end() || !products[c].has_value()) continue;
    sum += kWeight * products[c]->count * factor->second;
  }
  return sum;
}

/// A run with a mistake undone.
Trial judge_without(const MeasurementSet& set, const BaselineRuns& baseline, std::size_t r, const Mistake& mistake) {
  MeasuredRun run = set.runs[r];
  if (!mistake.undo(run)) return {};
  try {
    const bool as_before = baseline.misfits[r].failure.empty() && !changes_inputs(set, mistake);
    Trial trial = judge_run(set, r, run, as_before ? baseline.recordings[r] : resimulate_baseline(set, run));
    trial.of_given += calc_log_of_scatter(set, mistake, trial.products);
    return trial;
  } catch (const RunFailure&) {
    return {};
  }
}

double sum_weights(const std::vector<Mistake>& mistakes) {
  return std::accumulate(mistakes.begin(), mistakes.end(), 0.0,
                         [](double sum, const Mistake& mistake) { return sum + mistake.weight; });
}

}  // namespace

Candidates::Candidates(const MeasurementSet& set, const BaselineRuns& baseline, int threads,
                       const std::function<bool(const Mistake&, std::size_t)>& tells)
    : set_(set), baseline_(baseline), threads_(threads), mistakes_(list_mistakes(set)), runs_(set.runs.size()) {
  singles_ = mistakes_.size();
  parallel_for(runs_.size(), threads, [&](std::size_t r) { judge_as_it_is(r); });
  std::vector<std::pair<std::size_t, std::size_t>> work;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (is_near(r)) continue;
    for (std::size_t m = 0; m < singles_; ++m) {
      if (tells(mistakes_[m], r)) work.emplace_back(r, m);
    }
  }
  try_out(work, kInOneRun / sum_weights(mistakes_));
  add_pairs(tells);
}

void Candidates::judge_as_it_is(std::size_t r) {
  if (baseline_.misfits[r].failure.empty()) runs_[r].none = judge_run(set_, r, set_.runs[r], baseline_.recordings[r]);
  runs_[r].none.log_prior = std::log(1.0 - kInOneRun);
}

bool Candidates::is_near(std::size_t r) const {
  constexpr double kNear = 0.1;  // tolerances
  return !models::is_on_road(set_.kind->traits) && runs_[r].none.is_simulated && runs_[r].none.worst < kNear;
}

void Candidates::try_out(const std::vector<std::pair<std::size_t, std::size_t>>& work, double prior_of_weight) {
  std::vector<Trial> tried(work.size());
  parallel_for(work.size(), threads_, [&](std::size_t i) {
    const auto [r, m] = work[i];
    tried[i] = judge_without(set_, baseline_, r, mistakes_[m]);
  });
  for (std::size_t i = 0; i < work.size(); ++i) {
    if (!tried[i].is_simulated) continue;
    tried[i].mistake = work[i].second;
    tried[i].is_far_better = is_far_better(tried[i], runs_[work[i].first].none);
    tried[i].log_prior = std::log(prior_of_weight * mistakes_[work[i].second].weight);
    runs_[work[i].first].mistaken.push_back(std::move(tried[i]));
  }
}

bool Candidates::is_far_better(const Trial& tried, const Trial& none) const {
  if (models::is_on_road(set_.kind->traits) || !none.is_simulated) return true;
  const bool warms = set_.baseline == models::Baseline::kCombined;  // else much of every run is not simulated
  const bool is_single_unit = warms && tried.mistake < singles_ && !mistakes_[tried.mistake].is_exchange;
  const double odd = models::is_of_vehicle(set_.kind->traits) ? kOddOnRollers : 0.0;
  if (is_single_unit) return none.worst > odd && tried.squares <= kHalf * none.squares;
  return none.worst > kOdd && tried.squares <= kTenth * none.squares;
}

void Candidates::add_pairs(const std::function<bool(const Mistake&, std::size_t)>& tells) {
  std::vector<std::pair<std::size_t, std::size_t>> work;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (is_explained(r)) continue;
    for (const std::size_t first : find_first_of_two(r)) {
      for (std::size_t second = 0; second < singles_; ++second) {
        const bool is_exchange = mistakes_[first].is_exchange || mistakes_[second].is_exchange;
        const bool fits =
            !is_exchange && !have_common_column(mistakes_[first], mistakes_[second]) && tells(mistakes_[second], r);
        if (fits) work.emplace_back(r, find_pair(first, second));
      }
    }
  }
  std::sort(work.begin(), work.end());
  work.erase(std::unique(work.begin(), work.end()), work.end());
  const double sum = sum_weights({mistakes_.begin(), mistakes_.begin() + static_cast<std::ptrdiff_t>(singles_)});
  try_out(work, kTwoInOneRun / (0.5 * sum * sum));
}

bool Candidates::is_explained(std::size_t r) const {
  constexpr double kLikely = 5.0;  // natural logarithm
  const RunTrials& run = runs_[r];
  if (!models::is_on_road(set_.kind->traits)) {
    return run.none.worst <= kOdd ||
           std::any_of(run.mistaken.begin(), run.mistaken.end(), [](const Trial& one) { return one.worst <= kOdd; });
  }
  const double none = run.none.calc_log_likelihood({}, kSize);
  return std::none_of(run.mistaken.begin(), run.mistaken.end(),
                      [&](const Trial& one) { return one.calc_log_likelihood({}, kSize) > none + kLikely; });
}

std::vector<std::size_t> Candidates::find_first_of_two(std::size_t r) const {
  std::vector<std::pair<double, std::size_t>> singles;
  for (const Trial& one : runs_[r].mistaken) singles.emplace_back(-one.calc_log_likelihood({}, kSize), one.mistake);
  std::sort(singles.begin(), singles.end());
  std::vector<std::size_t> first;
  for (const auto& [log, mistake] : singles) {
    if (first.size() < kFirstOfTwo) first.push_back(mistake);
  }
  return first;
}

std::size_t Candidates::find_pair(std::size_t a, std::size_t b) {
  const std::pair<std::size_t, std::size_t> key{std::min(a, b), std::max(a, b)};
  const auto at = std::find(pairs_.begin(), pairs_.end(), key);
  const auto index = singles_ + static_cast<std::size_t>(at - pairs_.begin());
  if (at != pairs_.end()) return index;
  pairs_.push_back(key);
  mistakes_.push_back(combine(mistakes_[key.first], mistakes_[key.second]));
  return index;
}

}  // namespace rollrig::diagnosis
