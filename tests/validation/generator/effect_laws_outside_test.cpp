// Hidden causes of the second list outside of the catalog have the size and the course that the truth says, and orders
// of the first list stay as they were.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/support/run_program.h"
#include "tests/validation/generator/generated_set.h"
#include "validation/generator/options.h"

using namespace rollrig;
using namespace rollrig::tests;

namespace {

double find_shape(const GeneratedSet& made, const char* name) {
  return made.truth.at("effects").at(0).at("shape").at(name).get<double>();
}

/// Calls `check(run, row, difference, value without the effect)` at each sample.
template <class Check>
void for_each_sample(const GeneratedSet& made, const std::string& channel, const Check& check) {
  for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
    const std::vector<double> difference = find_difference(made, r, channel);
    const std::vector<double>& without = made.counterfactual.runs[r].columns.at(channel);
    for (std::size_t row = 0; row < difference.size(); ++row) {
      if (!std::isnan(difference[row])) check(made.set.runs[r], row, difference[row], without[row]);
    }
  }
}

/// Cases of effects outside of the catalog alone, as "<effect> <size>".
std::vector<std::string> draw_outside(const std::string& kind, generator::OutsideList list, int count) {
  generator::ValidationSetOrder order;
  order.seed = 7306;
  order.kind = kind;
  order.campaigns = generator::read_campaigns(kind);
  order.singles = order.pairs = order.none = 0;
  order.outside = count;
  order.outside_list = list;
  order.runs = 1;
  std::vector<std::string> cases;
  for (const generator::SetOrder& one : generator::draw_cases(order)) {
    const Json effect = generator::draw_truth(one).at("effects").at(0);
    cases.push_back(fmt::format("{} {:.6g}", effect.at("id").get<std::string>(), effect.at("size").get<double>()));
  }
  return cases;
}

}  // namespace

TEST_CASE("the second list outside of the catalog leaves cases of earlier seeds as they were", "[fast]") {
  // As the program drew them before there was a second list.
  const std::vector<std::string> drum{
      "heater_radiation 116.986",    "ripple_aliasing 1.02098", "surface_texture 14.7112",    "tire_growth 4.64029",
      "sensor_self_heating 4.14328", "wet_surface 18.6107",     "speed_interference 2.39078", "load_stiction 129.481"};
  const std::vector<std::string> mixed{
      "sensor_self_heating 3.72685", "heater_radiation 39.093", "wet_surface 41.4216",
      "ripple_aliasing 3.17732",     "tire_growth 6.03939",     "drafting 25.6649",
      "speed_interference 2.39078",  "load_stiction 129.481",   "surface_texture 6.45997"};
  CHECK(draw_outside("drum", generator::OutsideList::kFirst, 8) == drum);
  CHECK(draw_outside("mixed", generator::OutsideList::kFirst, 9) == mixed);
}

TEST_CASE("each machine has its effects of the second list, and none of the first among them", "[fast]") {
  const auto find_ids = [](const std::string& kind) {
    std::set<std::string> ids;
    for (const std::string& one : draw_outside(kind, generator::OutsideList::kSecond, 9)) {
      ids.insert(one.substr(0, one.find(' ')));
    }
    return ids;
  };
  const std::set<std::string> carriage{"load_hunting", "relief_valve", "lead_conduction", "cover_rub",
                                       "cradle_friction"};
  CHECK(find_ids("drum") == carriage);
  CHECK(find_ids("flat_belt") == carriage);
  CHECK(find_ids("dyno") == std::set<std::string>{"lead_conduction", "cover_rub", "cradle_friction", "fan_belt_slip"});
  CHECK(find_ids("road") == std::set<std::string>{"height_map_shift", "cabin_power", "bends"});
}

TEST_CASE("a list outside of the catalog that is not there is refused, with those that are", "[fast]") {
  const auto refused = run_validation("make --outside-list secnd --out nowhere");
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Catch::Contains("--outside-list") && Catch::Contains("second"));
}

