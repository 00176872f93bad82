#pragma once
/// How a tire and a road load are fitted.

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "progress.h"

#pragma GCC visibility push(default)
namespace rollrig {

struct TireFitOptions {
  std::string name;       // of the fitted tire; empty: that of the set's tire with _fit
  bool load_map = false;  // A0, A1, B0, B1 at each load of the set; of laws that have them
  bool free_H = false;    // H also where the gas temperature was not measured
  int threads = 0;        // 0: as many as the machine has
  Progress progress = {};
};

/// Lower and upper bound of A, B, C in SI units; infinite where there is none. Not set: none negative.
struct RoadLoadBounds {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  std::array<double, 3> lower{};
  std::array<double, 3> upper{kNone, kNone, kNone};
};

struct RoadLoadFitOptions {
  std::optional<double> mass_kg;            // as tested; absent: forces per unit of effective mass
  std::optional<double> rotating_mass_kg;   // absent: 3 % of the mass as tested (SAE J2263: effective mass 1.03 M)
  std::optional<double> drag_area_m2;       // for the wind; absent: all of C is drag
  double reference_temperature_K = 293.15;  // 40 CFR 1066.305
  double reference_pressure_Pa = 98.21e3;   // 40 CFR 1066.305
  double rolling_fall_per_K = 8.6e-3;       // of A and B with ambient temperature; docs/fit_road_load.md
  double speed_from_m_s = 15.0 / 3.6;       // SAE J2263, scope
  double speed_to_m_s = std::numeric_limits<double>::infinity();
  double bin_width_m_s = 5.0 / 3.6;  // of a trace. Assumed
  std::optional<RoadLoadBounds> bounds;
  std::optional<std::array<double, 3>> target;  // A, B, C in SI units, with which the result is compared
  std::vector<std::string> leave_out;           // runs: "7", or "session/7"
  bool recorded_vehicle = false;                // masses and drag area from the manifest beside a recording
};

}  // namespace rollrig
#pragma GCC visibility pop
