#include "diagnosis/checks/mistake_posterior.h"

#include <algorithm>
#include <cmath>

#include "sim/core/error.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kInAllRuns = 3e-2;  // Assumed

double add_all_logs(const std::vector<double>& logs) {
  const double largest = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - largest);
  return largest + std::log(sum);
}

}  // namespace

Posterior::Posterior(const Candidates& candidates) : candidates_(candidates), probability_(candidates.runs().size()) {
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
  if (!std::isfinite(total)) throw RunFailure("mistakes with columns and units have no finite probability in this set");
  for (const auto& [log, share] : parts) share(std::exp(log - total));
}

void Posterior::add_by_run(const CommonParts& common, double log, double size, Parts& parts) {
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

void Posterior::add_in_all(std::size_t mistake, Parts& parts) {
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

}  // namespace rollrig::diagnosis
