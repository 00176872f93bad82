#include "api/add_uncertainty.h"

#include "estimation/uncertainty/uncertainty.h"

namespace rollrig {

void check_uncertainty(const UncertaintyOptions& options) {
  estimation::check_trials(options.monte_carlo_trials, "--monte-carlo");
}

bool wants_uncertainty(const UncertaintyOptions& options, bool is_possible) {
  return options.budget || options.monte_carlo_trials > 0 || (options.budget_if_any && is_possible);
}

std::string add_uncertainty(const estimation::MeasurementModel& model, const UncertaintyOptions& options,
                            const Progress& progress, Json& json) {
  const estimation::Uncertainty uncertainty =
      estimation::calc_uncertainty(model, {options.monte_carlo_trials, options.seed, options.threads}, progress);
  json["uncertainty"] = estimation::make_uncertainty_json(uncertainty);
  return format_tables(estimation::make_uncertainty_tables(uncertainty));
}

}  // namespace rollrig
