#include "estimation/road_load/road_load_doubts.h"

#include <fmt/format.h>

#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

constexpr double kAirDensity_kg_m3 = 1.2;

double calc_drag_area_m2(const models::RoadLoad<double>& load) { return 2.0 * load.C_N_s2_per_m2 / kAirDensity_kg_m3; }

/// The unit in which loss, drag area and highest speed would be those of a car, if km/h is not; empty for none.
std::string guess_unit_of_speeds(const models::RoadLoad<double>& load, double mass_kg, double top_speed_m_s) {
  // Assumed: rolling loss of a car at 50 km/h is 0.004 to 0.016 of its weight, and its drag area over mass and that
  // share is below 0.075 m2/kg. Speeds in a larger unit that are taken for km/h divide f0 by its length in km/h,
  // multiply f2 by it, and end near 80 (mph) or 40 (m/s).
  constexpr double kMostRolling = 0.0075;
  constexpr double kMostRatio = 0.085;
  constexpr double kMostTop_m_s = 110.0 / 3.6;
  constexpr double kMostTopInMs_m_s = 60.0 / 3.6;
  constexpr double kMph_km_h = kMph_m_s * kKmhPerMs;
  const double rolling = calc_rolling_share(load, mass_kg);
  const double ratio = rolling > 0.0 ? calc_drag_area_m2(load) / mass_kg / rolling : 0.0;
  if (top_speed_m_s >= kMostTop_m_s || rolling >= kMostRolling || ratio <= kMostRatio) return "";
  const bool is_usual_in_mph = ratio / (kMph_km_h * kMph_km_h) <= kMostRatio;
  const bool is_usual_in_m_s = ratio / (kKmhPerMs * kKmhPerMs) <= kMostRatio && top_speed_m_s < kMostTopInMs_m_s;
  return is_usual_in_m_s && !is_usual_in_mph ? "m/s" : "mph";
}

}  // namespace

double calc_rolling_share(const models::RoadLoad<double>& load, double mass_kg) {
  constexpr double kAt_m_s = 50.0 / 3.6;
  return (load.A_N + load.B_N_s_per_m * kAt_m_s) / (mass_kg * kStandardGravity_m_s2);
}

std::vector<std::string> doubt_road_load(const models::RoadLoad<double>& load, double mass_kg, double top_speed_m_s) {
  constexpr double kLeastRolling = 0.0025;  // Assumed: the best tires have 0.004; a car's loss in lbf is below it
  constexpr double kMostRolling = 0.03;     // Assumed: far from that of cars
  constexpr double kLeast_m2 = 0.15;  // Assumed: a velomobile has less, the slimmest cars 0.4
  constexpr double kMost_m2 = 15.0;   // Assumed: trucks with a trailer have up to 10
  const double rolling = calc_rolling_share(load, mass_kg);
  const double area_m2 = calc_drag_area_m2(load);
  const std::string unit = guess_unit_of_speeds(load, mass_kg, top_speed_m_s);
  if (!unit.empty()) {
    return {fmt::format(
        "the rolling loss is {:.4f} of the weight, which is low, the term with v^2 is that of a drag area of {:.2f} "
        "m2, which is high for {:.0f} kg, and the speeds end near {:.0f}. All would be usual if they were in {} and "
        "not in km/h",
        rolling, area_m2, mass_kg, kKmhPerMs * top_speed_m_s, unit)};
  }
  std::vector<std::string> doubts;
  if (rolling > kMostRolling || (rolling > 0.0 && rolling < kLeastRolling)) {
    doubts.push_back(fmt::format(
        "the rolling loss at 50 km/h is {:.4f} of the weight; that of cars is about 0.004 to 0.016. Are mass and units "
        "right?",
        rolling));
  }
  if (area_m2 > 0.0 && (area_m2 < kLeast_m2 || area_m2 > kMost_m2)) {
    doubts.push_back(fmt::format(
        "the term with v^2 is that of a drag area of {:.2g} m2; road vehicles have 0.3 to 10. All forces are in "
        "proportion to the mass: is {:g} kg right?",
        area_m2, mass_kg));
  }
  return doubts;
}

std::optional<std::string> doubt_torque_scale(const models::RoadLoad<double>& load, double mass_kg, double radius_m) {
  constexpr double kLowRolling = 0.0055;  // Assumed: of the weight; few cars have less, and these not the next as well
  constexpr double kLowDrag_m2 = 0.45;    // Assumed
  constexpr double kMostRadius_m = 0.45;  // Assumed: of a car
  constexpr double kMostCar_kg = 3500.0;
  const double rolling = calc_rolling_share(load, mass_kg);
  const double area_m2 = calc_drag_area_m2(load);
  const bool is_half = rolling < kLowRolling && area_m2 < kLowDrag_m2;
  if (!is_half && !(radius_m > kMostRadius_m && mass_kg < kMostCar_kg)) return std::nullopt;
  return fmt::format(
      "the wheel radius is {:.3f} m, the rolling loss {:.4f} of the weight, the drag area {:.2f} m2: is the radius not "
      "a diameter, and wheel_torque_Nm the sum of all driven wheels? Either mistake halves the forces",
      radius_m, rolling, area_m2);
}

std::vector<std::string> doubt_masses(double mass_kg, const std::optional<double>& rotating_mass_kg,
                                      const std::optional<double>& corrected_to_mass_kg) {
  constexpr double kLeastRotating = 0.005, kMostRotating = 0.15;  // Assumed: far from those of vehicles in neutral
  constexpr double kMostCorrection = 1.25;                        // Assumed: of one vehicle, empty and laden
  std::vector<std::string> doubts;
  const double share = rotating_mass_kg.value_or(0.03 * mass_kg) / mass_kg;
  if (share < kLeastRotating || share > kMostRotating) {
    doubts.push_back(fmt::format(
        "the rotating mass is {:.3g} % of the mass; that of a vehicle in neutral is about 2 to 6 %: are its mass "
        "({:g} kg) and its rotating mass ({:g} kg, also within --effective-mass) right?",
        100.0 * share, mass_kg, *rotating_mass_kg));
  }
  const double ratio = corrected_to_mass_kg.value_or(mass_kg) / mass_kg;
  if (ratio > kMostCorrection || ratio < 1.0 / kMostCorrection) {
    doubts.push_back(fmt::format(
        "f0 is corrected to {:g} kg, {:.3g} times the mass as tested: is --corrected-mass in kg, and that of this "
        "vehicle?",
        *corrected_to_mass_kg, ratio));
  }
  return doubts;
}

}  // namespace rollrig::estimation
