#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include <boost/algorithm/string/split.hpp>

#include "cli/command.h"
#include "cli/html_option.h"
#include "cli/output_files.h"
#include "cli/print.h"
#include "cli/progress.h"
#include "cli/run_options.h"
#include "report/list_pages.h"
#include "sim/core/csv.h"
#include "sim/core/file_io.h"
#include "sim/core/parallel.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

struct Options {
  RunOptions run;
  std::vector<std::string> vary;
  std::vector<std::string> show;
  int threads = 0;
  std::string out;
  std::string json;
  HtmlOption html;
  bool force = false;
  bool quiet = false;
};

/// A key of --set with the values that it takes.
struct Axis {
  std::string key;
  std::vector<std::string> values;
};

InputError bad_axis(const std::string& text) {
  return InputError({fmt::format("--vary '{}' is not understood", text), "command line", 0, "--vary", text,
                     "key=a,b,c or key=from:to:step, with the keys of --set", ""});
}

Axis parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) throw bad_axis(text);
  Axis axis{text.substr(0, equals), {}};
  const std::string values = text.substr(equals + 1);
  if (values.find(':') == std::string::npos) {
    boost::algorithm::split(axis.values, values, [](char c) { return c == ','; });
    return axis;
  }
  std::vector<std::string> words;
  boost::algorithm::split(words, values, [](char c) { return c == ':'; });
  if (words.size() != 3) throw bad_axis(text);
  const std::optional<double> from = parse_number(words[0]);
  const std::optional<double> to = parse_number(words[1]);
  const std::optional<double> step = parse_number(words[2]);
  if (!from.has_value() || !to.has_value() || !step.has_value()) throw bad_axis(text);
  constexpr double kMostValues = 10000.0;
  const double intervals = (*to - *from) / *step;
  if (*step == 0.0 || intervals < 0.0 || intervals > kMostValues) throw bad_axis(text);
  const int last = static_cast<int>(std::floor(intervals + 1e-9));
  for (int i = 0; i <= last; ++i) axis.values.push_back(fmt::format("{:.12g}", *from + i * *step));
  return axis;
}

/// Every combination of the axes' values, the last axis fastest.
std::vector<std::vector<std::string>> make_grid(const std::vector<Axis>& axes) {
  std::vector<std::vector<std::string>> grid{{}};
  for (const Axis& axis : axes) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& point : grid) {
      for (const std::string& value : axis.values) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    }
    grid = std::move(longer);
  }
  return grid;
}

/// Keys of `result` that are numbers, in order.
std::vector<std::string> number_keys(const Json& result) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : result.items()) {
    if (value.is_number()) keys.push_back(key);
  }
  return keys;
}

std::string make_csv(const std::vector<Axis>& axes, const std::vector<std::vector<std::string>>& grid,
                     const std::vector<Json>& results) {
  const std::vector<std::string> keys = number_keys(results.front());
  std::vector<std::string> columns;
  for (const Axis& axis : axes) columns.push_back(axis.key);
  columns.insert(columns.end(), keys.begin(), keys.end());
  CsvWriter csv(columns);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    csv.begin_row();
    for (const std::string& value : grid[i]) csv.add(value);
    for (const std::string& key : keys) csv.add(results[i].value(key, std::nan("")), 12);
    csv.end_row();
  }
  return csv.take();
}

/// Results shown in the terminal: as asked for, else the scenario's first that fit 80 columns.
std::vector<std::string> choose_shown(const Options& options, const scenarios::Scenario& scenario, const Json& result,
                                      const std::vector<Axis>& axes) {
  const std::vector<std::string> keys = number_keys(result);
  for (const std::string& key : options.show) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) throw InputError(unknown_name("result", key, keys));
  }
  if (!options.show.empty()) return options.show;
  std::size_t width = 2;
  for (const Axis& axis : axes) width += axis.key.size() + 1;
  std::vector<std::string> shown;
  for (const scenarios::ResultInfo& info : scenario.text.results) {
    if (std::find(keys.begin(), keys.end(), info.key) == keys.end()) continue;
    if (width + info.key.size() + 1 > 80 && !shown.empty()) continue;
    width += info.key.size() + 1;
    shown.push_back(info.key);
  }
  return shown;
}

