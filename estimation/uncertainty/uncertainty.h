#pragma once
/// Budgets and, where asked for, Monte Carlo of the results of one measurement, as every command shows them.

#include <optional>
#include <vector>

#include "estimation/uncertainty/monte_carlo.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig::estimation {

struct Uncertainty {
  std::vector<UncertaintyBudget> budgets;
  std::optional<MonteCarlo> monte_carlo;
  std::vector<std::string> left_out;  // as in MeasurementModel
};

/// How far it is, and with what.
using UncertaintyProgress = std::function<void(double done, const std::string& stage)>;

/// Budgets, and Monte Carlo where the request has trials. Throws RunFailure, Interrupted.
Uncertainty calc_uncertainty(const MeasurementModel& model, const UncertaintyRequest& request,
                             const UncertaintyProgress& progress = {});

/// `uncertainty` of result.json, in the units of the keys: see docs/reports.md.
Json make_uncertainty_json(const Uncertainty& uncertainty);

/// The same for the terminal: the budgets, then Monte Carlo beside the GUM.
std::vector<Table> make_uncertainty_tables(const Uncertainty& uncertainty);

/// Where a budget, as in the JSON, states less than one of its inputs alone would: why it does. Else empty.
std::string doubt_budget(const Json& budget);

/// "agrees", "differs", "not decided".
const char* name_of(GumVerdict verdict);
/// What they say of a result, as a sentence, with the number of trials that would decide it.
std::string describe_verdict(const Json& result);

/// Throws InputError unless there are enough trials and not too many; `option` is what was given.
void check_trials(int trials, const std::string& option);

}  // namespace rollrig::estimation
