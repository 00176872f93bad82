#include <fmt/format.h>

#include <optional>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/print.h"
#include "estimation/drum_deceleration/drum_coastdown.h"
#include "report/fit_pages.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

using estimation::CoastSet;
using estimation::DrumCoastdownFit;

struct Options {
  std::string set;
  std::string data;
  OutputOptions output;
};

std::string format_fit(const CoastSet& set, const DrumCoastdownFit& fit) {
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
  for (const scenarios::ResultTable& table : report::make_drum_coastdown_tables(set, fit)) text += format_table(table);
  for (const std::string& warning : fit.warnings) text += wrap("warning: " + warning, 2);
  return text;
}

int fit_drum_coastdown_command(const Options& options) {
  const CoastSet set = estimation::read_coast_set(options.set, options.data);
  Output output(options.output);
  const DrumCoastdownFit fit = estimation::fit_drum_coastdown(set);
  const std::string json = to_text(estimation::make_coastdown_json(set, fit));
  output.write({{"fit.json", json},
                {"decelerations.csv", estimation::make_deceleration_csv(set, fit)},
                {"residuals.csv", estimation::make_residual_csv(set, fit)}},
               json, [&] { return report::make_drum_coastdown_page(set, fit); });
  output.print(format_fit(set, fit));
  return kDone;
}

}  // namespace

void add_fit_drum_coastdown_command(CLI::App& fit, Action& action) {
  const auto [command, options] = add_command<Options>(
      fit, action, "drum-coastdown", "Rolling resistance from coast-downs of a drum, tire loaded and lifted",
      &fit_drum_coastdown_command);
  command->add_option("set", options->set, "Set of coast-downs (.toml)")->required();
  command->add_option("--data", options->data, "Folder of the set's CSV files [that of the set]");
  options->output.add_to(*command, "File for fit.json, - for standard output",
                         "Folder for fit.json, decelerations.csv, residuals.csv");
}

}  // namespace rollrig::cli
