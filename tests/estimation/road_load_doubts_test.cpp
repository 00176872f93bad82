#include "estimation/road_load/road_load_doubts.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "estimation/road_load/road_load_fit.h"
#include "tests/support/coastdown_study.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;

namespace {

constexpr double kCarMass_kg = 2100.0;
constexpr double kCarTop_m_s = 130.0 / 3.6;
const models::RoadLoad<double> kCar{100.0, 0.5 * 3.6, 0.032 * 12.96};

/// As it comes out where speeds are a factor too small.
models::RoadLoad<double> slow_down(const models::RoadLoad<double>& load, double factor) {
  return {load.A_N / factor, load.B_N_s_per_m, load.C_N_s2_per_m2 * factor};
}

}  // namespace

TEST_CASE("a usual road load has no doubt, one of speeds in mph has one alone", "[fast]") {
  CHECK(doubt_road_load(kCar, kCarMass_kg, kCarTop_m_s).empty());
  CHECK(doubt_road_load(kCar, kCarMass_kg, 80.0 / 3.6).empty());
  const auto doubts = doubt_road_load(slow_down(kCar, 1.609344), kCarMass_kg, kCarTop_m_s / 1.609344);
  REQUIRE(doubts.size() == 1);
  CHECK_THAT(doubts[0], Contains("speeds end near 81") && Contains("in mph and not in km/h"));
}

TEST_CASE("a rolling loss or a drag area that no road vehicle has is doubted", "[fast]") {
  const auto sticky = doubt_road_load({900.0, 0.0, kCar.C_N_s2_per_m2}, kCarMass_kg, kCarTop_m_s);
  REQUIRE(sticky.size() == 1);
  CHECK_THAT(sticky[0], Contains("rolling loss at 50 km/h is 0.0437"));
  const auto wide = doubt_road_load({100.0, 1.8, 12.0}, kCarMass_kg, kCarTop_m_s);
  REQUIRE(wide.size() == 1);
  CHECK_THAT(wide[0], Contains("a drag area of 20 m2") && Contains("is 2100 kg right?"));
  CHECK(doubt_road_load({9000.0, 0.0, 12.0}, kCarMass_kg, kCarTop_m_s).size() == 2);
}

TEST_CASE("a road load in lbf is one that no car has", "[fast]") {
  const auto doubts = doubt_road_load({33.2, -0.0857 * 3.6, 0.02006 * 12.96}, 1928.0, 1e3);  // lbf, mph of an EX30
  REQUIRE(doubts.size() == 1);
  CHECK_THAT(doubts[0], Contains("rolling loss at 50 km/h is 0.0015"));
  CHECK(doubt_road_load({147.68, -0.23687 * 3.6, 0.034452 * 12.96}, 1928.0, 1e3).empty());
}

TEST_CASE("the fit without a method doubts speeds in mph if it has a mass", "[fast]") {
  tests::CoastdownStudy study;
  study.load = kCar;
  study.pairs = 2;
  CoastdownData data = tests::simulate_coastdowns(study, 1);
  const auto count_doubts = [&data](std::optional<double> mass_kg) {
    RoadLoadFitOptions options;
    options.mass_kg = mass_kg;
    int count = 0;
    for (const std::string& warning : fit_road_load(data, options).warnings) {
      count += warning.find("in mph and not in km/h") != std::string::npos ? 1 : 0;
    }
    return count;
  };
  CHECK(count_doubts(study.mass_kg) == 0);
  for (CoastdownRun& run : data.runs) {
    for (double& speed_m_s : run.speed_m_s) speed_m_s /= 1.609344;
  }
  CHECK(count_doubts(study.mass_kg) == 1);
  CHECK(count_doubts(std::nullopt) == 0);
}

TEST_CASE("speeds in m/s are not taken for mph", "[fast]") {
  const auto doubts = doubt_road_load(slow_down(kCar, 3.6), kCarMass_kg, kCarTop_m_s / 3.6);
  REQUIRE(doubts.size() == 1);
  CHECK_THAT(doubts[0], Contains("in m/s and not in km/h"));
}

TEST_CASE("masses that do not go together are doubted", "[fast]") {
  CHECK(doubt_masses(1850.0, std::nullopt, std::nullopt).empty());
  CHECK(doubt_masses(1850.0, 55.5, 1900.0).empty());
  CHECK(doubt_masses(1850.0, 20.0, 1600.0).empty());
  for (const double rotating_kg : {0.0, 550.0}) {
    const auto doubts = doubt_masses(1850.0, rotating_kg, std::nullopt);
    REQUIRE(doubts.size() == 1);
    CHECK_THAT(doubts[0], Contains("of a vehicle in neutral"));
  }
  const auto doubts = doubt_masses(1850.0, std::nullopt, 4079.0);
  REQUIRE(doubts.size() == 1);
  CHECK_THAT(doubts[0], Contains("2.2 times the mass as tested"));
}

TEST_CASE("a torque of one wheel, or a diameter for the radius, is doubted", "[fast]") {
  CHECK_FALSE(doubt_torque_scale(kCar, kCarMass_kg, 0.33).has_value());
  const models::RoadLoad<double> half{0.5 * kCar.A_N, 0.5 * kCar.B_N_s_per_m, 0.5 * kCar.C_N_s2_per_m2};
  const auto doubt = doubt_torque_scale(half, kCarMass_kg, 0.33);
  REQUIRE(doubt.has_value());
  CHECK_THAT(*doubt, Contains("the sum of all driven wheels"));
  CHECK(doubt_torque_scale(kCar, kCarMass_kg, 0.66).has_value());
  CHECK_FALSE(doubt_torque_scale({1200.0, 0.0, 4.0}, 18000.0, 0.5).has_value());  // a truck
}

TEST_CASE("a given drag area that is far from the one of C is doubted", "[fast]") {
  const tests::CoastdownStudy study;
  const CoastdownData data = tests::simulate_coastdowns(study, 1);
  RoadLoadFitOptions options;
  options.mass_kg = study.mass_kg;
  for (const auto& [area_m2, is_doubted] : {std::pair(0.65, false), std::pair(0.5, false), std::pair(6.5, true)}) {
    options.drag_area_m2 = area_m2;
    const auto warnings = fit_road_load(data, options).warnings;
    const bool found = std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("--drag-area is") != std::string::npos;
    });
    CHECK(found == is_doubted);
  }
}