TEST_CASE("a load that hunts swings by its size at the reference load, and rests in between", "[fast]") {
  const GeneratedSet made = make_effect_set("drum --runs 1", "load_hunting", "200");
  double highest = 0.0;
  double lowest = 0.0;
  int at_rest = 0;
  for_each_sample(made, "drum_torque_Nm", [&](const auto&, std::size_t row, double more_Nm, double without_Nm) {
    if (row < 60) return;
    highest = std::max(highest, more_Nm / without_Nm);
    lowest = std::min(lowest, more_Nm / without_Nm);
    if (std::abs(more_Nm) < 0.002 * without_Nm) ++at_rest;
  });
  const double share = 200.0 / 5400.0;             // the reference load of the generator
  for (const double swing : {highest, -lowest}) {  // of the tire's part of the torque, which is two thirds at least
    CHECK(swing > 0.66 * share);
    CHECK(swing < 1.02 * share);
  }
  CHECK(at_rest > 200);
}

TEST_CASE("a relief valve is tight below its setting, and what it vents does not come back", "[fast]") {
  const GeneratedSet made = make_effect_set("drum", "relief_valve", "6");
  double vented_Pa = 0.0;
  for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
    const std::vector<double> more_Pa = find_difference(made, r, "cavity_pressure_kPa");
    const std::vector<double>& without_Pa = made.counterfactual.runs[r].columns.at("cavity_pressure_kPa");
    const double setting_Pa = without_Pa.front() + 1e3 * find_shape(made, "opens_above_cold_kPa");
    bool has_opened = made.set.runs[r].initial_tire_temperature_K > 300.0;  // the cold pressure is another
    for (std::size_t row = 0; row < more_Pa.size(); ++row) {
      has_opened = has_opened || without_Pa[row] > setting_Pa - 500.0;
      if (!has_opened && std::abs(more_Pa[row]) > 10.0) FAIL_CHECK(more_Pa[row] << " Pa in row " << row);
      if (row > 0 && more_Pa[row] > more_Pa[row - 1] + 20.0) FAIL_CHECK("gas comes back in row " << row);
    }
    vented_Pa = std::min(vented_Pa, more_Pa.back());
  }
  CHECK(vented_Pa < -1000.0);
}

TEST_CASE("a lead draws the reading from the liner towards the air, by less than its size", "[fast]") {
  const GeneratedSet made = make_effect_set(GENERATE("drum", "dyno --runs 2"), "lead_conduction", "5");
  double largest = 0.0;
  for_each_sample(made, "liner_temperature_degC",
                  [&](const auto& run, std::size_t row, double more_K, double without_K) {
                    const double over_air_K = without_K - run.columns.at("ambient_degC")[row];
                    if (over_air_K < 5.0) return;  // the rim lags behind the air as well, by up to 2 K
                    largest = std::max(largest, -more_K / over_air_K);
                    if (more_K > 0.0 || more_K < -0.05 * (over_air_K + 2.0)) FAIL_CHECK(more_K << " K in row " << row);
                  });
  CHECK(largest > 0.02);
}

TEST_CASE("a cover does not rub on a cold rig, and never by more than its size", "[fast]") {
  const GeneratedSet made = make_effect_set("drum", "cover_rub", "2");
  const double radius_m = 0.5 * made.set.rig->drum.diameter_m;
  double largest_Nm = 0.0;
  for_each_sample(made, "drum_torque_Nm", [&](const auto& run, std::size_t row, double more_Nm, double) {
    largest_Nm = std::max(largest_Nm, more_Nm);
    const bool is_cold = row < 60 && !run.rest_before_s.has_value();
    if (is_cold && std::abs(more_Nm) > 0.01) FAIL_CHECK(more_Nm << " N m on a cold rig");
    if (more_Nm < -0.01 || more_Nm > 2.0 * radius_m + 0.01) FAIL_CHECK(more_Nm << " N m in row " << row);
  });
  CHECK(largest_Nm > 1.0 * radius_m);
}

