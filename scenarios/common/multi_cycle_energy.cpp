#include "scenarios/common/multi_cycle_energy.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "sim/core/units.h"

namespace rollrig::scenarios {
namespace {

constexpr double kCityWeight = 0.55;               // 10 CFR 474, appendix
constexpr double kGallon_J = 33.7 * 1e3 * 3600.0;  // EPA, second-hand: docs/j1634.md

}  // namespace

std::vector<double> calc_phase_weights(const std::vector<EnergySection>& cycles, double usable_J) {
  const double first = cycles.front().battery_J / usable_J;
  std::vector<double> weights(cycles.size(), (1.0 - first) / static_cast<double>(cycles.size() - 1));
  weights.front() = first;
  return weights;
}

CycleEconomy calc_economy(const std::vector<EnergySection>& cycles, const std::vector<double>& weights,
                          const BatteryCharge& charge) {
  CycleEconomy economy;
  for (std::size_t i = 0; i < cycles.size(); ++i) economy.dc_J_per_m += weights[i] * cycles[i].per_m();
  economy.range_m = charge.usable_J / economy.dc_J_per_m;
  if (charge.recharge_J.has_value()) economy.ac_J_per_m = *charge.recharge_J / economy.range_m;
  return economy;
}

std::optional<std::string> doubt_range(double range_m, double usable_J) {
  constexpr double kMost_m = 2000e3;
  constexpr double kJ_per_kWh = 3.6e6;
  if (range_m <= kMost_m) return std::nullopt;
  return fmt::format("a range of {:.0f} km, which no electric vehicle has: is usable_energy_kWh = {:g} in Wh?",
                     range_m / 1e3, usable_J / kJ_per_kWh);
}

std::optional<std::string> doubt_charge(double usable_J, double recharge_J) {
  constexpr double kLeast = 0.7, kMost = 0.98;
  constexpr double kJ_per_kWh = 3.6e6;
  const double efficiency = usable_J / recharge_J;
  if (efficiency >= kLeast && efficiency <= kMost) return std::nullopt;
  return fmt::format(
      "the battery gives back {:.0f} % of its recharge energy, {:.1f} of {:.1f} kWh, where charges give back 80 to "
      "95 %: are usable_energy_kWh and recharge_energy_kWh right?",
      1e2 * efficiency, usable_J / kJ_per_kWh, recharge_J / kJ_per_kWh);
}

CycleEconomy combine_economy(const CycleEconomy& city, const CycleEconomy& highway) {
  const auto mix = [](double of_city, double of_highway) {
    return kCityWeight * of_city + (1.0 - kCityWeight) * of_highway;
  };
  CycleEconomy both;
  both.dc_J_per_m = mix(city.dc_J_per_m, highway.dc_J_per_m);
  both.range_m = mix(city.range_m, highway.range_m);
  if (city.ac_J_per_m.has_value()) both.ac_J_per_m = mix(*city.ac_J_per_m, *highway.ac_J_per_m);
  return both;
}

MultiCycleEconomy calc_multi_cycle_economy(const std::vector<EnergySection>& city,
                                           const std::vector<EnergySection>& highway, const BatteryCharge& charge) {
  const std::vector<double> weights = calc_phase_weights(city, charge.usable_J);
  const std::vector<double> equal(highway.size(), 1.0 / static_cast<double>(highway.size()));
  MultiCycleEconomy economy;
  economy.charge = charge;
  economy.first_city_weight = weights.front();
  economy.city = calc_economy(city, weights, charge);
  economy.highway = calc_economy(highway, equal, charge);
  economy.combined = combine_economy(economy.city, economy.highway);
  return economy;
}

double calc_mpge(double ac_J_per_m) { return kGallon_J / ac_J_per_m / kMile_m; }

ColdExcess calc_cold_excess(const std::vector<CycleLoss>& cycles) {
  constexpr double kLeastShare = 1e-3;  // Assumed: of the energy of the battery; below it, a share says nothing
  constexpr double kRounding = 1e-9;    // likewise; below it, an excess is the rounding of sums
  const CycleLoss& first = cycles.front();
  const auto later_J = [&](const std::function<double(const CycleLoss&)>& energy_J) {
    double sum_J_per_m = 0.0;
    for (std::size_t i = 1; i < cycles.size(); ++i) sum_J_per_m += energy_J(cycles[i]) / cycles[i].battery.distance_m;
    return first.battery.distance_m * sum_J_per_m / static_cast<double>(cycles.size() - 1);
  };
  const double battery_J = later_J([](const CycleLoss& cycle) { return cycle.battery.battery_J; });
  ColdExcess excess;
  const auto without_rounding_J = [battery_J](double energy_J) {
    return std::abs(energy_J) > kRounding * std::abs(battery_J) ? energy_J : 0.0;
  };
  if (battery_J > 0.0) excess.battery_share = without_rounding_J(first.battery.battery_J - battery_J) / battery_J;
  excess.wheel_J = without_rounding_J(first.wheel_J - later_J([](const CycleLoss& cycle) { return cycle.wheel_J; }));
  excess.tire_J = without_rounding_J(first.tire_J - later_J([](const CycleLoss& cycle) { return cycle.tire_J; }));
  if (std::abs(excess.wheel_J) > kLeastShare * battery_J) excess.tire_share = excess.tire_J / excess.wheel_J;
  return excess;
}

}  // namespace rollrig::scenarios
