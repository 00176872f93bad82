#pragma once
/// Adds the uncertainty to a result, in every call of the API that has one.

#include <string>
#include <vector>

#include "estimation/uncertainty/measurement_model.h"
#include "report/page.h"
#include "rollrig/progress.h"
#include "rollrig/uncertainty_options.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig {

/// Throws InputError where the number of trials is out of range.
void check_uncertainty(const UncertaintyOptions& options);

/// Whether the caller asked for a budget or for Monte Carlo. `budget_if_any` counts only if there can be a budget.
bool wants_uncertainty(const UncertaintyOptions& options, bool is_possible = true);

/// Adds `uncertainty` to the JSON of a result, and returns its tables. Throws RunFailure, Interrupted.
std::vector<Table> add_uncertainty(const estimation::MeasurementModel& model, const UncertaintyOptions& options,
                                   const Progress& progress, Json& json);

/// Gives the tiles of results that have a budget its expanded uncertainty, in place of a part of it. `uncertainty` is
/// that of the JSON.
void put_budgets_on_tiles(const Json& uncertainty, report::Page& page);

/// The page of a result with the tables of its uncertainty, where there are some, behind the result.
std::string make_page_with_uncertainty(report::Page page, const std::vector<Table>& uncertainty);

}  // namespace rollrig
