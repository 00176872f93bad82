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

TEST_CASE("hypotheses of one effect, and of two, gain what their priors gain", "[slow]") {
  const measurements::MeasurementSet set =
      tests::measure_on_drum({tests::act("bearing_warmup"), tests::act("slow_leak", 4.0)}, {tests::plan_skim_run()});
  const auto usual = find_odds(set, {});
  ComparisonPriors likelier;
  likelier.singles *= 3.0;
  likelier.look_alike *= 3.0;  // in proportion, so that it stays the same share of each
  const auto singles = find_odds(set, likelier);
  likelier = {};
  likelier.pairs *= 5.0;
  const auto pairs = find_odds(set, likelier);
  std::size_t of_two = 0;
  const auto count_effects = [](const std::string& name) { return std::count(name.begin(), name.end(), ' '); };
  std::string best_single;  // has a share of the pair's, as its second effect may be an error of a law
  for (const auto& [name, odds] : usual) {
    if (count_effects(name) == 1 && (best_single.empty() || odds > usual.at(best_single))) best_single = name;
  }
  for (const auto& [name, odds] : usual) {
    INFO(name);
    if (name == best_single) continue;
    const bool is_single = count_effects(name) == 1;
    of_two += is_single ? 0 : 1;
    CHECK(singles.at(name) / odds == Approx(is_single ? 3.0 : 1.0));
    CHECK(pairs.at(name) / odds == Approx(is_single ? 1.0 : 5.0));
  }
  CHECK(usual.size() - of_two >= 3);
  CHECK(of_two > 0);
}

TEST_CASE("a second effect that gains much acts, one that gains little may be an error of the first one's law",
          "[fast]") {
  constexpr double kFirst_nats = 1e5;  // of which a small error would gain as much as any second effect here
  const auto judge = [](double gain_nats) { return calc_law_error({gain_nats, gain_nats, kFirst_nats}); };
  CHECK(judge(200.0) < 1e-9);
  CHECK(judge(4.0) > 0.5);
  CHECK(judge(-3.0) == judge(0.0));
  double before = 1.0;
  for (double gain_nats = 0.0; gain_nats < 60.0; gain_nats += 2.0) {
    const double now = judge(gain_nats);
    CHECK(now > 0.0);
    CHECK(now < before);
    before = now;
  }
}

TEST_CASE("a second effect that gains nothing beside a loose law probably does not act", "[fast]") {
  constexpr double kFirst_nats = 5000.0;
  const double kept = calc_law_error({15.0, 14.0, kFirst_nats});
  const double lost = calc_law_error({15.0, 1.0, kFirst_nats});
  CHECK(kept < 0.1);
  CHECK(lost > 0.5);
  CHECK(calc_law_error({15.0, -5.0, kFirst_nats}) == calc_law_error({15.0, 0.0, kFirst_nats}));
}

TEST_CASE("the less the first effect gains, the less likely a second one is an error of its law", "[fast]") {
  const auto judge = [](double gain_nats, double first_nats) {
    return calc_law_error({gain_nats, gain_nats, first_nats});
  };
  constexpr double kSecond_nats = 4.0;
  double before = 0.0;
  for (const double first_nats : {4.0, 20.0, 100.0, 500.0, 2500.0}) {
    const double now = judge(kSecond_nats, first_nats);
    CHECK(now > before);
    before = now;
  }
  CHECK(judge(kSecond_nats, 20.0) < 0.2);    // an error of 45 %
  CHECK(judge(kSecond_nats, 1600.0) > 0.5);  // of 5 %
  CHECK(judge(kSecond_nats, -2.0) == judge(kSecond_nats, 1.0));
  CHECK(judge(0.0, 0.0) > 0.5);
}

TEST_CASE("a pair of which both effects are clear keeps its probability", "[fast]") {
  const tests::ComparedSet compared(
      tests::measure_on_drum({tests::act("bearing_warmup", 3.0), tests::act("slow_leak", 10.0)},
                             {tests::plan_skim_run()}),
      {"bearing_warmup", "rim_heat", "slow_leak"});
  double pair = 0.0;
  for (const Candidate& candidate : compared.comparison.candidates) {
    if (candidate.fit.hypothesis.names() == std::vector<std::string>{"bearing_warmup", "slow_leak"}) {
      pair += candidate.probability;
    }
  }
  CHECK(pair > 0.8);
}

TEST_CASE("what came from an error of the law is a part of a hypothesis", "[slow]") {
  const tests::ComparedSet compared(
      tests::measure_on_drum({tests::act("bearing_warmup", 2.0), tests::act("slow_leak", 5.0), tests::act("rim_heat")},
                             {tests::plan_skim_run()}),
      {"bearing_warmup", "rim_heat", "slow_leak", "torque_zero_drift", "gas_heat_transfer"});
  bool has_triple = false;
  for (const Candidate& one : compared.comparison.candidates) {
    CHECK(one.of_law_error >= 0.0);
    CHECK(one.of_law_error <= one.probability * (1.0 + 1e-12));
    has_triple = has_triple || one.fit.hypothesis.terms.size() == 3;
  }
  CHECK(has_triple);
  for (const Unfitted& one : compared.comparison.unfitted) CHECK(one.probability >= 0.0);
}
