#pragma once
/// The tables of `rollrig fit j2452` and `fit j1269` for terminal and page, their pages and test reports.

#include <optional>

#include "estimation/rolling_law/rolling_output.h"
#include "report/page.h"
#include "report/test_report.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// Coefficients, reference condition with mean forces, residuals.
std::vector<Table> make_j2452_tables(const estimation::J2452Fit& fit,
                                     const std::optional<estimation::J2452Reference>& reference);

/// These tables, points and law over speed, the law over load and pressure, residuals.
Page make_j2452_page(const estimation::RollingTest& test, const estimation::J2452Fit& fit,
                     const std::optional<estimation::J2452Reference>& reference);

std::vector<Table> make_multipoint_tables(const estimation::MultipointFit& fit,
                                          const std::optional<estimation::MultipointReference>& reference);

/// These tables, points and law over load, residuals.
Page make_multipoint_page(const estimation::RollingTest& test, const estimation::MultipointFit& fit,
                          const std::optional<estimation::MultipointReference>& reference);

/// The test report of either fit, with the numbers of its JSON.
TestReport make_rolling_law_report(const estimation::RollingTest& test, const Json& json,
                                   const std::vector<ReportFile>& files);

}  // namespace rollrig::report
