// The foreign generator without an effect against rollrig's baseline: other equations of the same physics.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <iostream>

#include "tests/blind/blind_fixture.h"

using namespace rollrig;
using namespace rollrig::tests;

TEST_CASE("without effect and noise the foreign generator is within 0.2 noise floors of the baseline", "[fast]") {
  constexpr int kSeeds = 12;
  Floors worst;
  Floors mean;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const BlindSet made = make_blind_set(fmt::format("--effect none --noise-free --nominal-base --seed {}", seed));
    for (const auto& [channel, floors] : compare_with_baseline(made.set)) {
      INFO("seed " << seed << ", " << channel);
      CHECK(floors <= 0.2);
      worst[channel] = std::max(worst[channel], floors);
      mean[channel] += floors / kSeeds;
    }
  }
  for (const auto& [channel, floors] : worst) {
    std::cout << fmt::format("{:<24} {:.3f} noise floors rms in the mean over sets, {:.3f} in the worst\n", channel,
                             mean[channel], floors);
    CHECK(floors > 1e-6);  // it is not the same program
  }
}
