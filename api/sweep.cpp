#include "rollrig/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/split.hpp>

#include "api/data.h"
#include "report/list_pages.h"
#include "scenarios/run/flat_results.h"
#include "sim/core/columns.h"
#include "sim/core/csv.h"
#include "sim/core/parallel.h"
#include "sim/core/text.h"

namespace rollrig {

struct Sweep::Data {
  SweepInput input;
  std::vector<std::vector<std::string>> points;
  std::vector<scenarios::RunSpec> specs;
};

namespace {

InputError bad_axis(const std::string& text, const std::string& what = "is not understood",
                    const std::string& allowed = "key=a,b,c or key=from:to:step, with the keys of --set") {
  return InputError({fmt::format("--vary '{}' {}", text, what), "command line", 0, "--vary", text, allowed, ""});
}

/// Refuses a setting that is varied twice, or varied and set.
void require_once(const SweepInput& input) {
  for (auto axis = input.axes.begin(); axis != input.axes.end(); ++axis) {
    const auto is_same = [&](const SweepAxis& other) { return other.key == axis->key; };
    if (std::any_of(input.axes.begin(), axis, is_same)) {
      throw InputError({fmt::format("'{}' is varied twice", axis->key), "command line", 0, "--vary", axis->key,
                        "each setting in one --vary", ""});
    }
    const auto sets = [&](const std::string& setting) { return setting.rfind(axis->key + "=", 0) == 0; };
    if (std::any_of(input.run.settings.begin(), input.run.settings.end(), sets)) {
      throw InputError({fmt::format("'{}' is varied and set", axis->key), "command line", 0, "--set", axis->key,
                        "--vary or --set", ""});
    }
  }
}

/// Refuses more points than memory and a result of one table hold, before any is made.
void require_few_points(const std::vector<SweepAxis>& axes) {
  std::size_t points = 1;
  for (const SweepAxis& axis : axes) {
    points *= axis.values.size();  // no overflow: below, and an axis has not so many values
    if (points <= kMostSweepPoints) continue;
    std::vector<std::string> counts;
    for (const SweepAxis& each : axes) counts.push_back(fmt::format("{} of {}", each.values.size(), each.key));
    throw InputError({"too many points in a sweep", "command line", 0, "--vary",
                      fmt::format("{}: every value with every other", fmt::join(counts, ", ")),
                      fmt::format("at most {} points", kMostSweepPoints), ""});
  }
}

/// Every combination of the axes' values, the last axis fastest.
std::vector<std::vector<std::string>> make_grid(const std::vector<SweepAxis>& axes) {
  std::vector<std::vector<std::string>> grid{{}};
  for (const SweepAxis& axis : axes) {
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

/// The sweep's document (rollrig-sweep/1).
Json make_json(const std::string& scenario, const SweepResult& sweep, const std::vector<Json>& results) {
  Json json = {{"format", "rollrig-sweep/1"}, {"scenario", scenario}, {"points", Json::array()}};
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    Json varied = Json::object();
    for (std::size_t a = 0; a < sweep.axes.size(); ++a) varied[sweep.axes[a]] = sweep.points[i][a];
    json["points"].push_back({{"set", varied}, {"result", results[i]}});
    if (!sweep.failures[i].empty()) json["points"].back()["failure"] = sweep.failures[i];
  }
  return json;
}

/// "ambient_degC -10, speed_km_h 80"
std::string name_point(const SweepResult& sweep, std::size_t i) {
  std::string name;
  for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
    name += fmt::format("{}{} {}", a > 0 ? ", " : "", sweep.axes[a], sweep.points[i][a]);
  }
  return name;
}

/// Points that failed, a line each.
std::string list_failures(const SweepResult& sweep) {
  std::string text;
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    if (sweep.failures[i].empty()) continue;
    text += wrap(fmt::format("failed: {}: {}", name_point(sweep, i), sweep.failures[i]), 2);
  }
  return text;
}

/// A field is empty where a point has no such result. Where a point failed, the last column says why.
std::string make_csv(const SweepResult& sweep) {
  std::vector<std::string> columns = sweep.axes;
  columns.insert(columns.end(), sweep.results.begin(), sweep.results.end());
  const bool has_failures = sweep.count_failures() > 0;
  if (has_failures) columns.emplace_back("failure");
  CsvWriter csv(columns);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    for (const std::string& value : sweep.points[i]) csv.add(value);
    for (const double value : sweep.values[i]) csv.add(CsvWriter::Rounded{value, 12});
    if (has_failures) csv.add(sweep.failures[i]);
    csv.end_row();
  }
  return csv.take();
}

void require_known(const std::vector<std::string>& asked, const std::vector<std::string>& results) {
  for (const std::string& key : asked) {
    if (std::find(results.begin(), results.end(), key) != results.end()) continue;
    throw InputError(unknown_name("result", key, results));
  }
}

void require_declared(const std::vector<std::string>& asked, const std::vector<std::string>& declared) {
  for (const std::string& key : asked) {
    if (std::find(declared.begin(), declared.end(), scenarios::find_declared_key(key)) != declared.end()) continue;
    throw InputError(unknown_name("result", key, declared));
  }
}

/// Results shown in the terminal: as asked for, else the first of those that change, as many as fit the terminal.
std::vector<std::string> choose_shown(const std::vector<std::string>& asked, const Json& json,
                                      const SweepResult& sweep) {
  require_known(asked, sweep.results);
  if (!asked.empty()) return asked;
  std::size_t width = 2;
  constexpr std::size_t kHeader = 14;  // longer ones take several lines
  for (const std::string& axis : sweep.axes) width += std::min(axis.size(), kHeader) + 2;
  const std::vector<std::string> changing = report::list_changing(json);
  std::vector<std::string> shown;
  for (const std::string& key : changing.empty() ? sweep.results : changing) {
    if (std::find(sweep.axes.begin(), sweep.axes.end(), key) != sweep.axes.end()) continue;
    const std::size_t own = std::min(key.size(), kHeader);
    if (width + own > terminal_columns() && !shown.empty()) break;
    width += own + 2;
    shown.push_back(key);
  }
  return shown;
}

}  // namespace

