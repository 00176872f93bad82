#pragma once
/// Models from measurements: a tire from warm-ups, a road load from coastdowns, rolling resistance from a coasting
/// drum.

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measurement_set.h"
#include "progress.h"
#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

struct TireFitOptions {
  std::string name;       // of the fitted tire; empty: that of the set's tire with _fit
  bool load_map = false;  // A0, A1, B0, B1 at each load of the set
  bool free_H = false;    // H also where the gas temperature was not measured
  int threads = 0;        // 0: as many as the machine has
  Progress progress = {};
};

/// A fitted tire. Its files: the tire file and fit.json.
struct TireFit : Report {
  std::vector<ParameterEstimate> parameters;  // by key of the tire file
  std::vector<std::string> warnings;
  std::string suspicion;  // why columns, units or files cannot be what they are said to be; else empty
};

/// Method: docs/fit_tire.md.
/// Errors  InputError: not a drum set, fewer than two speeds; RunFailure: no convergence, or data that leave a
///         parameter undecided
TireFit fit_tire(const MeasurementSet& set, const TireFitOptions& options = {});

/// Lower and upper bound of A, B, C in SI units; infinite where there is none. Not set: none negative.
struct RoadLoadBounds {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  std::array<double, 3> lower{};
  std::array<double, 3> upper{kNone, kNone, kNone};
};

struct RoadLoadFitOptions {
  std::optional<double> mass_kg;            // test mass; absent: forces per unit of effective mass
  std::optional<double> rotating_mass_kg;   // absent: 3 % of the test mass (SAE J2263: effective mass 1.03 M)
  std::optional<double> drag_area_m2;       // for the wind; absent: all of C is drag
  double reference_temperature_K = 293.15;  // 40 CFR 1066.305
  double reference_pressure_Pa = 98.21e3;   // 40 CFR 1066.305
  double rolling_fall_per_K = 8.6e-3;       // of A and B with ambient temperature; docs/fit_road_load.md
  double speed_from_m_s = 15.0 / 3.6;       // SAE J2263, scope
  double speed_to_m_s = 1e9;
  double bin_width_m_s = 5.0 / 3.6;  // of a trace. Assumed
  std::optional<RoadLoadBounds> bounds;
};

/// A, B, C of a vehicle. Its files: road_load.json, residuals.csv.
struct RoadLoad : Report {
  std::vector<ParameterEstimate> coefficients;  // A, B, C in the units of road_load.json
  std::vector<std::string> warnings;
};

/// From a CSV of coastdowns on a road or a dynamometer, of the given sessions or of all. Method: docs/fit_road_load.md.
/// Errors  InputError: a wrong file, an unknown session, fewer than four bins; RunFailure: A, B, C not decided by the
///         speeds, no convergence
RoadLoad fit_road_load(const std::string& file, const RoadLoadFitOptions& options,
                       const std::vector<std::string>& sessions = {});

/// Rolling resistance from coast-downs of a drum, by the deceleration method of ISO 28580
/// (docs/fit_drum_coastdown.md). `set` is a .toml file, `data` the folder of its CSV files, empty: that of the set.
/// Files of the report: fit.json, decelerations.csv, residuals.csv.
/// Errors  InputError: a wrong file, no coast in a run; RunFailure: no speed at which loaded and lifted runs both pass
Report fit_drum_coastdown(const std::string& set, const std::string& data = "");

}  // namespace rollrig
#pragma GCC visibility pop
