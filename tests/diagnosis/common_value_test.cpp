#include "diagnosis/findings/common_value.h"

#include <catch2/catch.hpp>
#include <cmath>

using rollrig::diagnosis::find_common_value;

TEST_CASE("two estimates d apart on either side differ by chance as often as a normal error is beyond d", "[fast]") {
  for (const double d : {0.3, 1.0, 2.5}) {
    const auto common = find_common_value({{4.0 - d, 2.0}, {4.0 + d, 2.0}});
    CHECK(common.mean == Approx(4.0));
    CHECK(common.sd == Approx(1.0));
    CHECK(common.chance == Approx(std::erfc(d / std::sqrt(2.0))));  // d in units of the mean's sd
  }
}

TEST_CASE("three estimates have two degrees of freedom, whose chance falls as exp(-chi2/2)", "[fast]") {
  const auto common = find_common_value({{1.0, 0.25}, {2.0, 0.5}, {5.0, 4.0}});
  CHECK(common.mean == Approx((4.0 * 1.0 + 2.0 * 2.0 + 0.25 * 5.0) / 6.25));
  const double chi2 = 4.0 * std::pow(1.0 - common.mean, 2) + 2.0 * std::pow(2.0 - common.mean, 2) +
                      0.25 * std::pow(5.0 - common.mean, 2);
  CHECK(common.chance == Approx(std::exp(-0.5 * chi2)));
}

TEST_CASE("a single estimate is of one value", "[fast]") {
  const auto common = find_common_value({{3.0, 0.04}});
  CHECK(common.mean == Approx(3.0));
  CHECK(common.sd == Approx(0.2));
  CHECK(common.chance == 1.0);
}
