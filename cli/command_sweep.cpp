#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <optional>

#include <boost/algorithm/string/split.hpp>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/print.h"
#include "cli/progress.h"
#include "cli/run_options.h"
#include "report/list_pages.h"
#include "sim/core/csv.h"
#include "sim/core/parallel.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

struct Options {
  RunOptions run;
  std::vector<std::string> vary;
  std::vector<std::string> show;
  int threads = 0;
  OutputOptions output;
};

/// A key of --set with the values that it takes.
struct Axis {
  std::string key;
  std::vector<std::string> values;
};

InputError bad_axis(const std::string& text) {
  return usage_error(fmt::format("--vary '{}' is not understood", text), "--vary", text,
                     "key=a,b,c or key=from:to:step, with the keys of --set");
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

/// All single numbers of the sweep's document; a field is empty where a point has none.
std::string make_csv(const Json& sweep, const std::vector<Axis>& axes) {
  const std::vector<std::string> keys = report::list_numbers(sweep);
  std::vector<std::string> columns;
  for (const Axis& axis : axes) columns.push_back(axis.key);
  columns.insert(columns.end(), keys.begin(), keys.end());
  CsvWriter csv(columns);
  for (const Json& point : sweep["points"]) {
    csv.begin_row();
    for (const Json& value : point["set"]) csv.add(value.get<std::string>());
    for (const std::string& key : keys) {
      const Json value = point["result"].value(key, Json());
      csv.add(value.is_number() ? value.get<double>() : std::nan(""), 12);
    }
    csv.end_row();
  }
  return csv.take();
}

/// Results shown in the terminal: as asked for, else the first of those that change, as many as fit 80 columns.
std::vector<std::string> choose_shown(const Options& options, const Json& sweep, const std::vector<Axis>& axes) {
  const std::vector<std::string> numbers = report::list_numbers(sweep);
  for (const std::string& key : options.show) {
    if (std::find(numbers.begin(), numbers.end(), key) != numbers.end()) continue;
    throw InputError(unknown_name("result", key, numbers));
  }
  if (!options.show.empty()) return options.show;
  std::size_t width = 2;
  for (const Axis& axis : axes) width += axis.key.size() + 1;
  const std::vector<std::string> changing = report::list_changing(sweep);
  std::vector<std::string> shown;
  for (const std::string& key : changing.empty() ? numbers : changing) {
    if (width + key.size() + 1 > 80 && !shown.empty()) continue;
    width += key.size() + 1;
    shown.push_back(key);
  }
  return shown;
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
  Output output(options.output);
  std::vector<Json> results(specs.size());
  std::vector<std::pair<std::string, std::string>> files(specs.size() + 2);
  ProgressLine progress("sweep", options.output.quiet);
  std::atomic<std::size_t> done{0};
  parallel_for(specs.size(), options.threads, [&](std::size_t i) {
    const scenarios::Outcome outcome = scenarios::run_scenario(specs[i], {});
    results[i] = outcome.result;
    files[i + 2] = {fmt::format("manifests/{:04}.json", i + 1), to_text(scenarios::make_manifest(specs[i], outcome))};
    progress.update(static_cast<double>(++done) / static_cast<double>(specs.size()));
  });
  Json json = {
      {"format", "rollrig-sweep/1"}, {"scenario", specs.front().scenario->text.name}, {"points", Json::array()}};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    Json varied = Json::object();
    for (std::size_t a = 0; a < axes.size(); ++a) varied[axes[a].key] = grid[i][a];
    json["points"].push_back({{"set", varied}, {"result", results[i]}});
  }
  const std::vector<std::string> shown = choose_shown(options, json, axes);
  files[0] = {"sweep.csv", make_csv(json, axes)};
  files[1] = {"sweep.json", to_text(json)};
  output.write(files, to_text(json), [&] {
    const std::string of = fmt::format("Tire {}, rig {}", specs.front().tire.name, specs.front().rig.name);
    return report::make_sweep_page(json, options.show, of);
  });
  output.print(format_table(report::make_sweep_table(json, format_count(grid.size(), "run"), shown)));
  return kDone;
}

}  // namespace

void add_sweep_command(CLI::App& app, Action& action) {
  const auto [command, options] =
      add_command<Options>(app, action, "sweep", "Run a scenario at every point of a grid", &sweep_command);
  options->run.add_to(*command);
  command->add_option("--vary", options->vary, "key=a,b,c or key=from:to:step; may be repeated")
      ->required()
      ->expected(1)
      ->take_all();
  command->add_option("--show", options->show, "Results in the terminal's table")->delimiter(',');
  command->add_option("--threads", options->threads, "Threads [as many as the machine has]")
      ->check(CLI::Range(1, 1024));
  options->output.add_to(*command, "File for the results, - for standard output",
                         "Folder for sweep.csv, sweep.json, manifests/");
}

}  // namespace rollrig::cli
