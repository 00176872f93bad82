#include "rollrig/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "api/data.h"
#include "api/option_range.h"
#include "api/run_items.h"
#include "api/sweep_items.h"
#include "api/unfinished_sweep.h"
#include "campaigns/items.h"
#include "campaigns/store.h"
#include "report/list_pages.h"
#include "report/sweep_values.h"
#include "scenarios/run/flat_results.h"
#include "sim/core/columns.h"
#include "sim/core/csv.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {

struct Sweep::Data {
  SweepItems items;
  scenarios::RunSpec first;
  std::unique_ptr<const UnfinishedSweep> unfinished;  // none: finished points are not saved
};

namespace {

/// Refuses tires that are varied and given by --tire, or among which one comes twice.
void require_tires_once(const SweepInput& input, const SweepAxis& axis) {
  if (!input.run.tire.empty()) {
    throw InputError({"the tire is varied and given by --tire", "command line", 0, "--tire", input.run.tire,
                      "--vary tire=... or --tire", ""});
  }
  for (auto value = axis.values.begin(); value != axis.values.end(); ++value) {
    if (std::find(axis.values.begin(), value, *value) == value) continue;
    throw InputError(
        {fmt::format("the tire '{}' comes twice", *value), "command line", 0, "--vary", *value, "each tire once", ""});
  }
}

/// Refuses a setting that is varied twice, or varied and set.
void require_once(const SweepInput& input) {
  for (auto axis = input.axes.begin(); axis != input.axes.end(); ++axis) {
    const auto is_same = [&](const SweepAxis& other) { return other.key == axis->key; };
    if (std::any_of(input.axes.begin(), axis, is_same)) {
      throw InputError({fmt::format("'{}' is varied twice", axis->key), "command line", 0, "--vary", axis->key,
                        "each setting in one --vary", ""});
    }
    if (axis->key == kTireFactor) require_tires_once(input, *axis);
    const auto sets = [&](const std::string& setting) { return setting.rfind(axis->key + "=", 0) == 0; };
    if (std::any_of(input.run.settings.begin(), input.run.settings.end(), sets)) {
      throw InputError({fmt::format("'{}' is varied and set", axis->key), "command line", 0, "--set", axis->key,
                        "--vary or --set", ""});
    }
  }
}

/// Refuses an axis without values, and more points than memory and a result of one table hold, before any is made.
void require_few_points(const std::vector<SweepAxis>& axes) {
  std::size_t points = 1;
  for (const SweepAxis& axis : axes) {
    if (axis.values.empty()) {
      throw InputError({fmt::format("'{}' has no values", axis.key), "command line", 0, "--vary", axis.key,
                        "one value at least", ""});
    }
    points *= axis.values.size();  // no overflow: below, and an axis has not so many values
    if (points <= kMostSweepPoints) continue;
    std::vector<std::string> counts;
    for (const SweepAxis& each : axes) counts.push_back(fmt::format("{} of {}", each.values.size(), each.key));
    throw InputError({"too many points in a sweep", "command line", 0, "--vary",
                      fmt::format("{}: every value with every other", fmt::join(counts, ", ")),
                      fmt::format("at most {} points; rollrig campaign accepts more", kMostSweepPoints), ""});
  }
}

/// Every combination of the axes' values, the last axis fastest.
std::vector<SweepPoint> make_grid(const std::vector<SweepAxis>& axes) {
  std::vector<SweepPoint> grid{{}};
  for (const SweepAxis& axis : axes) {
    std::vector<SweepPoint> longer;
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
  std::vector<std::string> candidates = report::list_changing(json);
  if (candidates.empty()) candidates = sweep.results;
  std::vector<std::string> shown;
  for (const std::string& key : candidates) {
    if (std::find(sweep.axes.begin(), sweep.axes.end(), key) != sweep.axes.end()) continue;
    const std::size_t own = std::min(key.size(), kHeader);
    if (width + own > terminal_columns() && !shown.empty()) break;
    width += own + 2;
    shown.push_back(key);
  }
  return shown;
}

/// "Tire a50, rig drum_2m", without the tire where that is varied.
std::string name_subject(const SweepInput& input, const scenarios::RunSpec& first) {
  const bool has_tires =
      std::any_of(input.axes.begin(), input.axes.end(), [](const SweepAxis& axis) { return axis.key == kTireFactor; });
  const std::string rig = first.scenario->has_rig() ? first.rig.name : "";
  if (has_tires) return rig.empty() ? "Simulated: several tires" : fmt::format("Simulated: several tires, rig {}", rig);
  return fmt::format("Simulated: tire {}, rig {}", first.tire.name, first.rig.name);
}

}  // namespace

std::size_t SweepResult::count_failures() const {
  return static_cast<std::size_t>(
      std::count_if(failures.begin(), failures.end(), [](const std::string& failure) { return !failure.empty(); }));
}

Sweep::Sweep(const SweepInput& input) {
  require_once(input);
  require_few_points(input.axes);
  SweepItems items(input, make_grid(input.axes));
  items.check();
  scenarios::RunSpec first = items.read(0);
  std::vector<std::string> declared;
  for (const scenarios::ResultInfo& info : first.scenario->results) declared.push_back(info.key);
  require_declared(input.shown, declared);
  std::unique_ptr<const UnfinishedSweep> unfinished;
  if (!input.unfinished_folder.empty()) {
    unfinished = std::make_unique<UnfinishedSweep>(input.unfinished_folder, items.define(first.seed));
  }
  data_ = std::make_shared<Data>(Data{std::move(items), std::move(first), std::move(unfinished)});
}

namespace {

/// All points, in their order.
std::vector<campaigns::Record> carry_out_points(const SweepItems& items, std::uint64_t seed,
                                                const std::function<void(double)>& advance) {
  const SweepInput& input = items.input();
  const campaigns::CampaignFolder folder{input.unfinished_folder, calc_sha256(items.define(seed)), seed};
  std::vector<campaigns::Record> records(items.count());
  const auto add = [&records](const campaigns::Record& record) { records.at(record.item) = record; };
  if (input.unfinished_folder.empty() ||
      !is_there(input.unfinished_folder)) {  // after remove_unfinished(), nothing is saved
    campaigns::carry_out_all(items, folder, input.threads, add, advance);
  } else {
    campaigns::carry_out_items(items, folder, {1, 1}, input.threads, advance);
    campaigns::read_records(folder.list_files(), folder.definition, add);
  }
  return records;
}

}  // namespace

void Sweep::remove_unfinished() const {
  if (data_->unfinished != nullptr) data_->unfinished->remove();
}

SweepResult Sweep::carry_out(const Progress& progress) const {
  require_threads(data_->items.input().threads);
  const auto advance = [&progress](double done) {
    if (progress) progress(done, "");
  };
  const SweepItems& items = data_->items;
  const scenarios::RunSpec& first = data_->first;
  const std::vector<campaigns::Record> records = carry_out_points(items, first.seed, advance);
  SweepResult sweep;
  std::vector<Json> results(records.size(), Json::object());
  Json manifests = Json::array();
  for (std::size_t i = 0; i < records.size(); ++i) {
    sweep.failures.push_back(records[i].failure);
    manifests.push_back(nullptr);
    if (!records[i].failure.empty()) continue;
    Json stored = parse_json(records[i].result, fmt::format("point {}", i + 1));
    results[i] = std::move(stored["result"]);
    manifests.back() = std::move(stored["manifest"]);
  }
  for (const SweepAxis& axis : items.input().axes) sweep.axes.push_back(axis.key);
  sweep.points = items.list_shown_points();
  if (sweep.count_failures() == records.size()) {
    remove_unfinished();
    throw RunFailure(
        fmt::format("no point of the sweep could be simulated. {}: {}", name_point(sweep, 0), sweep.failures.front()));
  }
  Json json = make_json(first.scenario->text.name, sweep, results);
  const std::vector<Json> numbers = scenarios::flatten_results(results);
  Json flat = make_json(first.scenario->text.name, sweep, numbers);
  const std::vector<std::string> drawn =
      items.input().shown.empty() ? report::choose_drawn_results(flat) : items.input().shown;
  json["sensitivities"] = flat["sensitivities"] = report::list_sensitivities(flat, drawn);
  sweep.results = report::list_numbers(flat);
  for (const Json& result : numbers) {
    sweep.values.emplace_back();
    for (const std::string& key : sweep.results) {
      const Json value = result.value(key, Json());
      sweep.values.back().push_back(value.is_number() ? value.get<double>() : std::nan(""));
    }
  }
  const std::vector<std::string> shown = choose_shown(items.input().shown, flat, sweep);
  sweep.json = to_text(json);
  sweep.text = format_table(report::make_sweep_table(flat, format_count(records.size(), "run"), shown));
  sweep.text += list_failures(sweep);
  if (shown.size() < sweep.results.size()) {
    sweep.text += wrap(fmt::format("{} of {} results are shown. --show names others, --out and --json write all.",
                                   shown.size(), sweep.results.size()),
                       0);
  }
  const Json all_manifests{{"format", "rollrig-manifests/1"}, {"manifests", manifests}};
  const FolderFiles files{
      {"sweep.csv", make_csv(sweep)}, {"sweep.json", sweep.json}, {"manifests.json", to_text(all_manifests)}};
  sweep.make_files = [files] { return files; };
  sweep.make_page = [flat, data = data_] {
    const std::string of = name_subject(data->items.input(), data->first);
    return report::make_html(report::make_sweep_page(flat, data->items.input().shown, of));
  };
  return sweep;
}

}  // namespace rollrig
