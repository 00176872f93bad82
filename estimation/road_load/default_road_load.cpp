#include "estimation/road_load/default_road_load.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "sim/core/error.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::estimation {

Eigen::Vector3d calc_default_road_load(double mass_kg, double width_m, double height_m) {
  constexpr double kRolling_N_per_kg = 0.140;
  constexpr double kDragOfMass = 2.8e-6;  // N/(km/h)^2 a kg
  constexpr double kDragOfArea = 0.0170;  // N/(km/h)^2 a m2
  const double drag = kDragOfMass * mass_kg + kDragOfArea * width_m * height_m;
  return {kRolling_N_per_kg * mass_kg, 0.0, drag * kKmhPerMs * kKmhPerMs};
}

const std::vector<RrcClass>& list_rrc_classes(const std::string& tire_class) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  static const std::map<std::string, std::vector<RrcClass>> kClasses{
      {"C1",
       {{'A', 6.5, 5.9}, {'B', 7.7, 7.1}, {'C', 9.0, 8.4}, {'E', 10.5, 9.8}, {'F', 12.0, 11.3}, {'G', kNone, 12.9}}},
      {"C2",
       {{'A', 5.5, 4.9}, {'B', 6.7, 6.1}, {'C', 8.0, 7.4}, {'E', 9.2, 8.6}, {'F', 10.5, 9.9}, {'G', kNone, 11.2}}},
      {"C3", {{'A', 4.0, 3.5}, {'B', 5.0, 4.5}, {'C', 6.0, 5.5}, {'D', 7.0, 6.5}, {'E', 8.0, 7.5}, {'F', kNone, 8.5}}}};
  const auto found = kClasses.find(tire_class);
  if (found != kClasses.end()) return found->second;
  InputProblem problem = unknown_name("class of tires", tire_class, {"C1", "C2", "C3"});
  problem.file = "command line";
  problem.key = "--tire-class";
  throw InputError(problem);
}

const RrcClass& find_rrc_class(const std::string& tire_class, double rrc_N_per_kN) {
  const std::vector<RrcClass>& classes = list_rrc_classes(tire_class);
  const double to_one_decimal = 0.1 * std::round(10.0 * rrc_N_per_kN);
  constexpr double kSame = 1e-6;
  const auto found = std::find_if(classes.begin(), classes.end(), [to_one_decimal](const RrcClass& at) {
    return to_one_decimal <= at.most_N_per_kN + kSame;
  });
  if (found != classes.end()) return *found;
  throw InputError({"this is no rolling resistance coefficient", "command line", 0, "--rrc",
                    fmt::format("{:g}", rrc_N_per_kN), "a number in N/kN", ""});
}

}  // namespace rollrig::estimation
