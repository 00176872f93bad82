#include <fmt/format.h>

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

Report fit_drum_coastdown(const std::string& set_file, const std::string& data, BadRows bad_rows) {
  const auto set = std::make_shared<const estimation::CoastSet>(estimation::read_coast_set(set_file, data, bad_rows));
  const auto fit = std::make_shared<estimation::DrumCoastdownFit>(estimation::fit_drum_coastdown(*set));
  for (const estimation::CoastRun* run : estimation::list_runs_with_bad_rows(*set)) {
    fit->warnings.push_back(measurements::describe_left_out(run->left_out, "", run->file, "field"));
  }
  Report report;
  report.text = format_drum_coastdown(*set, *fit);
  report.json = to_text(estimation::make_coastdown_json(*set, *fit));
  report.make_files = [set, fit, json = report.json] {
    return FolderFiles{{"fit.json", json},
                       {"decelerations.csv", estimation::make_deceleration_csv(*set, *fit)},
                       {"residuals.csv", estimation::make_residual_csv(*set, *fit)}};
  };
  report.make_page = [set, fit] { return report::make_html(report::make_drum_coastdown_page(*set, *fit)); };
  return report;
}

}  // namespace rollrig
