#include "estimation/tire_fit/class_priors.h"

#include <catch2/catch.hpp>

#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

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
  tests::find_own(tire.own, "tread_share_of_loss") *= 0.5;
  tests::find_own(tire.own, "conductance_W_per_K") *= 0.5;
  const auto low = find_class_uncertainties(tire, kLevelSpeed_m_s);
  CHECK(low.at(kCapacityKey) == right.at(kCapacityKey));
  CHECK(low.at("tire.thermal.H_gas_W_per_K") == right.at("tire.thermal.H_gas_W_per_K"));
  for (const char* key : {"tire.bounded.tread_share_of_loss", "tire.bounded.conductance_W_per_K"}) {
    INFO(key);
    CHECK(low.at(key) == right.at(key));
    CHECK(low.at(key) > 0.0);
  }
}

TEST_CASE("a conductance within the tire is known as well as the size of the tire says", "[fast]") {
  const auto find = [](const char* name) {
    return find_class_uncertainties(tests::read_asset_tire(name).values, kLevelSpeed_m_s);
  };
  const auto car = find("c1_205_55r16");
  const auto truck = find("c3_315_80r22_5");
  const char* const share = "tire.bounded.tread_share_of_loss";
  CHECK(truck.at("tire.bounded.conductance_W_per_K") > 2.0 * car.at("tire.bounded.conductance_W_per_K"));
  CHECK(truck.at(share) == car.at(share));
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
