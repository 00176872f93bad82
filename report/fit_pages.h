#pragma once
/// The pages of `rollrig fit tire`, `fit road-load` and `fit drum-coastdown`.

#include "estimation/drum_deceleration/drum_coastdown.h"
#include "estimation/road_load/coastdown_file.h"
#include "estimation/road_load/road_load_checks.h"
#include "estimation/tire_fit/fit_tire.h"
#include "report/page.h"
#include "scenarios/run/results.h"

namespace rollrig::report {

/// Parameters with their intervals, measurement and fit by run with what is left, correlations.
Page make_tire_fit_page(const measurements::MeasurementSet& set, const estimation::TireFit& fit);

/// A, B, C with their intervals, points and curve, residuals, checks of the standards.
Page make_road_load_page(const estimation::CoastdownFile& file, const RoadLoadFitOptions& options,
                         const estimation::RoadLoadFit& fit, const estimation::RoadLoadChecks& checks);

/// A, B, C with standard deviation and 95 % interval, or their bound.
Table make_coefficient_table(const estimation::RoadLoadFit& fit, const std::string& title);

/// Net force or deceleration by speed and pressure, the drum alone, exponent of pressure and difference of directions.
std::vector<Table> make_drum_coastdown_tables(const estimation::CoastSet& set, const estimation::DrumCoastdownFit& fit);

/// Net force or deceleration by speed and pressure with intervals, exponent of pressure, residuals of the coasts.
Page make_drum_coastdown_page(const estimation::CoastSet& set, const estimation::DrumCoastdownFit& fit);

}  // namespace rollrig::report
