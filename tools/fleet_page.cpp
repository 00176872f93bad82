#include <algorithm>
#include <limits>

#include <boost/math/statistics/bivariate_statistics.hpp>

#include "tools/fleet.h"
#include "tools/pages.h"

namespace rollrig::tools {
namespace {

using Load = models::RoadLoad<double>;
using fmt::literals::operator""_a;

struct Group {
  const char* code;
  const char* label;
};
constexpr Group kGroups[] = {{"F", "F, front"},
                             {"R", "R, rear"},
                             {"P", "P, part-time four-wheel"},
                             {"4", "4, four-wheel"},
                             {"A", "A, all-wheel"}};

/// Linear between the sorted values.
double find_quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

/// Between the quartiles.
double find_reach(const std::vector<double>& values) {
  return find_quantile(values, 0.75) - find_quantile(values, 0.25);
}

std::string show_quartiles(const std::vector<double>& values) {
  if (values.empty()) return "-";
  return fmt::format("{:.2f} ({:.2f} to {:.2f})", find_quantile(values, 0.5), find_quantile(values, 0.25),
                     find_quantile(values, 0.75));
}

/// The settings of a car of which something is said.
using Setting = std::optional<Load> (*)(const TestCar&, const FleetResult&);
std::optional<Load> of_list(const TestCar& car, const FleetResult&) { return car.set; }
std::optional<Load> of_all(const TestCar&, const FleetResult& result) { return result.set_all; }
std::optional<Load> of_driven(const TestCar&, const FleetResult& result) { return result.set_driven; }
std::optional<Load> of_tested(const TestCar&, const FleetResult& result) { return result.set_driveline; }
std::optional<Load> of_nothing(const TestCar&, const FleetResult&) { return Load{}; }

/// The cars with what came out.
struct Fleet {
  const std::vector<TestCar>& cars;
  const std::vector<FleetResult>& results;

  /// Target less setting per weight, over a group's cars: at standstill (A alone) or at a speed [N/kN].
  std::vector<double> collect(const std::string& drive, Setting setting, double speed_m_s = 0.0) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < cars.size(); ++i) {
      if (cars[i].drive != drive || !results[i].failure.empty()) continue;
      const std::optional<Load> set = setting(cars[i], results[i]);
      if (!set.has_value()) continue;
      const double taken_N =
          models::calc_road_load_N(cars[i].target, speed_m_s) - models::calc_road_load_N(*set, speed_m_s);
      values.push_back(1e3 * taken_N / cars[i].weight_N());
    }
    return values;
  }
  double median(const char* drive, Setting setting) const { return find_quantile(collect(drive, setting), 0.5); }
  /// How far apart the list's quartiles are over those of the simulated settings.
  double spread(const char* drive) const {
    return find_reach(collect(drive, of_list)) / find_reach(collect(drive, of_tested));
  }
  /// Of target A per weight with (target A - set A) per weight, over a group of the list.
  double correlation(const char* drive) const {
    std::vector<double> target, taken;
    for (const TestCar& car : cars) {
      if (car.drive != drive) continue;
      target.push_back(1e3 * car.target.A_N / car.weight_N());
      taken.push_back(1e3 * (car.target.A_N - car.set.A_N) / car.weight_N());
    }
    return boost::math::statistics::correlation_coefficient(target, taken);
  }
};

Rows list_settings(const Fleet& fleet, double speed_m_s) {
  Rows rows;
  for (const Group& group : kGroups) {
    const auto show = [&](Setting setting) { return show_quartiles(fleet.collect(group.code, setting, speed_m_s)); };
    const std::size_t count = fleet.collect(group.code, of_list).size();
    if (count == 0) continue;
    rows.push_back(fmt::format("| {} | {} | {} | {} | {} | {} |", group.label, count, show(of_list), show(of_all),
                               show(of_driven), show(of_tested)));
  }
  return rows;
}

}  // namespace

std::string make_fleet_summary(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results) {
  const Fleet fleet{cars, results};
  std::size_t within = 0;
  std::size_t worst = 0;
  double largest_off_N = 0.0;
  std::vector<double> errors_percent;
  std::string failures;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    largest_off_N = std::max(largest_off_N, results[i].largest_off_N);
    if (!results[i].failure.empty()) {
      failures += fmt::format("* {} {}: {}\n", cars[i].make, cars[i].model, results[i].failure);
      continue;
    }
    errors_percent.push_back(100.0 * results[i].refit_error);
    within += results[i].refit_error <= 0.005 ? 1 : 0;
    if (results[i].refit_error > results[worst].refit_error) worst = i;
  }
  return fill_page(
      "epa_fleet_tables", "within"_a = within, "cars"_a = cars.size(),
      "median_percent"_a = find_quantile(errors_percent, 0.5), "worst_percent"_a = 100.0 * results[worst].refit_error,
      "worst_km_h"_a = 3.6 * results[worst].refit_error_at_m_s,
      "worst_car"_a = cars[worst].make + " " + cars[worst].model,
      "failures"_a = failures.empty() ? "" : "\nNot done:\n\n" + failures, "largest_off_N"_a = largest_off_N,
      "at_standstill"_a = join(list_settings(fleet, 0.0)), "at_80_km_h"_a = join(list_settings(fleet, 80.0 / 3.6)));
}

std::string make_fleet_page(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results,
                            const FleetAssumptions& assumed) {
  const Fleet fleet{cars, results};
  const auto wrong =
      std::count_if(cars.begin(), cars.end(), [](const TestCar& car) { return car.set.C_N_s2_per_m2 < 0.0; });
  return fill_page("epa_fleet", "tables"_a = make_fleet_summary(cars, results), "wrong"_a = wrong,
                   "rotating_percent"_a = 100.0 * assumed.rotating_share, "rrc_N_per_kN"_a = assumed.rrc_N_per_kN,
                   "pressure_kPa"_a = assumed.pressure_kPa, "driveline_N"_a = assumed.driveline_cold_N,
                   "driveline_min"_a = assumed.driveline_time_min, "driveline_fall"_a = assumed.driveline_fall,
                   "list_F"_a = fleet.median("F", of_list), "list_R"_a = fleet.median("R", of_list),
                   "list_4"_a = fleet.median("4", of_list), "list_A"_a = fleet.median("A", of_list),
                   "all_F"_a = fleet.median("F", of_all), "all_R"_a = fleet.median("R", of_all),
                   "tested_F"_a = fleet.median("F", of_tested), "tested_R"_a = fleet.median("R", of_tested),
                   "tested_4"_a = fleet.median("4", of_tested), "tested_A"_a = fleet.median("A", of_tested),
                   "target_F"_a = fleet.median("F", of_nothing), "target_R"_a = fleet.median("R", of_nothing),
                   "target_A"_a = fleet.median("A", of_nothing), "spread_F"_a = fleet.spread("F"),
                   "spread_A"_a = fleet.spread("A"), "correlation_F"_a = fleet.correlation("F"),
                   "correlation_R"_a = fleet.correlation("R"), "correlation_A"_a = fleet.correlation("A"));
}

std::string make_epa_fleet_page() {
  const std::vector<TestCar> cars = read_test_cars(fmt::format("{}/epa_fleet/test_cars_2022.csv", kPublishedFolder));
  return make_fleet_page(cars, simulate_fleet(cars, {}, 0), {});
}

}  // namespace rollrig::tools
