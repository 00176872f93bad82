// The uncertainty of a difference: what both results share cancels, what each has of its own adds up.
#include "comparison/budget_difference.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using rollrig::Json;
using rollrig::comparison::calc_difference_uncertainty;
using rollrig::comparison::DifferenceUncertainty;
using rollrig::comparison::SharedInputs;

namespace {

Json make_line(const char* name, double signed_contribution, const char* type = "B", Json freedom = nullptr) {
  return {{"name", name},
          {"key", "x"},
          {"type", type},
          {"sensitivity", signed_contribution < 0.0 ? -1.0 : 1.0},
          {"contribution", std::abs(signed_contribution)},
          {"degrees_of_freedom", freedom}};
}

Json make_budget(std::vector<Json> lines) { return {{"contributions", std::move(lines)}}; }

const SharedInputs kOneMachine{false, true, false};
const SharedInputs kTwoMachines{false, false, false};

}  // namespace

TEST_CASE("a gain of one machine cancels but for what the results depend on it by, noise does not", "[fast]") {
  const Json a = make_budget({make_line("gain", 0.30), make_line("noise and drift", 0.04)});
  const Json b = make_budget({make_line("gain", 0.33), make_line("noise and drift", 0.03)});
  CHECK(calc_difference_uncertainty(a, b, kOneMachine).sd == Approx(std::hypot(0.03, 0.05)));
  CHECK(calc_difference_uncertainty(a, b, kTwoMachines).sd == Approx(std::sqrt(0.09 + 0.33 * 0.33 + 0.0025)));
}

TEST_CASE("a common error that moves two results apart counts with both", "[fast]") {
  const Json a = make_budget({make_line("temperature", 0.1)});
  const Json b = make_budget({make_line("temperature", -0.1)});
  CHECK(calc_difference_uncertainty(a, b, kOneMachine).sd == Approx(0.2));
}

TEST_CASE("copies of one run do not differ, and surely so", "[fast]") {
  const Json a = make_budget({make_line("gain", 0.3), make_line("scatter", 0.1, "A", 5.0)});
  CHECK(calc_difference_uncertainty(a, a, {true, true, true}).sd == 0.0);
}

TEST_CASE("an input of one budget alone is independent", "[fast]") {
  const Json a = make_budget({make_line("gain", 0.3)});
  const Json b = make_budget({make_line("gain", 0.3), make_line("angle", 0.4)});
  CHECK(calc_difference_uncertainty(a, b, kOneMachine).sd == Approx(0.4));
}

// t_0.975 of 10 degrees of freedom: two equal scatters of 5 each (Welch-Satterthwaite).
TEST_CASE("degrees of freedom of two scatters add up", "[fast]") {
  const Json a = make_budget({make_line("scatter", 0.1, "A", 5.0)});
  CHECK(calc_difference_uncertainty(a, a, kOneMachine).coverage_factor == Approx(2.2281).epsilon(1e-4));
}

// y = g (1 + e): a gain that both share, errors of each. 20,000 trials know the share to 0.0015.
TEST_CASE("intervals of differences hold the true difference in 95 % of simulated tests", "[fast]") {
  constexpr double kA = 30.0, kB = 36.0, kGain = 0.01, kNoise = 0.004;
  const Json a = make_budget({make_line("gain", kA * kGain), make_line("noise", kA * kNoise)});
  const Json b = make_budget({make_line("gain", kB * kGain), make_line("noise", kB * kNoise)});
  const DifferenceUncertainty found = calc_difference_uncertainty(a, b, kOneMachine);
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  int held = 0;
  constexpr int kTrials = 20000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double gain = 1.0 + kGain * normal(random);
    const double measured = kB * (gain + kNoise * normal(random)) - kA * (gain + kNoise * normal(random));
    if (std::abs(measured - (kB - kA)) <= found.coverage_factor * found.sd) ++held;
  }
  CHECK(static_cast<double>(held) / kTrials == Approx(0.95).margin(0.006));  // four standard deviations
}
