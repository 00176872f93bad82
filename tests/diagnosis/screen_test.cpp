#include "diagnosis/comparison/screen.h"

#include <catch2/catch.hpp>

#include "sim/core/units.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using diagnosis::Screened;

namespace {

constexpr int kTimeConstant = 1;  // of the bearings' warm-up, in prior units

/// Warming bearings at the middle of their priors, the time constant off by so many prior units.
models::ActiveEffect make_bearings(const models::Effect& effect, double time_constant_u) {
  std::vector<double> values;
  for (std::size_t i = 0; i < effect.info.parameters.size(); ++i) {
    const models::EffectParameter& parameter = effect.info.parameters[i];
    const double u = i == kTimeConstant ? time_constant_u : 0.0;
    values.push_back(unit_of_key(parameter.key).from_si(diagnosis::from_prior_units(parameter, u, 1).value_SI));
  }
  return tests::make_active(effect, values);
}

}  // namespace

TEST_CASE("of an effect's shapes the one that acts is found, one prior unit to either side or at the middle",
          "[fast]") {
  const diagnosis::Term& term = diagnosis::find_term("bearing_warmup");
  for (const double u : {-1.0, 0.0, 1.0}) {
    const models::ActiveEffect acting = make_bearings(models::find_effect("bearing_warmup"), u);
    const tests::FittedBaseline fitted(tests::make_gap_set({acting}, 2));
    const std::vector<Screened> found = diagnosis::screen(fitted, fitted.null, {&term});
    REQUIRE(found.size() == 1);
    CAPTURE(u, found[0].own.transpose());
    CHECK(found[0].own[kTimeConstant] == u);
    CHECK(found[0].score > 0.0);
    CHECK(found[0].detectability > 0.0);
  }
}
