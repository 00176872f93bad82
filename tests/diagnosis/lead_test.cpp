// Which hypothesis the first cause is named after, and what is named beside it.
#include "diagnosis/findings/lead.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "diagnosis/findings/verdict.h"
#include "tests/diagnosis/compared_set.h"

using rollrig::diagnosis::find_named_beside;
using Ids = std::vector<std::string>;

TEST_CASE("a short set is named whole, however unlikely its last", "[fast]") {
  CHECK(find_named_beside({"rim_heat"}, 0.97, {{"slow_leak", 0.01}, {"flat_spot", 0.02}}) ==
        Ids{"flat_spot", "slow_leak"});
}

TEST_CASE("of a long set the unlikeliest are left out, up to a tenth of it", "[fast]") {
  CHECK(find_named_beside({"a"}, 0.60, {{"b", 0.25}, {"c", 0.06}, {"d", 0.04}, {"e", 0.05}}) == Ids{"b", "c"});
  SECTION("not more, so that it stays long and names nothing") {
    CHECK(find_named_beside({"a"}, 0.40, {{"b", 0.20}, {"c", 0.20}, {"d", 0.20}}).size() == 3);
    CHECK(find_named_beside({"a"}, 0.50, {{"b", 0.20}, {"c", 0.14}, {"d", 0.09}, {"e", 0.07}}).size() == 3);
  }
  SECTION("two effects of the lead count as two") {
    CHECK(find_named_beside({"a", "b"}, 0.90, {{"c", 0.07}, {"d", 0.03}}) == Ids{"c"});
  }
  SECTION("the lead is never left out") { CHECK(find_named_beside({"a", "b", "c", "d"}, 1.0, {}).empty()); }
}

TEST_CASE("the lead's own effects are not named beside it", "[fast]") {
  CHECK(find_named_beside({"a", "b"}, 0.9, {{"a", 0.05}, {"c", 0.05}}) == Ids{"c"});
}

namespace {

using rollrig::tests::act;
using rollrig::tests::ComparedSet;

/// A leak that is certain, and a torque that changes as bearings warm: the torque's zero could drift as well.
ComparedSet compare_leak_and_bearings() {
  return {rollrig::tests::measure_on_drum({act("bearing_warmup"), act("slow_leak", 10.0)},
                                          {rollrig::tests::plan_skim_run()}),
          {"bearing_warmup", "slow_leak", "torque_zero_drift"}};
}

/// What is named where only these hypotheses have a probability.
std::vector<rollrig::diagnosis::Cause> find_causes_of(ComparedSet& compared, double leak, double with_bearings,
                                                      double with_zero_drift) {
  const std::map<Ids, double> given{{{"slow_leak"}, leak},
                                    {{"bearing_warmup", "slow_leak"}, with_bearings},
                                    {{"slow_leak", "torque_zero_drift"}, with_zero_drift}};
  std::set<Ids> done;  // one sign of each
  for (rollrig::diagnosis::Candidate& one : compared.comparison.candidates) {
    Ids names = one.fit.hypothesis.names();
    std::sort(names.begin(), names.end());
    const bool is_given = given.count(names) > 0 && done.insert(names).second;
    one.probability = is_given ? given.at(names) : 0.0;
    one.discrepancy_probability = 0.0;
  }
  REQUIRE(done.size() == given.size());
  compared.comparison.unfitted.clear();
  return rollrig::diagnosis::find_causes(compared.study, compared.comparison);
}

Ids list_named(const rollrig::diagnosis::Cause& cause) {
  Ids named = cause.effects;
  named.insert(named.end(), cause.indistinguishable_from.begin(), cause.indistinguishable_from.end());
  std::sort(named.begin(), named.end());
  return named;
}

}  // namespace

TEST_CASE("a second effect is named where one is likely to act, even if the set cannot tell which", "[fast]") {
  static ComparedSet compared = compare_leak_and_bearings();
  const Ids all{"bearing_warmup", "slow_leak", "torque_zero_drift"};
  SECTION("the likeliest hypothesis has it") {
    const rollrig::diagnosis::Cause cause = find_causes_of(compared, 0.30, 0.38, 0.32).front();
    CHECK(cause.effects.size() == 2);
    CHECK(list_named(cause) == all);
    CHECK(cause.complete == Approx(0.70));
  }
  SECTION("the likeliest hypothesis has the first effect alone") {
    const auto causes = find_causes_of(compared, 0.40, 0.32, 0.28);
    CHECK(causes.front().effects.size() == 2);
    CHECK(list_named(causes.front()) == all);
    CHECK(causes.front().complete == Approx(0.60));
    const auto alone = std::find_if(causes.begin(), causes.end(), [](const rollrig::diagnosis::Cause& cause) {
      return cause.effects == Ids{"slow_leak"};
    });
    REQUIRE(alone != causes.end());
    CHECK(alone->probability == Approx(0.40));
  }
  SECTION("no second effect is likely") {
    const rollrig::diagnosis::Cause cause = find_causes_of(compared, 0.54, 0.24, 0.22).front();
    CHECK(cause.effects == Ids{"slow_leak"});
    CHECK(cause.complete == Approx(0.54));
    CHECK(cause.partners.size() == 2);
  }
  SECTION("effects that were not fitted may act as well") {
    find_causes_of(compared, 0.30, 0.38, 0.32);
    compared.comparison.unfitted = {{{"slow_leak", "windage"}, 1.5}};  // against 0.7 with one of the two
    const auto causes = rollrig::diagnosis::find_causes(compared.study, compared.comparison);
    CHECK(causes.front().effects == Ids{"slow_leak"});
  }
  SECTION("an unknown cause is certain beside each hypothesis") {
    find_causes_of(compared, 0.0, 0.0, 0.0);
    for (rollrig::diagnosis::Candidate& one : compared.comparison.candidates) {
      if (one.fit.hypothesis.names() == Ids{"slow_leak"}) one.discrepancy_probability = 1.0;
    }
    const auto causes = rollrig::diagnosis::find_causes(compared.study, compared.comparison);
    CHECK(causes.front().effects == Ids{"slow_leak"});
  }
}
