// Hypotheses that were screened and not fitted.
#include "diagnosis/comparison/unfitted.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/thresholds.h"
#include "sim/core/random.h"
#include "sim/core/units.h"
#include "tests/diagnosis/compared_set.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

/// Screened at the middle of its prior, where its signature has that size (in standard deviations) and score.
Screened make_screened(const char* effect, double detectability, double along) {
  const Term& term = find_term(effect);
  Eigen::VectorXd own = Eigen::VectorXd::Zero(to_index(term.parameters().size()));
  Screened screened{{&term, 1}, own};
  screened.detectability = detectability;
  screened.along = along;
  return screened;
}

}  // namespace

TEST_CASE("an effect that the set does not show is as likely after it as before", "[fast]") {
  CHECK(calc_bayes_factor(make_screened("bearing_warmup", 0.0, 0.0)) == 1.0);
  CHECK(calc_bayes_factor(make_screened("bearing_warmup", 1e-4, 0.0)) == Approx(1.0).epsilon(1e-6));
  Screened failed = make_screened("bearing_warmup", 5.0, 10.0);
  failed.was_simulated = false;
  CHECK(calc_bayes_factor(failed) == 1.0);
}

TEST_CASE("the Bayes factor is the mean likelihood ratio of sizes drawn from the prior", "[slow]") {
  for (const char* effect : {"bearing_warmup", "slow_leak", "speed_record"}) {
    const models::EffectParameter& size = find_term(effect).parameters().front();
    const double off_SI = size.off.value_or(0.0) * unit_of_key(size.key).factor;
    const double middle = from_prior_units(size, 0.0, 1).value_SI - off_SI;
    for (const auto& [detectability, along] : {std::pair{1.0, 1.5}, {0.5, -0.4}, {3.0, 4.0}}) {
      INFO(effect << " " << detectability << " " << along);
      RandomStream draws(7, effect);
      double sum = 0.0;
      int count = 0;
      for (int i = 0; i < 200000; ++i) {
        const PriorUnits drawn = from_prior_units(size, draws.normal(), 1);
        if (!drawn.allowed) continue;
        const double x = (drawn.value_SI - off_SI) / middle;
        sum += std::exp(x * along - 0.5 * x * x * detectability * detectability);
        ++count;
      }
      CHECK(calc_bayes_factor(make_screened(effect, detectability, along)) == Approx(sum / count).epsilon(0.01));
    }
  }
}

TEST_CASE("what would have shown and did not is unlikely beside a cause, what agrees is likely", "[fast]") {
  const double against = calc_bayes_factor(make_screened("slow_leak", 8.0, 0.0));
  const double for_it = calc_bayes_factor(make_screened("slow_leak", 8.0, 64.0));  // as its middle size would
  CHECK(against < 0.5);
  CHECK(for_it > 1e6);
}

namespace {

double sum_all(const tests::ComparedSet& compared) {
  double sum = compared.study.null.probability + compared.comparison.unknown_probability;
  for (const Candidate& candidate : compared.comparison.candidates) sum += candidate.probability;
  return sum + sum_probability(compared.comparison.unfitted);
}

}  // namespace

TEST_CASE("all hypotheses together, fitted or not, are certain", "[fast]") {
  CHECK(sum_all(tests::bearings_or_zero()) == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("what was not fitted is not among the fitted, nor there twice, nor likely by itself", "[fast]") {
  const tests::ComparedSet compared(
      tests::measure_on_drum({tests::act("bearing_warmup", 3.0)}, {tests::plan_skim_run()}),
      {"bearing_warmup", "torque_zero_drift", "torque_gain", "windage", "slow_leak"});
  CHECK(sum_all(compared) == Approx(1.0).epsilon(1e-9));
  const Comparison& comparison = compared.comparison;
  std::set<std::set<std::string>> seen;
  for (const Candidate& candidate : comparison.candidates) {
    const std::vector<std::string> names = candidate.fit.hypothesis.names();
    seen.insert({names.begin(), names.end()});
  }
  REQUIRE(!comparison.unfitted.empty());
  const StudySettings& settings = compared.study.settings;
  for (const Unfitted& one : comparison.unfitted) {
    CHECK(seen.insert({one.names.begin(), one.names.end()}).second);
    REQUIRE(one.names.size() >= 1);
    double largest = 0.0;  // of what is fitted with one effect less
    for (const Candidate& candidate : comparison.candidates) {
      if (candidate.fit.hypothesis.terms.size() + 1 == one.names.size()) {
        largest = std::max(largest, candidate.probability);
      }
    }
    if (one.names.size() == 1) largest = compared.study.null.probability;
    CHECK(one.probability <= 21.0 * settings.priors.singles / settings.priors.none * largest);
  }
}

TEST_CASE("what an error of a law gained counts for no further effect", "[fast]") {
  tests::ComparedSet compared(
      tests::measure_on_drum({tests::act("bearing_warmup"), tests::act("slow_leak", 2.0)}, {tests::plan_skim_run()}),
      {"bearing_warmup", "torque_zero_drift", "slow_leak", "load_cross_talk"});
  Comparison& comparison = compared.comparison;
  comparison.candidates.erase(std::remove_if(comparison.candidates.begin(), comparison.candidates.end(),
                                             [](const Candidate& one) { return one.fit.hypothesis.terms.size() > 1; }),
                              comparison.candidates.end());  // so that all pairs are unfitted
  for (Candidate& one : comparison.candidates) one.of_law_error = 0.0;
  const std::vector<Unfitted> exact = list_unfitted(compared.study, comparison);
  for (Candidate& one : comparison.candidates) one.of_law_error = one.probability;
  const std::vector<Unfitted> wrong = list_unfitted(compared.study, comparison);
  REQUIRE(exact.size() == wrong.size());
  const StudySettings& settings = compared.study.settings;
  const double odds = find_prior(settings, 2) / find_prior(settings, 1);
  std::size_t fewer = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    REQUIRE(exact[i].names == wrong[i].names);
    CHECK(wrong[i].probability <= exact[i].probability);
    double larger = 0.0;  // of the two fitted with one of its effects
    for (const Candidate& one : comparison.candidates) {
      if (wrong[i].contains(one.fit.hypothesis.names().front())) larger = std::max(larger, 2.0 * one.probability);
    }
    if (wrong[i].names.size() == 2) CHECK(wrong[i].probability <= odds * larger);  // both signs
    if (wrong[i].probability < exact[i].probability) ++fewer;
  }
  CHECK(fewer > 0);
}
