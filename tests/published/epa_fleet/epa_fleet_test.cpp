// A public list of test cars: road load given back by coastdowns, rollers set to it.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "build_paths.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "tests/support/page_numbers.h"
#include "tests/support/temporary_folder.h"
#include "tools/fleet.h"

using namespace rollrig;
using namespace rollrig::tools;

namespace {

const std::string kList = ROLLRIG_SOURCE_DIR "/tests/published/epa_fleet/test_cars_2022.csv";

double take_off_N(const models::RoadLoad<double>& target, const models::RoadLoad<double>& set, double speed_m_s) {
  return models::calc_road_load_N(target, speed_m_s) - models::calc_road_load_N(set, speed_m_s);
}

/// What must hold of every car, whatever its coefficients.
void check_car(const TestCar& car, const FleetResult& result) {
  INFO(car.make << " " << car.model << " " << car.drive << " " << result.failure);
  CHECK(result.failure.empty());
  CHECK(result.refit_error < 0.005);   // the bar
  CHECK(result.largest_off_N < 10.0);  // criterion of the setting
  for (const double speed_m_s : {5.0, 15.0, 30.0}) {
    const double all_N = take_off_N(car.target, result.set_all, speed_m_s);
    CHECK(all_N > 0.0);
    if (!result.set_driven.has_value()) continue;
    // The axle that stands still keeps its share of the tires' loss, and the force is found to 1 N each. Tires of
    // the heavier axle, which carry 20 % more than the mean, run some 5 K warmer and lose B = 1.6 %/K less for it.
    const double driven_N = take_off_N(car.target, *result.set_driven, speed_m_s);
    const double share = car.drive == "F" ? 0.60 : 0.48;
    CHECK(driven_N == Approx(share * all_N).epsilon(0.08).margin(2.0));
  }
  CHECK(take_off_N(car.target, *result.set_driveline, 15.0) >
        take_off_N(car.target, result.set_driven.value_or(result.set_all), 15.0));
}

}  // namespace

TEST_CASE("test cars of a list: road load given back within 0.5 %, rollers set, every 40th car", "[published]") {
  const std::vector<TestCar> all = read_test_cars(kList);
  std::vector<TestCar> cars;
  for (std::size_t i = 0; i < all.size(); i += 40) cars.push_back(all[i]);
  REQUIRE(cars.size() > 30);
  const std::vector<FleetResult> results = simulate_fleet(cars, {}, 0);
  for (std::size_t i = 0; i < cars.size(); ++i) check_car(cars[i], results[i]);
  // Threads do not matter.
  CHECK(make_fleet_csv(cars, results) == make_fleet_csv(cars, simulate_fleet(cars, {}, 1)));
}

TEST_CASE("test cars of a list: all of them, and docs/epa_fleet.md says what comes out", "[weekly]") {
  const std::vector<TestCar> cars = read_test_cars(kList);
  CHECK(cars.size() == 1476);
  const std::vector<FleetResult> results = simulate_fleet(cars, {}, 0);
  for (std::size_t i = 0; i < cars.size(); ++i) check_car(cars[i], results[i]);
  // Out of date? cmake --build build/release --target test_record_pages
  tests::check_page(read_text_file(ROLLRIG_SOURCE_DIR "/docs/epa_fleet.md"), make_fleet_page(cars, results, {}));
}

TEST_CASE("the thinned list says of every car what the agency's own file says", "[published]") {
  const char* folder = std::getenv("ROLLRIG_MEASURED_DATA");
  const std::string whole = std::string(folder != nullptr ? folder : "") + "/epa/epa_2022_test_cars_roadload.csv";
  if (folder == nullptr || !std::filesystem::exists(whole)) {
    WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
    return;
  }
  const std::vector<TestCar> own = read_test_cars(kList);
  const std::vector<TestCar> agency = read_test_cars(whole);
  REQUIRE(own.size() == agency.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    CHECK(own[i].model == agency[i].model);
    CHECK(own[i].mass_kg == agency[i].mass_kg);
    CHECK(own[i].target.C_N_s2_per_m2 == agency[i].target.C_N_s2_per_m2);
    CHECK(own[i].set.A_N == agency[i].set.A_N);
  }
}

TEST_CASE("a list of test cars is read in pounds and miles, and what is wrong is named", "[fast]") {
  const tests::TemporaryFolder folder;
  const std::string head =
      "Represented Test Veh Make,Represented Test Veh Model,Drive System Code,Equivalent Test Weight (lbs.),Target "
      "Coef "
      "A (lbf),Target Coef B (lbf/mph),Target Coef C (lbf/mph**2),Set Coef A (lbf),Set Coef B (lbf/mph),Set Coef C "
      "(lbf/mph**2)\n";
  tests::write_file(folder.file("cars.csv"), head + "a,b,F,4000,30,0.1,0.02,10,0.1,0.02\n");
  const std::vector<TestCar> cars = read_test_cars(folder.file("cars.csv"));
  REQUIRE(cars.size() == 1);
  CHECK(cars[0].mass_kg == Approx(1814.36948));  // 4000 lb
  // 30 + 0.1 60 + 0.02 3600 = 108 lbf at 60 mph
  CHECK(models::calc_road_load_N(cars[0].target, 26.8224) == Approx(480.408));
  tests::write_file(folder.file("drive.csv"), head + "a,b,X,4000,30,0.1,0.02,10,0.1,0.02\n");
  CHECK_THROWS_WITH(read_test_cars(folder.file("drive.csv")),
                    Catch::Contains("Drive System Code") && Catch::Contains("X") && Catch::Contains("F, R, A, 4 or P"));
  tests::write_file(folder.file("weight.csv"), head + "a,b,F,-1,30,0.1,0.02,10,0.1,0.02\n");
  CHECK_THROWS_WITH(read_test_cars(folder.file("weight.csv")), Catch::Contains("Equivalent Test Weight (lbs.)"));
}
