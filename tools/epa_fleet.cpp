/// Simulates every car of a list of test cars by its public coefficients.
///
/// usage: epa_fleet <list.csv> <cars.csv>
/// Reads a list with the columns of the United States Environmental Protection Agency's test-car data; writes one
/// row a car (coastdown on the road refitted, settings of the rollers) and prints tables over all.
#include <exception>
#include <iostream>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "tools/fleet.h"

int main(int argc, char** argv) {
  using namespace rollrig;
  if (argc != 3) {
    std::cerr << "usage: epa_fleet <list.csv> <cars.csv>\n";
    return 2;
  }
  try {
    const std::vector<tools::TestCar> cars = tools::read_test_cars(argv[1]);
    const std::vector<tools::FleetResult> results = tools::simulate_fleet(cars, {}, 0);
    write_output(argv[2], tools::make_fleet_csv(cars, results));
    std::cout << tools::make_fleet_summary(cars, results);
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
