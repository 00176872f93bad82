#pragma once
/// A list of test cars by their public road load and dynamometer coefficients, each of them simulated.

#include <optional>
#include <string>
#include <vector>

#include "models/vehicle/road_load.h"
#include "scenarios/run/scenario.h"

namespace rollrig::tools {

/// A combination of weight, drive, target and set coefficients of the list.
struct TestCar {
  std::string make;   // of the first car of the list that has it
  std::string model;  // likewise
  std::string drive;  // Drive System Code: F, R, A, 4, P
  double mass_kg = 0.0;
  models::RoadLoad<double> target;
  models::RoadLoad<double> set;

  double weight_N() const { return mass_kg * kStandardGravity_m_s2; }
};

/// Reads a list with the columns that the United States Environmental Protection Agency gives its test-car
/// data (pounds, lbf, mph); further columns are passed over, rows that say the same again are left out.
/// Throws InputError.
std::vector<TestCar> read_test_cars(const std::string& path);

/// What the list does not say.
struct FleetAssumptions {
  double rrc_N_per_kN = 9.0;         // of every tire in the ISO test. Assumed: tires of the United States' market
  double pressure_kPa = 240.0;       // of the soaked tires. Assumed: 35 psi, usual on placards
  double rotating_share = 0.03;      // of the mass. Assumed: SAE J2263, where no other is known
  double driveline_cold_N = 14.0;    // effect driveline_warming, of one wheel. Assumed: middle of its 3 to 25 N
  double driveline_time_min = 30.0;  // Assumed: middle of its 15 to 60 min
  double driveline_fall = 1.3;       // Assumed: middle of its 0.7 to 2.5
};

/// What the simulation makes of one car.
struct FleetResult {
  models::RoadLoad<double> refit;                         // from coastdowns on rig flat
  double refit_error = 0.0;                               // largest relative error of force over 20 to 130 km/h
  double refit_error_at_m_s = 0.0;                        // where it is
  models::RoadLoad<double> set_all;                       // on rig dyno_48in, rollers under all wheels
  std::optional<models::RoadLoad<double>> set_driven;     // on rig dyno_48in_2wd; not of cars driven at all wheels
  std::optional<models::RoadLoad<double>> set_driveline;  // as the one that stands last, with driveline_warming
  double largest_off_N = 0.0;                             // of vehicle on rollers from target, worst of all settings
  std::string failure;                                    // why a part could not be done; empty
};

/// Share of the drive on the front axle; part-time four-wheel drive is taken as rear. Throws std::out_of_range.
double find_front_drive(const std::string& drive);

/// Simulates every car, quasi-static, on up to `threads` threads (0: all). The result does not depend on them.
std::vector<FleetResult> simulate_fleet(const std::vector<TestCar>& cars, const FleetAssumptions& assumptions,
                                        int threads);

/// One row a car.
std::string make_fleet_csv(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results);

/// What comes out, as tables.
std::string make_fleet_summary(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results);

/// docs/epa_fleet.md: the same of the list of model year 2022, with what was assumed and what differs.
std::string make_fleet_page(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results,
                            const FleetAssumptions& assumptions);

}  // namespace rollrig::tools
