#include "diagnosis/comparison/base_moves.h"

#include <catch2/catch.hpp>

#include "diagnosis/comparison/tire_beliefs.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/fit_study.h"

using Catch::Contains;
using namespace rollrig;

namespace {

/// Two runs whose tire file has another heat capacity than the tire, by that factor, and says that it knows it to 3 %.
measurements::MeasurementSet make_moved_set(double factor) {
  auto set = tests::add_noise(tests::make_gap_set({}, 2), 3);
  auto& thermal = set.tire.values.thermal;
  thermal.heat_capacity_J_per_K *= factor;
  set.tire.standard_uncertainties.thermal.heat_capacity_J_per_K = 0.03 * thermal.heat_capacity_J_per_K;
  return set;
}

}  // namespace

TEST_CASE("a number of the files that moves far is told of, with its size, and of right files none is", "[fast]") {
  const tests::FittedBaseline wrong(make_moved_set(0.75));
  CHECK_THAT(diagnosis::describe_far_moves(wrong, wrong.null.fit),
             Contains("thermal.heat_capacity_J_per_K by +") && Contains("standard uncertaint"));
  const tests::FittedBaseline right(make_moved_set(1.0));
  CHECK(diagnosis::describe_far_moves(right, right.null.fit).empty());
}

TEST_CASE("moves are listed from the largest down, with both values and where the uncertainty comes from", "[fast]") {
  const tests::FittedBaseline fitted(make_moved_set(0.75));
  const std::vector<BaseNumber> numbers = diagnosis::list_base_numbers(fitted, nullptr);
  REQUIRE(numbers.size() == fitted.base.size());
  const BaseNumber& first = numbers.front();
  CHECK(first.name == "thermal.heat_capacity_J_per_K");
  CHECK(first.sd_source == SdSource::kFile);
  CHECK(first.sd == Approx(0.03 * first.value));
  CHECK(first.recalibrated > 1.1 * first.value);  // towards the truth
  CHECK(first.moved_sd == Approx((first.recalibrated - first.value) / first.sd));
  CHECK_FALSE(first.with_cause.has_value());
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    CHECK(std::abs(numbers[i].moved_sd) <= std::abs(numbers[i - 1].moved_sd));
    CHECK(numbers[i].sd_source == SdSource::kUsual);
  }
}
