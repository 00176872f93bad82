#include <fmt/format.h>

#include "report/fit_pages.h"
#include "report/text.h"
#include "rollrig/fit.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

std::string format_drum_coastdown(const estimation::CoastSet& set, const estimation::DrumCoastdownFit& fit) {
  std::size_t missed = 0, doubled = 0, other = 0, rows = 0;
  for (const estimation::CoastAnalysis& analysis : fit.analyses) {
    rows += analysis.coast.time_s.size();
    missed += analysis.coast.missed;
    doubled += analysis.coast.doubled;
    other += analysis.coast.other;
  }
  std::string text = fmt::format("fit drum-coastdown   set {}   {}   {} of coast\n", set.name,
                                 format_count(set.runs.size(), "run"), format_count(rows, "row"));
  text += fmt::format("  pulses rejected: {} missed, {} double, {} other\n", missed, doubled, other);
  text += fmt::format("  reference: {:.1f} kPa, {:.1f} km/h\n", fit.reference_pressure_Pa / 1e3,
                      3.6 * set.reference_speed_m_s);
  for (const Table& table : report::make_drum_coastdown_tables(set, fit)) text += format_table(table);
  for (const std::string& warning : fit.warnings) text += wrap("warning: " + warning, 2);
  return text;
}

}  // namespace

Report fit_drum_coastdown(const std::string& set_file, const std::string& data) {
  const auto set = std::make_shared<const estimation::CoastSet>(estimation::read_coast_set(set_file, data));
  const auto fit = std::make_shared<const estimation::DrumCoastdownFit>(estimation::fit_drum_coastdown(*set));
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
