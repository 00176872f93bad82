// Campaigns whose tire file holds guesses: neither is a cause named for what the guesses are off by, nor is a true
// cause lost where the guesses leave it visible.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "diagnosis/comparison/tire_beliefs.h"
#include "tests/diagnosis/answers.h"
#include "tests/diagnosis/compared_set.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

using namespace rollrig;

namespace {

/// A number near 1, within two standard deviations.
double draw_factor(std::mt19937_64& random, double sd) {
  std::normal_distribution<double> normal;
  double x = normal(random);
  while (std::abs(x) > 2.0) x = normal(random);
  return 1.0 + sd * x;
}

/// What someone writes who knows the RRc to 10 %, and all else as a tire of the class has it.
void guess(models::TireFile& tire, std::mt19937_64& random) {
  tire.basis = models::TireBasis::kUnknown;
  auto& law = tire.values.rolling_resistance;
  constexpr double kWarm_K = 45.0;
  const double fall = draw_factor(random, 0.25);
  const double fall_per_K = law.B0_per_K + law.B1_s_per_m_K * 80.0 / 3.6;
  const double level = std::exp((fall - 1.0) * fall_per_K * kWarm_K) * draw_factor(random, 0.06);
  law.B0_per_K *= fall;
  law.B1_s_per_m_K *= fall;
  law.A0_N *= level;
  law.A1_N_s_per_m *= level;
  auto& thermal = tire.values.thermal;
  thermal.heat_capacity_J_per_K *= draw_factor(random, 0.2);
  thermal.gas_heat_capacity_J_per_K *= draw_factor(random, 0.2);
  thermal.H_gas_W_per_K *= draw_factor(random, 0.25);
  for (auto& [rig, at] : tire.rig_thermal) {
    at.rest_conductance_W_per_K = *at.rest_conductance_W_per_K * draw_factor(random, 0.25);
    at.speed_conductance_W_s_per_m_K = *at.speed_conductance_W_s_per_m_K * draw_factor(random, 0.25);
  }
}

/// Diagnoses the sets of so many guessed tires, and counts the causes named that do not act.
int count_wrong(int count) {
  std::mt19937_64 random(20);
  int wrong = 0;
  for (int i = 0; i < count; ++i) {
    const bool acts = i % 3 == 2;
    const auto effects = acts ? std::vector{tests::act("bearing_warmup", 1.5)} : std::vector<models::ActiveEffect>{};
    auto set = tests::add_noise(tests::make_gap_set(effects, 3), static_cast<std::uint64_t>(i + 1));
    guess(set.tire, random);
    const diagnosis::Diagnosis found = diagnosis::diagnose(set, {});
    INFO(i << ": " << (found.causes.empty() ? "none" : found.causes.front().effects.front()));
    CHECK(std::any_of(found.warnings.begin(), found.warnings.end(), [](const std::string& warning) {
      return warning.find("does not say how well its numbers are known") != std::string::npos;
    }));
    const bool is_named = found.verdict == diagnosis::Verdict::kExplained && found.causes.front().probability > 0.5;
    if (is_named && !(acts && tests::names(found, "bearing_warmup"))) ++wrong;
  }
  return wrong;
}

}  // namespace

TEST_CASE("with a guessed tire no cause is named that does not act", "[slow]") { CHECK(count_wrong(3) == 0); }

TEST_CASE("with a dozen guessed tires no cause is named that does not act", "[weekly]") { CHECK(count_wrong(12) == 0); }

TEST_CASE("a measured tire that does not say so keeps its usual uncertainties, and its cause", "[slow]") {
  auto set = tests::add_noise(tests::make_gap_set({tests::act("bearing_warmup")}, 3), 5);
  const diagnosis::Diagnosis measured = diagnosis::diagnose(set, {});
  set.tire.basis = models::TireBasis::kUnknown;
  const diagnosis::Diagnosis open = diagnosis::diagnose(set, {});
  CHECK(tests::names(measured, "bearing_warmup"));
  CHECK(tests::names(open, "bearing_warmup"));
  for (const BaseNumber& base : open.base_numbers) CHECK(base.sd_source != SdSource::kClass);
}
