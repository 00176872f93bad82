#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "tools/fleet.h"

namespace rollrig::tools {
namespace {

using Load = models::RoadLoad<double>;

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

std::string show_quartiles(const std::vector<double>& values) {
  if (values.empty()) return "-";
  return fmt::format("{:.2f} ({:.2f} to {:.2f})", find_quantile(values, 0.5), find_quantile(values, 0.25),
                     find_quantile(values, 0.75));
}

/// Target less setting per weight, over a group's cars: at standstill (A alone) or at a speed [N/kN].
std::vector<double> collect(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results,
                            const std::string& drive, double speed_m_s,
                            const std::function<std::optional<Load>(std::size_t)>& set_of) {
  std::vector<double> values;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    if (cars[i].drive != drive || !results[i].failure.empty()) continue;
    const std::optional<Load> set = set_of(i);
    if (!set.has_value()) continue;
    const double taken_N =
        models::calc_road_load_N(cars[i].target, speed_m_s) - models::calc_road_load_N(*set, speed_m_s);
    values.push_back(1e3 * taken_N / cars[i].weight_N());
  }
  return values;
}

std::string make_table(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results, double speed_m_s) {
  std::string text =
      "\n| drive | cars | list | rollers under all wheels | under the driven axle | as it is tested, with driveline "
      "|\n|---|---|---|---|---|---|\n";
  for (const Group& group : kGroups) {
    const auto show = [&](const std::function<std::optional<Load>(std::size_t)>& set_of) {
      return show_quartiles(collect(cars, results, group.code, speed_m_s, set_of));
    };
    const auto list = collect(cars, results, group.code, speed_m_s, [&](std::size_t i) { return cars[i].set; });
    if (list.empty()) continue;
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", group.label, list.size(), show_quartiles(list),
                        show([&](std::size_t i) { return results[i].set_all; }),
                        show([&](std::size_t i) { return results[i].set_driven; }),
                        show([&](std::size_t i) { return results[i].set_driveline; }));
  }
  return text;
}

std::string make_refit(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results) {
  std::size_t within = 0;
  std::size_t worst = 0;
  std::vector<double> errors;
  std::string failures;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    if (!results[i].failure.empty()) {
      failures += fmt::format("* {} {}: {}\n", cars[i].make, cars[i].model, results[i].failure);
      continue;
    }
    errors.push_back(100.0 * results[i].refit_error);
    within += results[i].refit_error <= 0.005 ? 1 : 0;
    if (results[i].refit_error > results[worst].refit_error) worst = i;
  }
  std::string text = fmt::format(
      "\n## Road load given back\n\nEach car's target coefficients on the road (rig `road`), two coastdowns from 130 "
      "km/h, refitted: the force is\nwithin 0.5 % over 20 to 130 km/h for {} of {} cars; median of the largest "
      "deviations {:.4f} %, the worst\n{:.4f} %, at {:.0f} km/h ({} {}).\n",
      within, cars.size(), find_quantile(errors, 0.5), 100.0 * results[worst].refit_error,
      3.6 * results[worst].refit_error_at_m_s, cars[worst].make, cars[worst].model);
  if (!failures.empty()) text += "\nNot done:\n\n" + failures;
  return text;
}

std::string make_setting(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results) {
  double worst_N = 0.0;
  for (const FleetResult& result : results) worst_N = std::max(worst_N, result.largest_off_N);
  return fmt::format(
             "\n## Setting of the rollers\n\nScenario `dyno_setting`: vehicle on rollers and target differ by at most "
             "{:.2f} N over 20 to 130 km/h, whatever the\ncar and the rollers (criterion 10 N).\n",
             worst_N) +
         "\n(target A - set A) per weight, N/kN: median (quartiles)\n" + make_table(cars, results, 0.0) +
         "\n(target - set) of the force at 80 km/h per weight, N/kN: median (quartiles)\n" +
         make_table(cars, results, 80.0 / 3.6);
}

std::string make_head(const FleetAssumptions& assumed) {
  return "# Test cars of a public list, simulated by their coefficients\n\n"
         "Written by `cmake --build build/release --target test_record_pages`; a test holds it to what the program\n"
         "gives. The list: `tests/published/epa_fleet/` (United States Environmental Protection Agency, test-car data\n"
         "of model year 2022). Any list with those columns: `epa_fleet <list.csv> <cars.csv>` writes one row a car "
         "and\n"
         "prints the tables.\n\n" +
         fmt::format(
             "Of each car: the equivalent test weight as mass, {:.0f} % of it as rotating mass (Assumed: SAE J2263),\n"
             "the target coefficients as `[road_load]`. Front share of the weight (Assumed): F 0.60, R and P 0.52,\n"
             "4 and A 0.55. Part-time four-wheel drive is taken as driven at the rear. Tires, which the list does not\n"
             "name (Assumed): a50's law, its loss scaled so that the ISO test gives {:.1f} N/kN, {:.0f} kPa when\n"
             "soaked, all four and all cars alike; a50's size and cooling for all. Rollers of 48 inch: rig "
             "`dyno_48in`\n"
             "under all wheels, `dyno_48in_2wd` under the driven axle alone. Last column: as such a car is usually\n"
             "tested (one axle where one is driven, else all), with the effect `driveline_warming` ({:.0f} N a wheel\n"
             "when cold, {:.0f} min, fall {:.1f}: Assumed, the middle of its priors); without it the vehicle's\n"
             "driveline drags nothing. Quasi-static.\n",
             100.0 * assumed.rotating_share, assumed.rrc_N_per_kN, assumed.pressure_kPa, assumed.driveline_cold_N,
             assumed.driveline_time_min, assumed.driveline_fall);
}

