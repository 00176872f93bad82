#pragma once
/// The tables of `rollrig fit tire`, `fit road-load` and `fit drum-coastdown` for terminal and page, and their pages.

#include "estimation/drum_deceleration/drum_coastdown.h"
#include "estimation/road_load/coastdown_file.h"
#include "estimation/road_load/road_load_checks.h"
#include "estimation/tire_fit/fit_tire.h"
#include "report/page.h"
#include "report/test_report.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// Fitted numbers, what is left of each channel, the regression from which the fit starts.
std::vector<Table> make_tire_fit_tables(const estimation::TireFit& fit);

/// These tables, measurement and fit by run with what is left, correlations.
Page make_tire_fit_page(const measurements::MeasurementSet& set, const estimation::TireFit& fit);

/// A, B, C; force by speed; scatter, slope, wind and drift; checks of the standards.
std::vector<Table> make_road_load_tables(const RoadLoadFitOptions& options, const estimation::RoadLoadFit& fit,
                                         const estimation::RoadLoadChecks& checks);

/// These tables, points and curve, residuals.
Page make_road_load_page(const estimation::CoastdownFile& file, const RoadLoadFitOptions& options,
                         const estimation::RoadLoadFit& fit, const estimation::RoadLoadChecks& checks);

/// The test report of coastdowns; `result` is road_load.json, with `uncertainty` where it was asked for.
TestReport make_road_load_report(const estimation::CoastdownFile& file, const Json& result,
                                 const std::vector<ReportFile>& files);

/// Rejected pulses, net force or deceleration by speed and pressure, the drum alone, exponent of pressure and
/// difference of directions.
std::vector<Table> make_drum_coastdown_tables(const estimation::CoastSet& set, const estimation::DrumCoastdownFit& fit);

/// These tables, charts of force and exponent with their intervals, residuals of the coasts.
Page make_drum_coastdown_page(const estimation::CoastSet& set, const estimation::DrumCoastdownFit& fit);

}  // namespace rollrig::report
