#include <catch2/catch.hpp>

#include "diagnosis/checks/set_checks.h"
#include "tests/support/drum_sets.h"
#include "tests/support/machines.h"

using Catch::Contains;
using namespace rollrig;

namespace {

/// What is warned of when the tire's own loss in its file is a multiple of that of the tire that ran.
std::string find_warnings(double factor) {
  measurements::MeasurementSet set = tests::simulate_campaign(tests::make_short_campaign());
  set.tire.values.rolling_resistance.A0_N *= factor;
  set.tire.values.rolling_resistance.A1_N_s_per_m *= factor;
  std::string text;
  for (const std::string& warning : diagnosis::check_set(set, 1).warnings) text += warning + "\n";
  return text;
}

}  // namespace

TEST_CASE("a tire that loses far more or less than its file says is warned of, with the share", "[fast]") {
  CHECK_THAT(find_warnings(0.8), Contains("the tire's loss under load is 2") && Contains("% above that of its file"));
  CHECK_THAT(find_warnings(1.3), Contains("the tire's loss under load is 1") && Contains("% below that of its file"));
  CHECK_THAT(find_warnings(1.05), !Contains("the tire's loss under load"));
}
