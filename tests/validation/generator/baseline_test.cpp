// The independent generator without an effect against rollrig's baseline: other equations of the same physics.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <iostream>

#include "tests/validation/generator/generated_set.h"

using namespace rollrig;
using namespace rollrig::tests;

namespace {

/// Makes sets of a kind without effect and noise, checks the bar and prints how far they are from the baseline.
void check_kind(const std::string& options, int seeds) {
  Floors worst;
  Floors mean;
  for (int seed = 1; seed <= seeds; ++seed) {
    const GeneratedSet made =
        make_generated_set(fmt::format("{} --effect none --noise-free --nominal-base --seed {}", options, seed));
    for (const auto& [channel, floors] : compare_with_baseline(made.set)) {
      INFO(options << ", seed " << seed << ", " << channel);
      CHECK(floors <= 0.2);
      worst[channel] = std::max(worst[channel], floors);
      mean[channel] += floors / seeds;
    }
  }
  for (const auto& [channel, floors] : worst) {
    std::cout << fmt::format("{:<36} {:<24} {:.4f} noise floors rms in the mean over sets, {:.4f} in the worst\n",
                             options, channel, mean[channel], floors);
    CHECK(floors > 1e-9);  // it is not the same program
  }
}

}  // namespace

TEST_CASE("without effect and noise a drum set is within 0.2 noise floors of the baseline", "[slow]") {
  check_kind("--kind drum", 12);
}

TEST_CASE("without effect and noise a flat-belt set is within 0.2 noise floors of the baseline", "[slow]") {
  check_kind("--kind flat_belt", 6);
}

TEST_CASE("without effect and noise a dyno set is within 0.2 noise floors of the baseline", "[slow]") {
  check_kind("--kind dyno", 6);
}

TEST_CASE("without effect and noise a road set is within 0.2 noise floors of the baseline", "[slow]") {
  check_kind("--kind road --baseline combined", 6);
  check_kind("--kind road --baseline constant_rrc", 6);
}
