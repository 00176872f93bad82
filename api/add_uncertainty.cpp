#include "api/add_uncertainty.h"

#include "api/option_range.h"
#include "estimation/uncertainty/uncertainty.h"
#include "report/blocks.h"

namespace rollrig {

void check_uncertainty(const UncertaintyOptions& options) {
  require_threads(options.threads);
  estimation::check_trials(options.monte_carlo_trials, "--monte-carlo");
}

bool wants_uncertainty(const UncertaintyOptions& options, bool is_possible) {
  return options.budget || options.monte_carlo_trials > 0 || (options.budget_if_any && is_possible);
}

std::vector<Table> add_uncertainty(const estimation::MeasurementModel& model, const UncertaintyOptions& options,
                                   const Progress& progress, Json& json) {
  const estimation::Uncertainty uncertainty =
      estimation::calc_uncertainty(model, {options.monte_carlo_trials, options.seed, options.threads}, progress);
  json["uncertainty"] = estimation::make_uncertainty_json(uncertainty);
  return estimation::make_uncertainty_tables(uncertainty);
}

std::string make_page_with_uncertainty(report::Page page, const std::vector<Table>& uncertainty) {
  if (!uncertainty.empty()) page.add_behind_first(report::make_section("Uncertainty", uncertainty, {}));
  return report::make_html(page);
}

}  // namespace rollrig
