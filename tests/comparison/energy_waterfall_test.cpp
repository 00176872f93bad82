// From one energy to another: every step is a change of a term, and no joule is lost on the way.
#include "comparison/energy_waterfall.h"

#include <catch2/catch.hpp>

using rollrig::EnergyStep;
using rollrig::EnergyWaterfall;
using rollrig::Json;
using rollrig::comparison::make_waterfall;

namespace {

double sum_steps_J(const EnergyWaterfall& waterfall) {
  double reached_J = waterfall.start_J;
  for (const EnergyStep& step : waterfall.steps) reached_J += step.energy_J;
  return reached_J;
}

}  // namespace

TEST_CASE("steps lead from the energy of one run to that of the other", "[fast]") {
  const Json a = {{"motor", 1000.3}, {"tire_loss", -700.1}, {"bearing_loss", -300.2}, {"heat_generated", 700.1}};
  const Json b = {{"motor", 1240.7}, {"tire_loss", -900.4}, {"bearing_loss", -340.1}, {"heat_generated", 900.4}};
  const auto found = make_waterfall(a, b, "b");
  REQUIRE(found.has_value());
  CHECK(found->term == "motor");
  CHECK(found->start_J == 1000.3);
  CHECK(found->end_J == 1240.7);
  CHECK(sum_steps_J(*found) == Approx(1240.7).epsilon(1e-14));  // rounding of the sum
  REQUIRE(found->steps.size() == 3);                            // heat is no mechanical energy
  CHECK(found->steps[0].name == "tire_loss");
  CHECK(found->steps[0].energy_J == Approx(200.3));
  CHECK(found->steps[2].name == "not closed");  // what the ledger of b lacks: 0.2 J
  CHECK(found->steps[2].energy_J == Approx(0.2));
  CHECK(found->missing.empty());
}

TEST_CASE("a term of one machine alone is named", "[fast]") {
  const auto found = make_waterfall({{"motor", 10.0}, {"bearing_loss", -10.0}},
                                    {{"motor", 12.0}, {"bearing_loss", -9.0}, {"brake_loss", -3.0}}, "b");
  REQUIRE(found.has_value());
  CHECK(found->missing == std::vector<std::string>{"brake_loss"});
  CHECK(sum_steps_J(*found) == Approx(12.0));
}

TEST_CASE("a coastdown is driven by its kinetic energy", "[fast]") {
  const auto found = make_waterfall({{"motor", 0.0}, {"kinetic", 500.0}, {"tire_loss", -500.0}},
                                    {{"motor", 0.0}, {"kinetic", 520.0}, {"tire_loss", -520.0}}, "b");
  REQUIRE(found.has_value());
  CHECK(found->term == "kinetic");
  CHECK(found->end_J == 520.0);
}
