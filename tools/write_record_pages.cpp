/// Writes docs/ex30.md and docs/epa_fleet.md. usage: write_record_pages <source folder>
#include <exception>
#include <iostream>
#include <string>

#include "sim/core/file_io.h"
#include "tools/fleet.h"
#include "tools/multi_cycle.h"

int main(int argc, char** argv) {
  using namespace rollrig;
  if (argc != 2) {
    std::cerr << "usage: write_record_pages <source folder>\n";
    return 2;
  }
  try {
    const std::string source = argv[1];
    const std::string published = source + "/tests/published/";
    write_output(source + "/docs/ex30.md", tools::make_ex30_page(published + "ex30_multi_cycle/phases.csv"));
    const auto cars = tools::read_test_cars(published + "epa_fleet/test_cars_2022.csv");
    const tools::FleetAssumptions assumptions;
    const auto results = tools::simulate_fleet(cars, assumptions, 0);
    write_output(source + "/docs/epa_fleet.md", tools::make_fleet_page(cars, results, assumptions));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
