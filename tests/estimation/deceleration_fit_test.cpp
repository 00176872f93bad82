// Deceleration at a speed against closed forms, with outliers, with a gap, with noise.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/drum_deceleration/deceleration_fit.h"
#include "sim/core/random.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using estimation::Coast;
using estimation::fit_deceleration;

namespace {

/// dv/dt = -(a + c v^2): v = k tan(u_0 - c k t), k = sqrt(a/c), from 25 m/s down.
constexpr double kA = 0.05;
constexpr double kC = 2e-4;
double calc_true(double v) { return kA + kC * v * v; }

Coast make_coast(double noise_m_s = 0.0, std::uint64_t seed = 1) {
  Coast coast;
  RandomStream random(seed, "noise");
  const double k = std::sqrt(kA / kC);
  const double u = std::atan(25.0 / k);
  for (double t = 0.0;; t += 0.3) {
    const double v = k * std::tan(u - kC * k * t);
    if (v < 1.0) break;
    coast.time_s.push_back(t);
    coast.smooth_m_s.push_back(v);
    coast.speed_m_s.push_back(v + noise_m_s * random.normal());
  }
  return coast;
}

}  // namespace

TEST_CASE("without noise the deceleration is that of the closed form", "[fast]") {
  const Coast coast = make_coast();
  for (const double v : {3.0, 6.0, 10.0, 18.0, 21.0}) {
    const auto fit = fit_deceleration(coast, v, 4.0, {});
    REQUIRE(fit.available);
    CHECK(fit.value_m_s2 == Approx(calc_true(v)).epsilon(1e-6));
  }
}

TEST_CASE("a range left out does not move it: the law carries over the gap", "[fast]") {
  const auto fit = fit_deceleration(make_coast(), 10.0, 4.0, {{9.0, 11.0}});
  REQUIRE(fit.available);
  CHECK(fit.value_m_s2 == Approx(calc_true(10.0)).epsilon(1e-6));
  CHECK(fit.rows < fit_deceleration(make_coast(), 10.0, 4.0, {}).rows);
}

TEST_CASE("a tenth of rows 3 % off leaves it within its interval", "[fast]") {
  Coast coast = make_coast(0.01);
  for (std::size_t i = 0; i < coast.speed_m_s.size(); i += 10) coast.speed_m_s[i] *= 0.97;
  for (const double v : {6.0, 10.0, 18.0}) {
    const auto fit = fit_deceleration(coast, v, 4.0, {});
    REQUIRE(fit.available);
    CHECK(std::abs(fit.value_m_s2 - calc_true(v)) < 3.5 * fit.sd_m_s2);
    CHECK(fit.sd_m_s2 < 0.01 * fit.value_m_s2);
  }
}

TEST_CASE("the standard deviation is that of the values over seeds", "[fast]") {
  constexpr int kSeeds = 300;
  int covered = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto fit = fit_deceleration(make_coast(0.05, static_cast<std::uint64_t>(seed)), 12.0, 4.0, {});
    REQUIRE(fit.available);
    if (std::abs(fit.value_m_s2 - calc_true(12.0)) < 1.96 * fit.sd_m_s2) ++covered;
  }
  INFO(covered << " of " << kSeeds);
  CHECK_FALSE(tests::is_rejected(covered, kSeeds, 0.95, 0.01));
}

TEST_CASE("a speed that the coast does not pass is not answered", "[fast]") {
  CHECK_FALSE(fit_deceleration(make_coast(), 26.0, 4.0, {}).available);
  CHECK_FALSE(fit_deceleration(make_coast(), 40.0, 4.0, {}).available);
  CHECK_FALSE(fit_deceleration(make_coast(), 40.0, 4.0, {}).why.empty());
}

TEST_CASE("few rows with noise converge", "[fast]") {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Coast fine = make_coast(0.02, seed);
    Coast coarse;
    for (std::size_t i = 0; i < fine.time_s.size(); i += 10) {
      coarse.time_s.push_back(fine.time_s[i]);
      coarse.smooth_m_s.push_back(fine.smooth_m_s[i]);
      coarse.speed_m_s.push_back(fine.speed_m_s[i]);
    }
    for (const double v : {8.0, 12.0, 16.0}) {
      INFO("seed " << seed << ", " << v << " m/s");
      CHECK(fit_deceleration(coarse, v, 4.0, {}).why.empty());
    }
  }
}