scenarios::ResultTable make_table(const std::vector<Axis>& axes, const std::vector<std::vector<std::string>>& grid,
                                  const std::vector<Json>& results, const std::vector<std::string>& shown) {
  scenarios::ResultTable table{format_count(grid.size(), "run"), {}, {}};
  for (const Axis& axis : axes) table.columns.push_back(axis.key);
  table.columns.insert(table.columns.end(), shown.begin(), shown.end());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    std::vector<std::string> row = grid[i];
    for (const std::string& key : shown) {
      const Json& value = results[i][key];
      row.push_back(value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : "-");
    }
    table.rows.push_back(row);
  }
  return table;
}

int sweep_command(const Options& options) {
  std::vector<Axis> axes;
  for (const std::string& text : options.vary) axes.push_back(parse_axis(text));
  const std::vector<std::vector<std::string>> grid = make_grid(axes);
  std::vector<scenarios::RunSpec> specs;
  for (const auto& point : grid) {
    ConfigTable document = options.run.make_document();
    for (std::size_t i = 0; i < axes.size(); ++i) scenarios::set_run_value(document, axes[i].key + "=" + point[i]);
    specs.push_back(scenarios::read_run_spec(document, options.run.base_folder()));
  }
  std::optional<OutputFolder> out;
  if (!options.out.empty()) out.emplace(options.out, options.force);
  const OutputFiles files({{"--json", options.json}, {"--html", options.html.path}});
  std::vector<Json> results(specs.size());
  std::vector<std::string> manifests(specs.size());
  ProgressLine progress("sweep", options.quiet);
  std::atomic<std::size_t> done{0};
  parallel_for(specs.size(), options.threads, [&](std::size_t i) {
    const scenarios::Outcome outcome = scenarios::run_scenario(specs[i], {});
    results[i] = outcome.result;
    manifests[i] = scenarios::make_manifest(specs[i], outcome).dump(2) + "\n";
    progress.update(static_cast<double>(++done) / static_cast<double>(specs.size()));
  });
  Json json = {
      {"format", "rollrig-sweep/1"}, {"scenario", specs.front().scenario->text.name}, {"points", Json::array()}};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    Json varied = Json::object();
    for (std::size_t a = 0; a < axes.size(); ++a) varied[axes[a].key] = grid[i][a];
    json["points"].push_back({{"set", varied}, {"result", results[i]}});
  }
  const std::vector<std::string> shown = choose_shown(options, *specs.front().scenario, results.front(), axes);
  files.require_no_input();
  if (out.has_value()) {
    out->add("sweep.csv", make_csv(axes, grid, results));
    out->add("sweep.json", json.dump(2) + "\n");
    for (std::size_t i = 0; i < grid.size(); ++i) out->add(fmt::format("manifests/{:04}.json", i + 1), manifests[i]);
    out->commit();
  }
  if (!options.json.empty()) write_output(options.json, json.dump(2) + "\n");
  if (options.html.is_wanted()) {
    const std::string of = fmt::format("Tire {}, rig {}", specs.front().tire.name, specs.front().rig.name);
    options.html.write(report::make_sweep_page(json, options.show, of));
  }
  if (options.quiet || options.json == "-" || options.html.is_standard_output()) return kDone;
  std::cout << format_table(make_table(axes, grid, results, shown)) << options.html.note();
  if (out.has_value()) std::cout << fmt::format("  written to {}/: sweep.csv sweep.json manifests/\n", options.out);
  return kDone;
}

}  // namespace

void add_sweep_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("sweep", "Run a scenario at every point of a grid");
  auto options = std::make_shared<Options>();
  options->run.add_to(*command);
  command->add_option("--vary", options->vary, "key=a,b,c or key=from:to:step; may be repeated")
      ->required()
      ->expected(1)
      ->take_all();
  command->add_option("--show", options->show, "Results in the terminal's table")->delimiter(',');
  command->add_option("--threads", options->threads, "Threads [as many as the machine has]")
      ->check(CLI::Range(1, 1024));
  command->add_option("--out", options->out, "Folder for sweep.csv, sweep.json, manifests/");
  command->add_option("--json", options->json, "File for the results, - for standard output");
  options->html.add_to(*command);
  command->add_flag("--force", options->force, "Write into a folder that holds files");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options, &action] { action = [options] { return sweep_command(*options); }; });
}

}  // namespace rollrig::cli