/// Of target A per weight with (target A - set A) per weight, over a group of the list.
double find_correlation(const std::vector<TestCar>& cars, const std::string& drive) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (const TestCar& car : cars) {
    if (car.drive != drive) continue;
    const double a = 1e3 * car.target.A_N / car.weight_N();
    const double d = 1e3 * (car.target.A_N - car.set.A_N) / car.weight_N();
    n += 1.0;
    x += a;
    y += d;
    xx += a * a;
    yy += d * d;
    xy += a * d;
  }
  return (n * xy - x * y) / std::sqrt((n * xx - x * x) * (n * yy - y * y));
}

/// Medians over a group, at standstill [N/kN].
class Medians {
 public:
  Medians(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results) : cars_(cars), results_(results) {}

  double target(const char* drive) const {
    return find_quantile(collect(cars_, results_, drive, 0.0, [](std::size_t) { return Load{}; }), 0.5);
  }
  double list(const char* drive) const { return find_quantile(collect_list(drive), 0.5); }
  double all(const char* drive) const {
    return find_quantile(collect(cars_, results_, drive, 0.0, [this](std::size_t i) { return results_[i].set_all; }),
                         0.5);
  }
  double tested(const char* drive) const { return find_quantile(collect_tested(drive), 0.5); }
  /// Between the quartiles, the list's over the simulated.
  double spread(const char* drive) const { return reach(collect_list(drive)) / reach(collect_tested(drive)); }

 private:
  static double reach(const std::vector<double>& values) {
    return find_quantile(values, 0.75) - find_quantile(values, 0.25);
  }
  std::vector<double> collect_list(const char* drive) const {
    return collect(cars_, results_, drive, 0.0, [this](std::size_t i) { return cars_[i].set; });
  }
  std::vector<double> collect_tested(const char* drive) const {
    return collect(cars_, results_, drive, 0.0, [this](std::size_t i) { return results_[i].set_driveline; });
  }

  const std::vector<TestCar>& cars_;
  const std::vector<FleetResult>& results_;
};

std::string explain_level(const Medians& medians) {
  return fmt::format(
             "* **Level, cars driven at one axle.** The list's medians (F {:.2f}, R {:.2f} N/kN) lie by the column of\n"
             "  the driven axle and far below four rolling tires ({:.2f}, {:.2f}): most of these cars were, by this,\n"
             "  set on a dynamometer that rolls the driven axle alone. Tires of less loss on four rollers would give\n"
             "  the same median, but then not the list's {:.2f} of A. The list does not say which car was tested\n"
             "  where; the quartiles of P reach from one kind to the other.\n",
             medians.list("F"), medians.list("R"), medians.all("F"), medians.all("R"), medians.list("A")) +
         fmt::format(
             "* **Level, by drive.** List against the last column: F {:.2f} and {:.2f}, R {:.2f} and {:.2f},\n"
             "  4 {:.2f} and {:.2f}, A {:.2f} and {:.2f} N/kN. One class of tires stands for all. Likely causes:\n"
             "  front-driven cars on tires of less loss (their target A per weight is {:.2f} N/kN, that of R {:.2f},\n"
             "  of A {:.2f}), more axles and gears that drag along in A.\n",
             medians.list("F"), medians.tested("F"), medians.list("R"), medians.tested("R"), medians.list("4"),
             medians.tested("4"), medians.list("A"), medians.tested("A"), medians.target("F"), medians.target("R"),
             medians.target("A"));
}

/// The reasons of the list of model year 2022; what a person concluded, with the program's numbers.
std::string explain(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results) {
  const Medians medians(cars, results);
  const auto wrong =
      std::count_if(cars.begin(), cars.end(), [](const TestCar& car) { return car.set.C_N_s2_per_m2 < 0.0; });
  return "\n## What differs, and the likely cause\n\n" + explain_level(medians) +
         fmt::format(
             "* **Spread.** The list's quartiles are {:.0f} times (F) and {:.0f} times (A) as far apart as the\n"
             "  simulated ones, which only weight spreads: one tire, one pressure, one driveline for all. In the\n"
             "  list, (target A - set A) goes with target A (correlation per weight: F {:.2f}, R {:.2f}, A {:.2f}):\n"
             "  tires and drivelines of the cars differ, and the list carries neither.\n",
             medians.spread("F"), medians.spread("A"), find_correlation(cars, "F"), find_correlation(cars, "R"),
             find_correlation(cars, "A")) +
         "* **Driveline.** Absent from the baseline; the effect's middle prior adds what the last column has above\n"
         "  the one it belongs to. On the road it is inside the target already.\n"
         "* **Shape.** Between standstill and 80 km/h (target - set) rises by about as much in the list as simulated\n"
         "  for F; for A the simulated rise is larger: a50's law has more rise with speed than those cars' tires and\n"
         "  drivelines together.\n" +
         fmt::format(
             "* **Entries.** Cold tests (20 degF) carry a target raised by a tenth, with settings of their own. Some\n"
             "  entries must be wrong: {} with a set C below zero, and the Elantra N with a target C ten times its "
             "set\n"
             "  C. Nothing was left out; medians and quartiles do not feel them.\n",
             wrong);
}

}  // namespace

std::string make_fleet_summary(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results) {
  return make_refit(cars, results) + make_setting(cars, results);
}

std::string make_fleet_page(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results,
                            const FleetAssumptions& assumptions) {
  return make_head(assumptions) + make_fleet_summary(cars, results) + explain(cars, results);
}

}  // namespace rollrig::tools
