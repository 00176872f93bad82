#pragma once
/// A road load by the procedure of a regulation or a standard: tables, JSON, points and page.

#include <string>
#include <vector>

#include "estimation/road_load/road_load_procedure.h"
#include "include/rollrig/result.h"
#include "report/page.h"
#include "report/test_report.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// "UN GTR 15 and UN R154 (WLTP), coastdown" and its like.
std::string title_of(RoadLoadProcedureKind kind);

std::vector<Table> make_procedure_tables(const estimation::RoadLoadProcedure& procedure);

/// `road_load.json`: see docs/formats.md.
Json make_procedure_json(const estimation::RoadLoadProcedure& procedure);

/// `points.csv`: measured and fitted resistance by run and speed.
std::string write_procedure_points(const estimation::RoadLoadProcedure& procedure);

/// The test report, with the numbers of its JSON.
TestReport make_procedure_report(const estimation::RoadLoadProcedure& procedure, const std::string& source,
                                 const Json& json, const std::vector<ReportFile>& files);

Page make_procedure_page(const estimation::RoadLoadProcedure& procedure, const std::string& source);

/// f0, f1, f2 in the units of files, with intervals.
std::vector<ParameterEstimate> list_procedure_coefficients(const estimation::RoadLoadProcedure& procedure);

}  // namespace rollrig::report
