#pragma once
/// A fitted road load as JSON and as CSV.

#include <optional>
#include <string>
#include <vector>

#include "estimation/road_load/coastdown_file.h"
#include "estimation/road_load/road_load_checks.h"
#include "include/rollrig/result.h"
#include "sim/core/json.h"

namespace rollrig::estimation {

/// Key of A, B or C (i = 0, 1, 2) in files: "B_N_per_km_h", or "B_m_s2_per_km_h" per unit of effective mass.
std::string road_load_key(int i, bool per_mass);
/// An SI value of A, B or C in the unit of that key.
double road_load_in_file_unit(int i, double si_value);

/// An SI value of A, B or C in lbf and mph, the units of dynamometer settings in the United States.
double road_load_in_lbf_mph(int i, double si_value);
/// The SI value of one that is given in lbf and mph.
double road_load_from_lbf_mph(int i, double value);
/// Key of A, B or C in lbf and mph: "B_lbf_per_mph".
std::string road_load_lbf_key(int i);

/// A, B, C in lbf and mph, with intervals.
std::vector<ParameterEstimate> list_coefficients_lbf_mph(const RoadLoadFit& fit);

/// A, B, C in the units of files; a coefficient on a bound has no standard deviation.
std::vector<ParameterEstimate> list_coefficients(const RoadLoadFit& fit);

const char* name_of(CheckStatus status);

/// Speeds at which the force of a fitted road load is shown: 20, 50, 80, 100 and 130 km/h.
const std::vector<double>& shown_speeds_m_s();

/// The force of a fitted road load at one of these speeds.
struct ShownForce {
  double speed_m_s = 0.0;
  double force_N = 0.0;  // per unit of mass where no mass is given
  double sd_N = 0.0;
  std::optional<double> target_N;
  bool is_outside = false;  // of the speeds of the data

  double calc_over_target_percent() const { return 100.0 * (force_N / target_N.value() - 1.0); }
};
std::vector<ShownForce> list_shown_forces(const RoadLoadFitOptions& options, const RoadLoadFit& fit);

/// `road_load.json`: see docs/formats.md.
Json make_road_load_json(const CoastdownFile& file, const RoadLoadFitOptions& options, const RoadLoadFit& fit,
                         const RoadLoadChecks& checks);

/// `residuals.csv`: one row a speed bin and run.
std::string write_road_load_residuals(const CoastdownFile& file, const RoadLoadFit& fit);

}  // namespace rollrig::estimation
