// What a verdict without a gap is worth.
#include "diagnosis/findings/undetected.h"

#include <catch2/catch.hpp>

#include "tests/diagnosis/compared_set.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

TEST_CASE("an effect that the set shows is not hidden", "[fast]") {
  const tests::ComparedSet compared(
      tests::measure_on_drum({tests::act("bearing_warmup", 3.0)}, {tests::plan_skim_run()}),
      {"bearing_warmup", "torque_zero_drift"});
  CHECK(calc_nothing_detectable(compared.study, compared.comparison) < 0.01);
}

TEST_CASE(
    "without an effect it is nearly certain that nothing acts which the set would show, though not that nothing acts",
    "[fast]") {
  const tests::ComparedSet compared(tests::measure_on_drum({}, {tests::plan_skim_run()}),
                                    {"bearing_warmup", "torque_zero_drift"});
  const double hidden = calc_nothing_detectable(compared.study, compared.comparison);
  CHECK(hidden > compared.study.null.probability);
  CHECK(hidden > 0.99 * (1.0 - compared.comparison.unknown_probability));  // what is unknown counts as shown
  CHECK(hidden > 0.95);
  CHECK(hidden <= 1.0);
}
