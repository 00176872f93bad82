#pragma once
/// Consumption and range of an electric vehicle from the sections of a test: phase scaling of SAE J1634.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rollrig::scenarios {

/// Energy of the battery in a section, direct current, and the distance driven in it.
struct EnergySection {
  double battery_J = 0.0;
  double distance_m = 0.0;

  double per_m() const { return battery_J / distance_m; }
};

/// A battery from full to empty.
struct BatteryCharge {
  double usable_J = 0.0;                  // direct current, all that the test takes
  std::optional<double> recharge_J = {};  // alternating current for the charge after it
};

/// Consumption and range of one kind of cycle, or of both together.
struct CycleEconomy {
  double dc_J_per_m = 0.0;
  double range_m = 0.0;
  std::optional<double> ac_J_per_m;  // where the recharge is known
};

/// Weights of repeated cycles of a kind: the first by the share of the usable energy that it took, the others equally.
/// Equation  K_1 = E_1/UBE, K_i = (1 - K_1)/(n - 1) for i = 2 ... n
/// Symbols   E_1 energy of the first [J], UBE usable battery energy [J], n number of cycles, two or more
/// Source    SAE J1634 section 8 as EPA certificates apply it (second-hand: tests/published/ex30_multi_cycle)
/// Checked   tests/scenarios/multi_cycle_test.cpp
std::vector<double> calc_phase_weights(const std::vector<EnergySection>& cycles, double usable_J);

/// Consumption and range of repeated cycles with their weights; those after the first may weigh as it does.
/// Equation  EC = sum K_i E_i/d_i; range = UBE/EC; EC_AC = E_AC/range
/// Symbols   d_i distance [m], E_AC recharge energy [J]
/// Source    as calc_phase_weights(); UBE: 40 CFR 600.116-12(a)(8)
/// Checked   tests/scenarios/multi_cycle_test.cpp
CycleEconomy calc_economy(const std::vector<EnergySection>& cycles, const std::vector<double>& weights,
                          const BatteryCharge& charge);

/// A question about a battery whose range no electric vehicle has.
/// Assumed: 2000 km, above any; a battery in Wh gives a thousand times the range
std::optional<std::string> doubt_range(double range_m, double usable_J);

/// A question about a charge that gives back less or more of its energy than any charger and battery do.
/// Assumed: they give back 0.8 to 0.95; a charge is doubted below 0.7 and above 0.98
std::optional<std::string> doubt_charge(double usable_J, double recharge_J);

/// City and highway together: consumption by 55 and 45 % of the distance, ranges by the same weights.
/// Source    10 CFR 474, appendix (consumption); ranges: second-hand, as labels of electric vehicles follow from
///           certificates (docs/j1634.md)
CycleEconomy combine_economy(const CycleEconomy& city, const CycleEconomy& highway);

/// A test in the order of SAE J1634.
struct MultiCycleEconomy {
  BatteryCharge charge;
  double first_city_weight = 0.0;  // K_1 of the city cycles
  CycleEconomy city;
  CycleEconomy highway;
  CycleEconomy combined;
};

/// City cycles are weighted by calc_phase_weights(), highway cycles by one half each.
/// Checked   tests/scenarios/multi_cycle_test.cpp
MultiCycleEconomy calc_multi_cycle_economy(const std::vector<EnergySection>& city,
                                           const std::vector<EnergySection>& highway, const BatteryCharge& charge);

/// Miles per gallon of gasoline that holds as much energy.
/// Equation  MPGe = 33.7 kWh/gal / EC_AC
/// Source    EPA's 33.7 kWh per gallon, second-hand (docs/j1634.md)
double calc_mpge(double ac_J_per_m);

/// What the first city cycle took beyond the mean of the later ones over the same distance.
struct ColdExcess {
  std::optional<double> battery_share;  // of the mean of the later ones
  double wheel_J = 0.0;                 // at the hubs, driven less recuperated
  double tire_J = 0.0;                  // rolling resistance of all tires
  /// How much of what the hubs gave beyond the later cycles the tires took; nothing where that is next to nothing.
  std::optional<double> tire_share;
};

/// What a cycle took of battery, hubs and tires.
struct CycleLoss {
  EnergySection battery;
  double wheel_J = 0.0;
  double tire_J = 0.0;
};

/// Equation  X = E_1 - d_1 mean(E_i/d_i), i = 2 ... n, for each of battery, hubs and tires
/// Symbols   E energy, d distance
/// Checked   tests/scenarios/multi_cycle_test.cpp
ColdExcess calc_cold_excess(const std::vector<CycleLoss>& cycles);

}  // namespace rollrig::scenarios
