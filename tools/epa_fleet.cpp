/// Simulates every car of a list of test cars by its public coefficients, and compares.
///
/// usage: epa_fleet <list.csv> <cars.csv> <page.md> [every n-th car]
/// Reads a list with the columns of the United States Environmental Protection Agency's test-car data; writes one
/// row a car (coastdown on the road refitted, settings of the rollers) and a page with what differs.
#include <exception>
#include <iostream>
#include <string>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "tools/fleet.h"

int main(int argc, char** argv) {
  using namespace rollrig;
  if (argc != 4 && argc != 5) {
    std::cerr << "usage: epa_fleet <list.csv> <cars.csv> <page.md> [every n-th car]\n";
    return 2;
  }
  try {
    const std::size_t step = argc == 5 ? std::stoul(argv[4]) : 1;
    const std::vector<tools::TestCar> cars = tools::thin_out(tools::read_test_cars(argv[1]), step);
    const tools::FleetAssumptions assumptions;
    const std::vector<tools::FleetResult> results = tools::simulate_fleet(cars, assumptions, 0);
    write_output(argv[2], tools::make_fleet_csv(cars, results));
    write_output(argv[3], tools::make_fleet_page(cars, results, assumptions));
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
