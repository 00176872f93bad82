#pragma once
/// The uncertainty of a result, as every call of the API adds it.

#include <string>

#include "estimation/uncertainty/measurement_model.h"
#include "rollrig/progress.h"
#include "rollrig/uncertainty_options.h"
#include "sim/core/json.h"

namespace rollrig {

/// Whether a budget or Monte Carlo is asked for or, where `is_possible`, is to be there if it can.
bool wants_uncertainty(const UncertaintyOptions& options, bool is_possible);

/// Adds `uncertainty` to the JSON of a result, and returns its tables for the terminal. Throws RunFailure, Interrupted.
std::string add_uncertainty(const estimation::MeasurementModel& model, const UncertaintyOptions& options,
                            const Progress& progress, Json& json);

}  // namespace rollrig
