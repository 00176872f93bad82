#include "diagnosis/checks/mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "diagnosis/checks/mistake_evidence.h"
#include "sim/core/error.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

// Assumed.
constexpr double kInOneRun = 1e-2;
constexpr double kTwoInOneRun = 1e-5;
constexpr double kInAllRuns = 3e-2;
constexpr double kNamed = 0.9;
constexpr double kPlausible = 1.0;      // tolerances
constexpr double kOdd = 0.3;            // tolerances
constexpr double kOddOnRollers = 0.15;  // likewise, of wrong units where all of a drive is compared
constexpr double kHalf = 0.5;           // of the sum of squares
constexpr double kTenth = 0.1;          // likewise, of exchanged columns and of two mistakes
constexpr std::size_t kFirstOfTwo = 6;  // single mistakes that a second one is tried with

/// A hypothesis on one run: nothing mistaken, or a mistake undone.
struct Trial {
  std::size_t mistake = 0;  // index
  double log_prior = 0.0;
  RunProducts products;
  double of_given = 0.0;  // logarithm of the likelihood of the given columns
  double worst = kLargestMisfit;
  double squares = 0.0;  // of the misfit
  bool is_simulated = false;
  bool is_plausible = false;
  bool is_far_better = true;  // than the run as it is

  bool is_possible() const { return is_simulated && is_far_better && is_plausible; }
  double calc_log_likelihood(const CommonParts& common, double size) const {
    constexpr double kRuledOut = -1e9;
    return is_simulated ? of_given + diagnosis::calc_log_likelihood(products, common, size) : kRuledOut;
  }
};

/// A run as it is, which lies further off than any other where it cannot be simulated, and with mistakes undone.
struct RunTrials {
  Trial none;
  std::vector<Trial> mistaken;
};

