// What the probabilities of a comparison owe to those before the measurement.
#include "diagnosis/comparison/model_comparison.h"

#include <catch2/catch.hpp>
#include <map>

#include "tests/diagnosis/compared_set.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

/// Odds of each hypothesis against the baseline, by its name and the signs of its effects.
std::map<std::string, double> find_odds(const measurements::MeasurementSet& set, const ComparisonPriors& priors) {
  StudySettings settings;
  for (const char* id : {"bearing_warmup", "rim_heat", "slow_leak"}) settings.terms.push_back(&find_term(id));
  settings.priors = priors;
  Study study(set, settings);
  std::map<std::string, double> odds;
  for (const Candidate& candidate : compare_models(study).candidates) {
    std::string name;
    for (const SignedTerm& one : candidate.fit.hypothesis.terms) {
      name += std::string(one.sign > 0 ? "+" : "-") + one.term->name() + " ";
    }
    odds[name] = candidate.probability / study.null.probability;
  }
  return odds;
}

}  // namespace

TEST_CASE("hypotheses of one effect, and of two, gain what their priors gain", "[fast]") {
  const measurements::MeasurementSet set =
      tests::measure_on_drum({tests::act("bearing_warmup"), tests::act("slow_leak")}, {tests::plan_skim_run()});
  const auto usual = find_odds(set, {});
  ComparisonPriors likelier;
  likelier.singles *= 3.0;
  likelier.look_alike *= 3.0;  // in proportion, so that it stays the same share of each
  const auto singles = find_odds(set, likelier);
  likelier = {};
  likelier.pairs *= 5.0;
  const auto pairs = find_odds(set, likelier);
  std::size_t of_two = 0;
  for (const auto& [name, odds] : usual) {
    INFO(name);
    const bool is_single = std::count(name.begin(), name.end(), ' ') == 1;
    of_two += is_single ? 0 : 1;
    CHECK(singles.at(name) / odds == Approx(is_single ? 3.0 : 1.0));
    CHECK(pairs.at(name) / odds == Approx(is_single ? 1.0 : 5.0));
  }
  CHECK(usual.size() - of_two >= 3);
  CHECK(of_two > 0);
}
