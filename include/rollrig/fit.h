#pragma once
/// Models from measurements: a tire from warm-ups, a road load from coastdowns, rolling resistance from a coasting
/// drum.

#include <string>
#include <vector>

#include "bad_rows.h"
#include "fit_options.h"
#include "measurement_set.h"
#include "progress.h"
#include "result.h"
#include "uncertainty_options.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// A fitted tire. Its files: the tire file and fit.json.
struct TireFit : Report {
  std::vector<ParameterEstimate> parameters;  // by key of the tire file
  std::vector<std::string> warnings;
  std::string suspicion;  // why columns, units or files cannot be what they are said to be; else empty
};

/// Method: docs/fit_tire.md.
/// Errors  InputError: not a drum set, no speed with loss and temperature of a law with A0 to B1, a load map where it
///         does not go with the law or of one speed; RunFailure: no convergence, or data that leave a parameter
///         undecided
TireFit fit_tire(const MeasurementSet& set, const TireFitOptions& options = {});

/// A, B, C of a vehicle. Its files: road_load.json, residuals.csv.
struct RoadLoad : Report {
  std::vector<ParameterEstimate> coefficients;  // A, B, C in the units of road_load.json
  std::vector<std::string> warnings;
};

/// From a CSV of coastdowns on a road or a dynamometer, of the given sessions or of all. Method: docs/fit_road_load.md.
/// Errors  InputError: a wrong file, an unknown session, fewer than four bins; RunFailure: A, B, C not decided by the
///         speeds, no convergence; Interrupted
RoadLoad fit_road_load(const std::string& file, const RoadLoadFitOptions& options,
                       const std::vector<std::string>& sessions = {}, BadRows bad_rows = BadRows::kRefuse,
                       const UncertaintyOptions& uncertainty = {}, const Progress& progress = {});

/// Rolling resistance from coast-downs of a drum, by the deceleration method of ISO 28580
/// (docs/fit_drum_coastdown.md). `set` is a .toml file, `data` the folder of its CSV files, empty: that of the set.
/// Files of the report: fit.json, decelerations.csv, residuals.csv. The uncertainty is that at the reference speed.
/// Errors  InputError: a wrong file, no coast in a run; of an uncertainty, no result at the reference speed.
///         RunFailure: no speed at which loaded and lifted runs both pass
Report fit_drum_coastdown(const std::string& set, const std::string& data = "", BadRows bad_rows = BadRows::kRefuse,
                          const UncertaintyOptions& uncertainty = {}, const Progress& progress = {});

}  // namespace rollrig
#pragma GCC visibility pop
