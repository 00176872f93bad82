#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/html_option.h"
#include "cli/output_files.h"
#include "cli/print.h"
#include "estimation/drum_deceleration/drum_coastdown.h"
#include "report/fit_pages.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

using estimation::CoastSet;
using estimation::DrumCoastdownFit;
using estimation::Interval;
using estimation::PressureLevel;
using estimation::SpeedPoint;

struct Options {
  std::string set;
  std::string data;
  std::string out;
  std::string json;
  HtmlOption html;
  bool force = false;
  bool quiet = false;
};

std::string show(const std::optional<Interval>& interval, double unit = 1.0, const char* digits = "{:.3f}") {
  if (!interval.has_value()) return "-";
  const auto number = [digits](double value) { return fmt::format(fmt::runtime(digits), value); };
  return fmt::format("{} ({} to {})", number(interval->value / unit), number(interval->lower / unit),
                     number(interval->upper / unit));
}

scenarios::ResultTable make_level_table(const DrumCoastdownFit& fit, bool forces) {
  scenarios::ResultTable table{"Net of the drum's own loss, with 95 % interval; * interpolated",
                               {"km/h", "kPa", "runs", forces ? "force N" : "net mm/s2", "over the reference"},
                               {}};
  for (const SpeedPoint& point : fit.points) {
    for (const PressureLevel& level : point.levels) {
      table.rows.push_back({fmt::format("{:.1f}{}", 3.6 * point.speed_m_s, level.in_range_left_out ? "*" : ""),
                            fmt::format("{:.0f}", level.pressure_Pa / 1e3), fmt::format("{}", level.runs),
                            forces ? show(level.force_N, 1.0, "{:.2f}") : show(level.net_m_s2, 1e-3, "{:.2f}"),
                            show(level.ratio)});
    }
  }
  return table;
}

scenarios::ResultTable make_speed_table(const DrumCoastdownFit& fit) {
  scenarios::ResultTable table{
      "Drum alone; its standard deviation from run to run", {"km/h", "drum alone mm/s2", "repeatability %"}, {}};
  for (const SpeedPoint& point : fit.points) {
    table.rows.push_back({fmt::format("{:.1f}", 3.6 * point.speed_m_s), show(point.drum_alone_m_s2, 1e-3, "{:.2f}"),
                          show(point.drum_repeatability, 1e-2, "{:.2f}")});
  }
  return table;
}

scenarios::ResultTable make_law_table(const DrumCoastdownFit& fit) {
  const std::string difference =
      fit.directions.size() == 2 ? fmt::format("{} over {} %", fit.directions[0], fit.directions[1]) : "directions %";
  scenarios::ResultTable table{
      "Exponent of gauge pressure; difference of directions", {"km/h", "exponent", difference, "sd of one %"}, {}};
  for (const SpeedPoint& point : fit.points) {
    table.rows.push_back({fmt::format("{:.1f}", 3.6 * point.speed_m_s), show(point.pressure_exponent),
                          show(point.direction_ratio, 1e-2, "{:+.2f}"),
                          point.direction_ratio.has_value() ? fmt::format("{:.2f}", 100.0 * point.direction_sd) : "-"});
  }
  return table;
}

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
  text += format_table(make_level_table(fit, set.calc_drum_mass_kg().has_value()));
  text += format_table(make_speed_table(fit));
  text += format_table(make_law_table(fit));
  for (const std::string& warning : fit.warnings) text += wrap("warning: " + warning, 2);
  return text;
}

int fit_drum_coastdown_command(const Options& options) {
  const CoastSet set = estimation::read_coast_set(options.set, options.data);
  std::optional<OutputFolder> out;
  if (!options.out.empty()) out.emplace(options.out, options.force);
  const OutputFiles files({{"--json", options.json}, {"--html", options.html.path}});
  const DrumCoastdownFit fit = estimation::fit_drum_coastdown(set);
  const std::string json = estimation::make_coastdown_json(set, fit).dump(2) + "\n";
  files.require_no_input();
  if (out.has_value()) {
    out->add("fit.json", json);
    out->add("decelerations.csv", estimation::make_deceleration_csv(set, fit));
    out->add("residuals.csv", estimation::make_residual_csv(set, fit));
    out->commit();
  }
  if (!options.json.empty()) write_output(options.json, json);
  if (options.html.is_wanted()) options.html.write(report::make_drum_coastdown_page(set, fit));
  if (options.quiet || options.json == "-" || options.html.is_standard_output()) return kDone;
  std::cout << format_fit(set, fit) << options.html.note();
  if (out.has_value()) {
    std::cout << fmt::format("  written to {}/: fit.json decelerations.csv residuals.csv\n", options.out);
  }
  return kDone;
}

}  // namespace

void add_fit_drum_coastdown_command(CLI::App& fit, Action& action) {
  CLI::App* command =
      fit.add_subcommand("drum-coastdown", "Rolling resistance from coast-downs of a drum, tire loaded and lifted");
  auto options = std::make_shared<Options>();
  command->add_option("set", options->set, "Set of coast-downs (.toml)")->required();
  command->add_option("--data", options->data, "Folder of the set's CSV files [that of the set]");
  command->add_option("--out", options->out, "Folder for fit.json, decelerations.csv, residuals.csv");
  command->add_option("--json", options->json, "File for fit.json, - for standard output");
  options->html.add_to(*command);
  command->add_flag("--force", options->force, "Write into a folder that holds files");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options, &action] { action = [options] { return fit_drum_coastdown_command(*options); }; });
}

}  // namespace rollrig::cli