Trial judge_run(const MeasurementSet& set, std::size_t r, const MeasuredRun& run,
                const sim::Recording<double>& simulated) {
  Trial trial;
  const ComparedRows rows = choose_rows(set, set.runs[r]);
  trial.products = calc_products(set, run, simulated, rows);
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

/// What the scatter of a measured column tells of its unit: numbers that are too small scatter less than their sensor.
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

/// Every run as it is, and where it needs a look with each mistake undone.
class Candidates {
 public:
  Candidates(const MeasurementSet& set, const BaselineRuns& baseline, int threads,
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

  const std::vector<RunTrials>& runs() const { return runs_; }
  const std::vector<Mistake>& mistakes() const { return mistakes_; }
  std::size_t single_count() const { return singles_; }

 private:
  void judge_as_it_is(std::size_t r) {
    if (baseline_.misfits[r].failure.empty()) runs_[r].none = judge_run(set_, r, set_.runs[r], baseline_.recordings[r]);
    runs_[r].none.log_prior = std::log(1.0 - kInOneRun);
  }

  /// Whether a run is so near to its simulation that no mistake could be that small. On the road noise hides it.
  bool is_near(std::size_t r) const {
    constexpr double kNear = 0.1;  // tolerances
    return !models::is_on_road(set_.kind->traits) && runs_[r].none.is_simulated && runs_[r].none.worst < kNear;
  }

  void try_out(const std::vector<std::pair<std::size_t, std::size_t>>& work, double prior_of_weight) {
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

  /// Whether a mistake undone takes enough of the misfit, where effects show far above the noise.
  bool is_far_better(const Trial& tried, const Trial& none) const {
    if (models::is_on_road(set_.kind->traits) || !none.is_simulated) return true;
    const bool warms = set_.baseline == models::Baseline::kCombined;  // else much of every run is not simulated
    const bool is_single_unit = warms && tried.mistake < singles_ && !mistakes_[tried.mistake].is_exchange;
    const double odd = models::is_of_vehicle(set_.kind->traits) ? kOddOnRollers : 0.0;
    if (is_single_unit) return none.worst > odd && tried.squares <= kHalf * none.squares;
    return none.worst > kOdd && tried.squares <= kTenth * none.squares;
  }

  /// Two wrong units in runs that one mistake alone does not explain.
  void add_pairs(const std::function<bool(const Mistake&, std::size_t)>& tells) {
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

  /// On the road noise hides much: there a run in which any mistake is likely is tried with two.
  bool is_explained(std::size_t r) const {
    constexpr double kSize = 0.25;
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

  /// The single mistakes without which a run agrees best.
  std::vector<std::size_t> find_first_of_two(std::size_t r) const {
    constexpr double kSize = 0.25;
    std::vector<std::pair<double, std::size_t>> singles;
    for (const Trial& one : runs_[r].mistaken) singles.emplace_back(-one.calc_log_likelihood({}, kSize), one.mistake);
    std::sort(singles.begin(), singles.end());
    std::vector<std::size_t> first;
    for (const auto& [log, mistake] : singles) {
      if (first.size() < kFirstOfTwo) first.push_back(mistake);
    }
    return first;
  }

  /// Index of two mistakes, which are added to the list where they are not in it.
  std::size_t find_pair(std::size_t a, std::size_t b) {
    const std::pair<std::size_t, std::size_t> key{std::min(a, b), std::max(a, b)};
    const auto at = std::find(pairs_.begin(), pairs_.end(), key);
    const auto index = singles_ + static_cast<std::size_t>(at - pairs_.begin());
    if (at != pairs_.end()) return index;
    pairs_.push_back(key);
    mistakes_.push_back(combine(mistakes_[key.first], mistakes_[key.second]));
    return index;
  }

  const MeasurementSet& set_;
  const BaselineRuns& baseline_;
  int threads_;
  std::vector<Mistake> mistakes_;
  std::size_t singles_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  std::vector<RunTrials> runs_;
};

double add_all_logs(const std::vector<double>& logs) {
  const double largest = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - largest);
  return largest + std::log(sum);
}

/// Probabilities of the mistakes in each run; what is missing to 1 is that nothing was mistaken. Summed over the
/// unknown size, and over whether the runs have parts in common.
class Posterior {
 public:
  explicit Posterior(const Candidates& candidates) : candidates_(candidates), probability_(candidates.runs().size()) {
    std::vector<const RunProducts*> as_they_are;
    for (const RunTrials& run : candidates_.runs()) {
      if (run.none.is_simulated) as_they_are.push_back(&run.none.products);
    }
    const CommonParts common = fit_common(as_they_are);
    Parts parts;
    for (std::size_t i = 0; i < kUnknownSizes.size(); ++i) {
      add_by_run({}, std::log(kSizeWeights[i]), kUnknownSizes[i], parts);
      if (!common.empty()) {
        const double prior = calc_common_log_prior(common, *as_they_are.front(), kUnknownSizes[i]);
        add_by_run(common, std::log(kSizeWeights[i]) + prior, kUnknownSizes[i], parts);
      }
    }
    for (std::size_t m = 0; m < candidates_.single_count(); ++m) add_in_all(m, parts);
    std::vector<double> logs;
    for (const auto& [log, share] : parts) logs.push_back(log);
    const double total = add_all_logs(logs);
    for (const auto& [log, share] : parts) share(std::exp(log - total));
  }

  /// By the index of the mistake.
  const std::map<std::size_t, double>& of_run(std::size_t r) const { return probability_[r]; }

 private:
  /// Logarithms, and what gets their share.
  using Parts = std::vector<std::pair<double, std::function<void(double)>>>;

  /// In each run nothing, one mistake or two, whatever it was in the other runs.
  void add_by_run(const CommonParts& common, double log, double size, Parts& parts) {
    std::vector<std::map<std::size_t, double>> shares(candidates_.runs().size());
    for (std::size_t r = 0; r < shares.size(); ++r) {
      const RunTrials& run = candidates_.runs()[r];
      std::vector<double> logs{run.none.log_prior + run.none.calc_log_likelihood(common, size)};
      std::vector<std::size_t> mistakes;
      for (const Trial& one : run.mistaken) {
        if (!one.is_possible()) continue;
        logs.push_back(one.log_prior + one.calc_log_likelihood(common, size));
        mistakes.push_back(one.mistake);
      }
      const double of_run = add_all_logs(logs);
      log += of_run;
      for (std::size_t k = 0; k < mistakes.size(); ++k) shares[r][mistakes[k]] += std::exp(logs[k + 1] - of_run);
    }
    parts.emplace_back(log, [this, shares](double share) {
      for (std::size_t r = 0; r < shares.size(); ++r) {
        for (const auto& [mistake, of_run] : shares[r]) probability_[r][mistake] += share * of_run;
      }
    });
  }

  /// The same mistake in all runs.
  void add_in_all(std::size_t mistake, Parts& parts) {
    std::vector<const Trial*> trials;
    std::vector<const RunProducts*> products;
    for (const RunTrials& run : candidates_.runs()) {
      const auto at = std::find_if(run.mistaken.begin(), run.mistaken.end(),
                                   [mistake](const Trial& one) { return one.mistake == mistake; });
      if (at == run.mistaken.end() || !at->is_possible()) return;
      trials.push_back(&*at);
      products.push_back(&at->products);
    }
    double weights = 0.0;
    for (std::size_t m = 0; m < candidates_.single_count(); ++m) weights += candidates_.mistakes()[m].weight;
    const double prior = std::log(kInAllRuns * candidates_.mistakes()[mistake].weight / weights);
    const CommonParts common = fit_common(products);
    for (std::size_t i = 0; i < kUnknownSizes.size(); ++i) {
      double alone = prior + std::log(kSizeWeights[i]);
      double together = alone + calc_common_log_prior(common, *products.front(), kUnknownSizes[i]);
      for (const Trial* trial : trials) {
        alone += trial->calc_log_likelihood({}, kUnknownSizes[i]);
        if (!common.empty()) together += trial->calc_log_likelihood(common, kUnknownSizes[i]);
      }
      const auto take = [this, mistake](double share) {
        for (auto& of_run : probability_) of_run[mistake] += share;
      };
      parts.emplace_back(alone, take);
      if (!common.empty()) parts.emplace_back(together, take);
    }
  }

  const Candidates& candidates_;
  std::vector<std::map<std::size_t, double>> probability_;
};

std::string show_percent(double probability) {
  return probability > 0.99 ? "over 99 %" : fmt::format("{:.0f} %", 100.0 * probability);
}

}  // namespace

std::vector<FoundMistake> find_mistakes(const MeasurementSet& set, const BaselineRuns& baseline, int threads,
                                        const std::function<bool(const Mistake&, std::size_t)>& tells) {
  constexpr double kWorthNaming = 0.02;
  const Candidates candidates(set, baseline, threads, tells);
  const Posterior posterior(candidates);
  std::vector<FoundMistake> found;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    std::vector<std::pair<double, std::size_t>> likeliest;
    double sum = 0.0;
    for (const auto& [mistake, probability] : posterior.of_run(r)) {
      likeliest.emplace_back(probability, mistake);
      sum += probability;
    }
    if (sum < kNamed) continue;
    std::sort(likeliest.rbegin(), likeliest.rend());
    const Mistake& mistake = candidates.mistakes()[likeliest.front().second];
    const double probability = likeliest.front().first;
    auto same = std::find_if(found.begin(), found.end(),
                             [&](const FoundMistake& one) { return one.mistake.text == mistake.text; });
    if (same == found.end()) same = found.insert(found.end(), {mistake, {}, probability, {}});
    same->runs.push_back(r);
    if (probability > same->probability && same->runs.size() > 1) continue;
    same->probability = probability;
    same->instead.clear();
    for (std::size_t i = 1; i < likeliest.size() && likeliest[i].first > kWorthNaming; ++i) {
      same->instead.emplace_back(candidates.mistakes()[likeliest[i].second].text, likeliest[i].first);
    }
  }
  return found;
}

std::string describe(const MeasurementSet& set, const FoundMistake& found) {
  std::string text = fmt::format("in {} it looks as if {} (probability {})", name_runs(set, found.runs),
                                 found.mistake.text, show_percent(found.probability));
  if (found.instead.empty()) return text;
  std::vector<std::string> others;
  for (const auto& [other, probability] : found.instead) {
    others.push_back(fmt::format("{} ({})", other, show_percent(probability)));
  }
  return text + ", or " + fmt::format("{}", fmt::join(others, ", or "));
}

}  // namespace rollrig::diagnosis