std::size_t SweepResult::count_failures() const {
  return static_cast<std::size_t>(
      std::count_if(failures.begin(), failures.end(), [](const std::string& failure) { return !failure.empty(); }));
}

SweepAxis read_sweep_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) throw bad_axis(text);
  SweepAxis axis{text.substr(0, equals), {}};
  const std::string values = text.substr(equals + 1);
  if (values.find(':') == std::string::npos) {
    boost::algorithm::split(axis.values, values, [](char c) { return c == ','; });
    if (std::any_of(axis.values.begin(), axis.values.end(), [](const std::string& value) { return value.empty(); })) {
      throw bad_axis(text, "has an empty value", "a value before and after each comma");
    }
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
  if (!std::isfinite(*from) || !std::isfinite(*to) || !std::isfinite(*step)) {
    throw bad_axis(text, "is not finite", "finite numbers");
  }
  if (*step == 0.0) throw bad_axis(text, "has a step of 0", "a step that leads from the first value to the last");
  if (intervals < 0.0) {
    throw bad_axis(text, "has a step that leads away from the last value",
                   fmt::format("a step of the other sign: {:.6g}", -*step));
  }
  if (intervals > kMostValues) {
    throw bad_axis(text, fmt::format("has {:.6g} values", std::floor(intervals) + 1.0),
                   fmt::format("at most {:.0f}", kMostValues + 1.0));
  }
  const int last = static_cast<int>(std::floor(intervals + 1e-9));
  for (int i = 0; i <= last; ++i) axis.values.push_back(fmt::format("{:.12g}", *from + i * *step));
  return axis;
}

Sweep::Sweep(const SweepInput& input) {
  require_once(input);
  require_few_points(input.axes);
  const auto data = std::make_shared<Data>(Data{input, make_grid(input.axes), {}});
  for (const auto& point : data->points) {
    RunInput run = input.run;
    for (std::size_t i = 0; i < point.size(); ++i) run.settings.push_back(input.axes[i].key + "=" + point[i]);
    data->specs.push_back(read_run(run));
    scenarios::prepare_run(data->specs.back());  // says what is wrong before the first is carried out
  }
  std::vector<std::string> declared;
  for (const scenarios::ResultInfo& info : data->specs.front().scenario->results) declared.push_back(info.key);
  require_declared(input.shown, declared);
  data_ = data;
}

SweepResult Sweep::carry_out(const Progress& progress) const {
  const std::vector<scenarios::RunSpec>& specs = data_->specs;
  std::vector<Json> results(specs.size(), Json::object());
  std::vector<std::string> manifests(specs.size());
  SweepResult sweep;
  sweep.failures.resize(specs.size());
  const auto carry_out_one = [&](std::size_t i) {
    try {
      const scenarios::Outcome outcome = scenarios::run_scenario(specs[i], {});
      results[i] = outcome.result;
      manifests[i] = to_text(scenarios::make_manifest(specs[i], outcome));
    } catch (const RunFailure& failure) {  // the other points are still worth having
      sweep.failures[i] = boost::algorithm::replace_all_copy(std::string(failure.what()), "\n", "; ");
    }
  };
  const auto advance = [&progress](double done) {
    if (progress) progress(done, "");
  };
  parallel_for(specs.size(), data_->input.threads, carry_out_one, advance);
  for (const SweepAxis& axis : data_->input.axes) sweep.axes.push_back(axis.key);
  sweep.points = data_->points;
  if (sweep.count_failures() == specs.size()) {
    throw RunFailure(
        fmt::format("no point of the sweep could be simulated. {}: {}", name_point(sweep, 0), sweep.failures.front()));
  }
  const Json json = make_json(specs.front().scenario->text.name, sweep, results);
  const std::vector<Json> numbers = scenarios::flatten_results(results);
  const Json flat = make_json(specs.front().scenario->text.name, sweep, numbers);
  sweep.results = report::list_numbers(flat);
  for (const Json& result : numbers) {
    sweep.values.emplace_back();
    for (const std::string& key : sweep.results) {
      const Json value = result.value(key, Json());
      sweep.values.back().push_back(value.is_number() ? value.get<double>() : std::nan(""));
    }
  }
  const std::vector<std::string> shown = choose_shown(data_->input.shown, flat, sweep);
  sweep.json = to_text(json);
  sweep.text = format_table(report::make_sweep_table(flat, format_count(specs.size(), "run"), shown));
  sweep.text += list_failures(sweep);
  if (shown.size() < sweep.results.size()) {
    sweep.text += wrap(fmt::format("{} of {} results are shown. --show names others, --out and --json write all.",
                                   shown.size(), sweep.results.size()),
                       0);
  }
  FolderFiles files{{"sweep.csv", make_csv(sweep)}, {"sweep.json", sweep.json}};
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (sweep.failures[i].empty()) files.emplace_back(fmt::format("manifests/{:04}.json", i + 1), manifests[i]);
  }
  sweep.make_files = [files] { return files; };
  sweep.make_page = [flat, data = data_] {
    const scenarios::RunSpec& spec = data->specs.front();
    const std::string of = fmt::format("Tire {}, rig {}", spec.tire.name, spec.rig.name);
    return report::make_html(report::make_sweep_page(flat, data->input.shown, of));
  };
  return sweep;
}

}  // namespace rollrig