TEST_CASE("a cradle that rubs holds the reading back by its size at most, in both directions", "[fast]") {
  const GeneratedSet made = make_effect_set("dyno --runs 1", "cradle_friction", "1");
  double highest_N = 0.0;
  double lowest_N = 0.0;
  for_each_sample(made, "loss_force_N", [&](const auto&, std::size_t, double more_N, double) {
    highest_N = std::max(highest_N, more_N);
    lowest_N = std::min(lowest_N, more_N);
  });
  CHECK(highest_N == Approx(1.0).margin(1e-3));
  CHECK(lowest_N == Approx(-1.0).margin(1e-3));
}

TEST_CASE("where the fan's belt slips the tire is warmer", "[fast]") {
  const GeneratedSet made = make_effect_set("dyno --runs 2", "fan_belt_slip", "20");
  double warmest_K = 0.0;
  for_each_sample(made, "liner_temperature_degC", [&](const auto&, std::size_t row, double more_K, double) {
    warmest_K = std::max(warmest_K, more_K);
    if (more_K < -0.02) FAIL_CHECK(more_K << " K in row " << row);
  });
  CHECK(warmest_K > 0.5);
}

TEST_CASE("heights of another place give and take the same work over a trip", "[fast]") {
  const GeneratedSet ahead = make_effect_set("road --baseline combined --runs 2", "height_map_shift", "100");
  const GeneratedSet behind = make_effect_set("road --baseline combined --runs 2", "height_map_shift", "-100");
  const double weight_N = ahead.set.vehicle->body.mass_kg * 9.81;
  for (std::size_t r = 0; r < ahead.set.runs.size(); ++r) {
    const std::vector<double> ahead_N = find_difference(ahead, r, "traction_force_N");
    const std::vector<double> behind_N = find_difference(behind, r, "traction_force_N");
    const std::vector<double>& v_m_s = ahead.set.runs[r].columns.at("speed_km_h");
    double work_J = 0.0;
    double moved_J = 0.0;
    double both = 0.0;
    for (std::size_t row = 0; row < ahead_N.size(); ++row) {
      if (std::isnan(ahead_N[row])) continue;
      work_J += ahead_N[row] * v_m_s[row];
      moved_J += std::abs(ahead_N[row]) * v_m_s[row];
      both += ahead_N[row] * behind_N[row];
    }
    INFO(ahead.set.runs[r].id);
    CHECK(std::abs(work_J) < weight_N * 100.0 * 0.05);  // the height of 100 m of a slope of 5 %, steeper than any
    CHECK(moved_J > 5.0 * std::abs(work_J));
    CHECK(both < 0.0);
  }
}

TEST_CASE("the cabin takes its power at every speed, and less once it is warm or cool", "[fast]") {
  const GeneratedSet made = make_effect_set("road", "cabin_power", "3000");
  for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
    const std::vector<double> more_N = find_difference(made, r, "traction_force_N");
    const std::vector<double>& v_m_s = made.set.runs[r].columns.at("speed_km_h");
    std::vector<double> power_W;
    for (std::size_t row = 0; row < more_N.size(); ++row) {
      if (!std::isnan(more_N[row])) power_W.push_back(more_N[row] * v_m_s[row]);
    }
    INFO(made.set.runs[r].id);
    REQUIRE(power_W.size() > 100);
    CHECK(*std::min_element(power_W.begin(), power_W.end()) > 0.0);
    CHECK(*std::max_element(power_W.begin(), power_W.end()) < 1.5 * 3000.0 + 1.0);
    CHECK(power_W.back() < 0.8 * power_W.front());
  }
}

TEST_CASE("bends drag, and straight stretches do not", "[fast]") {
  const GeneratedSet made = make_effect_set("road --runs 2", "bends", "150");
  int bent = 0;
  int straight = 0;
  double largest_N = 0.0;
  for_each_sample(made, "traction_force_N", [&](const auto&, std::size_t row, double more_N, double) {
    if (more_N < -1e-3) FAIL_CHECK(more_N << " N in row " << row);
    (more_N > 15.0 ? bent : straight) += 1;
    largest_N = std::max(largest_N, more_N);
  });
  CHECK(bent > 100);
  CHECK(straight > 100);
  CHECK(largest_N < 4.0 * 150.0);  // the square of twice the acceleration at 80 km/h, at any speed
  CHECK(largest_N > 75.0);
}
