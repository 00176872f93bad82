#pragma once
/// A road load by the procedures of UN GTR 15 and UN R154 (WLTP), of SAE J2263 and of SAE J1263, and the default road
/// load of the WLTP.

#include <string>
#include <vector>

#include "bad_rows.h"
#include "fit.h"
#include "progress.h"
#include "road_load_options.h"
#include "uncertainty_options.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// A road load by a procedure. Its files: road_load.json, points.csv. It has a test report. Method:
/// docs/road_load_procedures.md.
/// Errors  InputError: a wrong file, no mass, one heading alone, fewer than three pairs, wind above the limits of the
///         procedure in too many runs; RunFailure: coefficients that the speeds do not decide; Interrupted
RoadLoad evaluate_road_load(const std::string& file, const RoadLoadProcedureOptions& options,
                            const std::vector<std::string>& sessions = {}, BadRows bad_rows = BadRows::kRefuse,
                            const UncertaintyOptions& uncertainty = {}, const Progress& progress = {});

/// The default road load of the WLTP, from mass, width and height alone, and the class value of a tire's rolling
/// resistance. Its file: road_load.json.
/// Errors  InputError: an unknown class of tires
RoadLoad calc_default_road_load(const DefaultRoadLoadOptions& options);

}  // namespace rollrig
#pragma GCC visibility pop
