#pragma once
/// The pages of `rollrig fit tire`, `fit road-load` and `fit drum-coastdown`.

#include "identification/coastdown_file.h"
#include "identification/drum_coastdown.h"
#include "identification/fit_tire.h"
#include "identification/road_load_checks.h"
#include "report/page.h"

namespace rollrig::report {

/// Parameters with their intervals, measurement and fit by run with what is left, correlations.
Page make_tire_fit_page(const scenarios::MeasurementSet& set, const identification::TireFit& fit);

/// A, B, C with their intervals, points and curve, residuals, checks of the standards.
Page make_road_load_page(const identification::CoastdownFile& file, const scenarios::RoadLoadFitOptions& options,
                         const scenarios::RoadLoadFit& fit, const identification::RoadLoadChecks& checks);

/// Net force or deceleration by speed and pressure with intervals, exponent of pressure, residuals of the coasts.
Page make_drum_coastdown_page(const identification::CoastSet& set, const identification::DrumCoastdownFit& fit);

}  // namespace rollrig::report
