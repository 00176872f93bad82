#include "estimation/tire_fit/class_priors.h"

#include <catch2/catch.hpp>

#include "tests/support/drum_fixture.h"

using namespace rollrig;
using estimation::find_class_uncertainties;

namespace {

constexpr double kLevelSpeed_m_s = 80.0 / 3.6;
const char* const kCapacityKey = "tire.thermal.heat_capacity_J_per_K";

}  // namespace

TEST_CASE("a number that is guessed too low is not known better for that", "[fast]") {
  models::TireParameters<double> tire = tests::read_asset_tire("c1_205_55r16").values;
  const auto right = find_class_uncertainties(tire, kLevelSpeed_m_s);
  tire.thermal.heat_capacity_J_per_K *= 0.5;
  tire.thermal.H_gas_W_per_K *= 0.5;
  const auto low = find_class_uncertainties(tire, kLevelSpeed_m_s);
  CHECK(low.at(kCapacityKey) == right.at(kCapacityKey));
  CHECK(low.at("tire.thermal.H_gas_W_per_K") == right.at("tire.thermal.H_gas_W_per_K"));
}

TEST_CASE("the class of a heat capacity reaches over the specific heats of tires", "[fast]") {
  // Of rubber alone, 1950 J/(kg K), down to a tire with a third of steel, 1450, both within a standard uncertainty and
  // the calibrated tires within three.
  for (const char* name : {"a40", "a50", "a60", "c1_205_55r16", "c3_315_80r22_5"}) {
    INFO(name);
    const models::TireParameters<double> tire = tests::read_asset_tire(name).values;
    const double sd = find_class_uncertainties(tire, kLevelSpeed_m_s).at(kCapacityKey);
    const double usual = 1640.0 * tire.geometry.mass_kg;
    CHECK(usual + sd > 1950.0 * tire.geometry.mass_kg);
    CHECK(usual - sd < 1450.0 * tire.geometry.mass_kg);
    CHECK(usual + 3.0 * sd > tire.thermal.heat_capacity_J_per_K);
    CHECK(2.0 * sd < usual);  // no heat capacity below zero is likely
  }
}

TEST_CASE("only a law with lines over speed has a class of their slopes, by the level of the loss", "[fast]") {
  models::TireParameters<double> tire = tests::read_combined_tire().values;
  const auto usual = find_class_uncertainties(tire, kLevelSpeed_m_s);
  tire.rolling_resistance.A0_N *= 2.0;
  tire.rolling_resistance.A1_N_s_per_m *= 2.0;
  const auto twice = find_class_uncertainties(tire, kLevelSpeed_m_s);
  const std::string A1 = "tire.rolling_resistance.A1_N_s_per_m";
  CHECK(twice.at(A1) == Approx(2.0 * usual.at(A1)));
  CHECK(find_class_uncertainties(tests::read_asset_tire("a50").values, kLevelSpeed_m_s).count(A1) == 0);
}
