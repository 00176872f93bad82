// What may act beside a cause.
#include "diagnosis/findings/partners.h"

#include <catch2/catch.hpp>

#include "tests/diagnosis/compared_set.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

TEST_CASE("a cause acts alone, or with one of its partners", "[fast]") {
  const tests::ComparedSet& compared = tests::bearings_or_zero();
  const Candidate& lead = compared.comparison.candidates.front();
  Cause cause;
  cause.effects = lead.fit.hypothesis.names();
  find_partners(compared.comparison, lead, cause);
  REQUIRE(cause.acts.has_value());
  CHECK(*cause.acts <= 1.0);
  CHECK(*cause.alone <= *cause.acts);
  CHECK(*cause.alone >= lead.probability);  // both signs
  CHECK(*cause.acts <= lead.probability + 1.0 - compared.study.null.probability);
  double sum = *cause.alone;
  for (const Partner& partner : cause.partners) {
    CHECK(std::count(cause.effects.begin(), cause.effects.end(), partner.effect) == 0);
    sum += partner.probability;
  }
  CHECK(sum <= *cause.acts + 1e-12);
  scale_probability(0.5, cause);
  CHECK(*cause.alone <= 0.5);
}
