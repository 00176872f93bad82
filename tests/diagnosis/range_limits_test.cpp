// Effects whose size lies near or beyond the end of its range: no estimate passes it, and it is said that it is there.
#include <catch2/catch.hpp>
#include <random>

#include "diagnosis/findings/verdict.h"
#include "tests/diagnosis/compared_set.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

using namespace rollrig;

namespace {

struct Planted {
  std::string effect;
  double size;   // in the unit of the effect's size
  double limit;  // the one that is near
};

/// The estimate of the size and the objections, where the effect is the only one that is compared.
diagnosis::Cause estimate(const Planted& planted, std::uint64_t seed) {
  const models::Effect& effect = models::find_effect(planted.effect);
  const auto clean = tests::make_gap_set({tests::make_active(effect, {planted.size})}, 1);
  const tests::ComparedSet compared(tests::add_noise(clean, seed), {planted.effect});
  return diagnosis::find_causes(compared.study, compared.comparison).front();
}

bool speaks_of_range(const diagnosis::Cause& cause) {
  return std::any_of(cause.objections.begin(), cause.objections.end(), [](const std::string& objection) {
    return objection.find("would have to lie beyond its range") != std::string::npos;
  });
}

}  // namespace

TEST_CASE("no estimate lies beyond its range, nor does its interval, and a size beyond it is said to be there",
          "[slow]") {
  constexpr int kCases = 36;
  const std::vector<std::pair<std::string, double>> limits{
      {"tire_loss_in_skim", 20.0}, {"bearing_load_friction", 50.0}, {"speed_record", 15.0}, {"speed_record", -15.0}};
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> share(0.85, 1.6);
  int within = 0;
  int held = 0;
  int cut = 0;
  for (int i = 0; i < kCases; ++i) {
    const auto& [effect, limit] = limits[static_cast<std::size_t>(i) % limits.size()];
    const Planted planted{effect, share(random) * limit, limit};
    const diagnosis::Cause cause = estimate(planted, static_cast<std::uint64_t>(i + 1));
    const ParameterEstimate& size = cause.parameters.front();
    INFO(effect << " " << planted.size << ": " << size.value << " (" << size.low_95 << " to " << size.high_95 << ")");
    const double outermost = limit > 0.0 ? size.high_95 : -size.low_95;
    const double most = std::abs(limit) * (1.0 + 1e-6);
    CHECK(std::abs(size.value) <= most);
    CHECK(outermost <= most);
    CHECK(size.low_95 <= size.value);
    CHECK(size.high_95 >= size.value);
    const bool is_marked = size.on_limit == (limit > 0.0 ? RangeLimit::kUpper : RangeLimit::kLower);
    const double of_limit = planted.size / limit;
    if (of_limit > 1.3) {
      CHECK(is_marked);
      CHECK(speaks_of_range(cause));
    }
    if (of_limit < 0.95) CHECK_FALSE(speaks_of_range(cause));
    if (is_marked) CHECK(outermost == Approx(std::abs(limit)).epsilon(1e-6));
    if (outermost > 0.999 * std::abs(limit)) ++cut;
    if (of_limit > 1.0) continue;
    ++within;
    if (planted.size >= size.low_95 && planted.size <= size.high_95) ++held;
  }
  CHECK(cut >= kCases / 2);
  CHECK(held >= 0.9 * within);
}
