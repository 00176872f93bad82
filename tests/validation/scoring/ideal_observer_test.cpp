// What nobody can name: chances of an ideal observer.
#include "validation/scoring/score.h"

#include <catch2/catch.hpp>

#include "tests/validation/scoring/hand_made_cases.h"

using namespace rollrig;
using namespace rollrig::tests;
using validation::Case, validation::is_pair_named_by_ideal;

namespace {

std::optional<double> bound_of(const std::vector<Case>& cases, const std::string& id) {
  for (const validation::Figure& figure : validation::find_figures(cases, {})) {
    if (figure.id == id) return figure.upper_bound;
  }
  FAIL("no figure " << id);
  return std::nullopt;
}

Case seen(std::vector<std::string> effects, double d_prime, std::vector<double> log_bayes_factors) {
  Case one = say_no_gap(make_case("0001", std::move(effects)));
  one.d_prime = d_prime;
  one.identifiable = std::all_of(log_bayes_factors.begin(), log_bayes_factors.end(), [](double n) { return n >= 3.0; });
  one.log_bayes_factors = std::move(log_bayes_factors);
  return one;
}

}  // namespace

TEST_CASE("a bound stands where all cases of a figure have what it needs", "[fast]") {
  const Case told = seen({"rim_heat"}, 20.0, {30.0, 100.0, 40.0});
  const Case alike = seen({"windage"}, 20.0, {1.0, 1.0, 1.0, 200.0});  // three others look like it
  const Case faint = seen({"slow_leak"}, 0.5, std::vector<double>(33, 0.1));
  const Case pair = seen({"windage", "rim_heat"}, 20.0, {30.0, 1.0});
  CHECK(*bound_of({told, alike}, "top1_set_aware") == Approx(0.5));
  CHECK(*bound_of({told, faint}, "top1_set_aware") == Approx(1.0));  // what cannot be detected is not asked for
  CHECK(*bound_of({told, pair}, "pairs") == 0.0);
  CHECK(*bound_of({pair, seen({"windage", "rim_heat"}, 20.0, {30.0, 9.0})}, "pairs") == 0.5);
  CHECK(*bound_of({seen({"windage"}, 5.0, {9.0})}, "detection") == Approx(0.9963).margin(1e-4));
  CHECK(*bound_of({told, alike}, "detection") == Approx(1.0));
  Case detected = told;
  detected.log_bayes_factors.clear();  // of rollrig_validation upper-bound --detection
  CHECK_FALSE(bound_of({alike, detected}, "top1_set_aware").has_value());
  CHECK(bound_of({alike, detected}, "detection").has_value());
  CHECK_FALSE(bound_of({say_no_gap(make_case("0001", {"rim_heat"}))}, "detection").has_value());
}

TEST_CASE("an ideal observer names a pair whose second effect makes up for its smaller prior", "[fast]") {
  const auto is_named = [](double nats, std::size_t effects) {
    std::vector<double> log_bayes_factors(effects, 200.0);
    log_bayes_factors.front() = nats;
    return is_pair_named_by_ideal(seen({"windage", "rim_heat"}, 20.0, log_bayes_factors));
  };
  CHECK_FALSE(*is_named(3.5, 30));  // can be told from all single effects, and is too rare
  CHECK(*is_named(6.0, 30));
  const auto find_least = [&](std::size_t effects) {
    double nats = 0.0;
    while (!*is_named(nats, effects)) nats += 0.01;
    return nats;
  };
  CHECK(find_least(60) > find_least(20) + 0.9);  // a third of the prior: ln 3 and a little more
  CHECK(find_least(60) < find_least(20) + 1.5);
  CHECK_FALSE(is_pair_named_by_ideal(seen({"windage"}, 20.0, {9.0, 9.0})).has_value());
  CHECK_FALSE(is_pair_named_by_ideal(seen({"windage", "rim_heat"}, 20.0, {})).has_value());
}
