#include <fmt/format.h>

#include "api/add_uncertainty.h"
#include "estimation/drum_deceleration/coast_uncertainty.h"
#include "report/fit_pages.h"
#include "rollrig/fit.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

std::string format_drum_coastdown(const estimation::CoastSet& set, const estimation::DrumCoastdownFit& fit) {
  std::size_t rows = 0;
  for (const estimation::CoastAnalysis& analysis : fit.analyses) rows += analysis.coast.time_s.size();
  return fmt::format("fit drum-coastdown   set {}   {}   {} of coast\n", set.name, format_count(set.runs.size(), "run"),
                     format_count(rows, "row")) +
         format_tables(report::make_drum_coastdown_tables(set, fit)) + format_warnings(fit.warnings);
}

}  // namespace

Report fit_drum_coastdown(const std::string& set_file, const std::string& data, BadRows bad_rows,
                          const UncertaintyOptions& uncertainty, const Progress& progress) {
  check_uncertainty(uncertainty);
  const auto set = std::make_shared<const estimation::CoastSet>(estimation::read_coast_set(set_file, data, bad_rows));
  const auto fit = std::make_shared<estimation::DrumCoastdownFit>(estimation::fit_drum_coastdown(*set));
  for (const estimation::CoastRun* run : estimation::list_runs_with_bad_rows(*set)) {
    fit->warnings.push_back(measurements::describe_left_out(run->left_out, "", run->file, "field"));
  }
  Report report;
  report.text = format_drum_coastdown(*set, *fit);
  Json json = estimation::make_coastdown_json(*set, *fit);
  std::vector<Table> budgets;
  if (wants_uncertainty(uncertainty)) {
    budgets = add_uncertainty(estimation::make_coast_model(*set, *fit), uncertainty, progress, json);
    report.text += format_tables(budgets);
  }
  report.json = to_text(json);
  report.make_files = [set, fit, json = report.json] {
    return FolderFiles{{"fit.json", json},
                       {"decelerations.csv", estimation::make_deceleration_csv(*set, *fit)},
                       {"residuals.csv", estimation::make_residual_csv(*set, *fit)}};
  };
  report.make_page = [set, fit, budgets] {
    return make_page_with_uncertainty(report::make_drum_coastdown_page(*set, *fit), budgets);
  };
  return report;
}

}  // namespace rollrig
