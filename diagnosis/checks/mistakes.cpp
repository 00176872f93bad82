#include "diagnosis/checks/mistakes.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/checks/mistake_posterior.h"
#include "diagnosis/checks/mistake_trials.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasurementSet;

constexpr double kNamed = 0.9;  // Assumed

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
  text += ", or " + fmt::format("{}", fmt::join(others, ", or "));
  return found.probability < kNamed ? text + ", which this set cannot separate" : text;
}

}  // namespace rollrig::diagnosis
