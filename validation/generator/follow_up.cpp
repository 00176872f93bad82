#include "validation/generator/follow_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parallel.h"
#include "sim/core/parse_json.h"
#include "validation/files.h"
#include "validation/generator/laboratory.h"

namespace fs = std::filesystem;

namespace rollrig::generator {
namespace {

/// The given columns of one planned run.
class PlannedTable {
 public:
  PlannedTable(const std::string& file, const Machine& machine) : file_(file), table_(CsvTable::read(file)) {
    std::vector<std::string> required;
    for (const GivenColumn& column : machine.given_columns) required.emplace_back(column.name);
    for (const std::string& column : required) {
      if (table_.has(column) && table_.row_count() >= 2) continue;
      throw problem("no such column with two rows or more", column, "",
                    fmt::format("the given columns of a {} set: {}", machine.word, fmt::join(required, ", ")));
    }
    check_rows();
  }

  bool has(const std::string& column) const { return table_.has(column); }
  std::size_t rows() const { return table_.row_count(); }

  /// A column as it is written; zeros where it is not there.
  std::vector<double> read(const std::string& column) const {
    if (!table_.has(column)) return std::vector<double>(rows(), 0.0);
    std::vector<double> values = table_.plain_numbers(column, {});
    for (const double value : values) {
      if (std::isnan(value)) throw problem("an empty cell", column, "", "a number in every cell");
    }
    return values;
  }

  /// A column that a test holds from its first row to its last.
  double read_held(const std::string& column) const {
    const std::vector<double> values = read(column);
    for (const double value : values) {
      if (value != values.front()) throw problem("not held", column, fmt::format("{:g}", value), "one value");
    }
    return values.front();
  }

 private:
  InputError problem(const std::string& what, const std::string& column, const std::string& value,
                     const std::string& allowed) const {
    return InputError({what, file_, 0, column, value, allowed, ""});
  }

  void check_rows() const {
    const std::vector<double> time_s = read("time_s");
    for (std::size_t i = 0; i < rows(); ++i) {
      const bool goes_on = i == 0 ? time_s[i] == 0.0 : time_s[i] > time_s[i - 1];
      if (goes_on && time_s[i] == std::round(time_s[i])) continue;
      throw problem("times do not go on", "time_s", fmt::format("{:g}", time_s[i]),
                    "0 first, then whole seconds that increase");
    }
    for (const char* column : {"speed_km_h", "load_N"}) {
      for (const double value : read(column)) {
        if (value < 0.0) throw problem("less than nothing", column, fmt::format("{:g}", value), "0 or more");
      }
    }
  }

  std::string file_;
  CsvTable table_;
};

/// Straight lines between rows, the load held, as legs; where the speed has knots a leg lasts one second.
std::vector<Leg> make_legs(const PlannedTable& table, const Machine& machine, double road_load_N) {
  const std::vector<double> time_s = table.read("time_s");
  const std::vector<double> speed_km_h = table.read("speed_km_h");
  const std::vector<double> load_N = table.read("load_N");
  const std::vector<double> pull_N = table.read("longitudinal_force_N");
  const std::vector<double> elevation_m = table.read("elevation_m");
  std::vector<Leg> legs;
  double way_m = 0.0;
  for (std::size_t i = 0; i + 1 < time_s.size(); ++i) {
    const double span_s = time_s[i + 1] - time_s[i];
    const double step_s = machine.has_knots ? 1.0 : span_s;
    for (double from_s = 0.0; from_s < span_s; from_s += step_s) {
      const auto between = [&](const std::vector<double>& values, double at_s) {
        return values[i] + at_s / span_s * (values[i + 1] - values[i]);
      };
      const double to_s = from_s + step_s;
      Leg leg{time_s[i] + from_s, step_s, between(speed_km_h, from_s) / 3.6, between(speed_km_h, to_s) / 3.6,
              machine.has_vehicle() ? road_load_N : load_N[i]};
      leg.start_longitudinal_N = between(pull_N, from_s);
      leg.end_longitudinal_N = between(pull_N, to_s);
      leg.start_elevation_m = between(elevation_m, from_s);
      leg.end_elevation_m = between(elevation_m, to_s);
      leg.start_distance_m = way_m;
      way_m += leg.mean_m_s() * step_s;
      legs.push_back(leg);
    }
  }
  return legs;
}

RunPlan read_run(const fs::path& folder, const Json& json, const SetOrder& order, double road_load_N) {
  const PlannedTable table((folder / json.at("file").get<std::string>()).string(), *order.machine);
  RunPlan run;
  run.id = json.at("id").get<std::string>();
  run.session = json.at("session").get<std::string>();
  run.cold_pressure_kPa = json.at("cold_pressure_kPa").get<double>();
  run.reversed = json.value("reversed", false);
  run.reads_zero = json.at("force_at_standstill").get<bool>();
  for (const Json& span : json.at("not_read_s")) {
    run.unread_s.emplace_back(span.at(0).get<double>(), span.at(1).get<double>());
  }
  if (table.has("surface_temperature_degC")) run.surface_degC = table.read_held("surface_temperature_degC");
  const std::vector<double> time_s = table.read("time_s");
  const std::string hung_column = order.machine->hung_column();
  const std::vector<double> hung = table.read(hung_column);
  for (std::size_t i = 0; table.has(hung_column) && i < time_s.size(); ++i) run.hung.emplace_back(time_s[i], hung[i]);
  Draws own(order.seed, "run/" + run.id);
  run.air = draw_air(own, table.read_held("ambient_degC"));
  run.initial_degC = std::round(10.0 * run.air.at(0.0)) / 10.0;
  run.legs = make_legs(table, *order.machine, road_load_N);
  return run;
}

/// The plan of one set: plan.json (rollrig-blind-plan/1) and a CSV of given columns for each of its runs.
struct TestPlan {
  std::string set_sha256;  // of the files of the set that it is for
  std::vector<RunPlan> runs;
};

/// Reads the plan in `folder`. What is not in a plan is drawn as for any run, by the seed of the set: the air swings
/// about the planned temperature, and the tire starts at that of the air. Loads on the road are `road_load_N`.
/// Errors  InputError: no plan, a plan of another kind of set, columns or rows that no run can have
TestPlan read_test_plan(const std::string& folder, const SetOrder& order, double road_load_N) {
  const std::string file = (fs::path(folder) / "plan.json").string();
  const auto require = [&file](const Json& json, const char* key, const char* value) {
    if (json.at(key) == value) return;
    throw InputError({"not a plan for this case", file, 0, key, json.at(key).dump(), value, ""});
  };
  TestPlan plan;
  try {
    const Json json = read_json(file);
    require(json, "format", validation::kPlanFormat);
    require(json, "kind", order.machine->word);
    plan.set_sha256 = json.at("set_sha256").get<std::string>();
    for (const Json& run : json.at("runs")) plan.runs.push_back(read_run(folder, run, order, road_load_N));
  } catch (const Json::exception& error) {
    throw InputError({fmt::format("not a plan: {}", error.what()), file, 0, "", "", validation::kPlanFormat, ""});
  }
  if (plan.runs.empty()) throw InputError({"a plan without runs", file, 0, "runs", "[]", "one run or more", ""});
  return plan;
}

/// Cases that have a plan, sorted.
std::vector<std::string> list_plans(const FollowUpOrder& order) {
  const fs::path folder = fs::path(follow_up_folder(order)) / "plans";
  std::vector<std::string> numbers;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) numbers.push_back(entry.path().filename().string());
  }
  if (numbers.empty()) {
    throw InputError({fmt::format("no plans in '{}'", folder.string()), order.set, 0, "", "",
                      fmt::format("first: rollrig_validation plan {}{}", order.set, order.drawn ? " --drawn" : ""),
                      ""});
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

std::string follow_up_folder(const FollowUpOrder& order) {
  return (fs::path(order.set) / (order.drawn ? validation::kDrawnFollowUpFolder : validation::kFollowUpFolder))
      .string();
}

namespace {

/// The runs of the plan for a case of the set.
std::vector<RunPlan> read_planned_runs(const std::string& set, const std::string& number, const SetOrder& made_by,
                                       const std::string& plan_folder) {
  const std::string plan_file = plan_folder + "/plan.json";
  const std::string folder = validation::case_folder(set, number);
  require_same_files(folder, made_by);
  const Laboratory lab = draw_laboratory(made_by);
  TestPlan plan = read_test_plan(plan_folder, made_by, lab.campaign.runs.front().legs.front().load_N);
  if (plan.set_sha256 != validation::hash_case(folder)) {
    throw InputError(
        {"a plan for other files", plan_file, 0, "set_sha256", plan.set_sha256, validation::hash_case(folder), ""});
  }
  for (const RunPlan& run : plan.runs) {
    const bool is_taken = std::any_of(lab.campaign.runs.begin(), lab.campaign.runs.end(),
                                      [&](const RunPlan& own) { return own.id == run.id; });
    if (is_taken)
      throw InputError({"the case has this run already", plan_file, 0, "id", run.id, "names of new runs", ""});
  }
  return std::move(plan.runs);
}

}  // namespace

Files make_follow_up(const std::string& set, const std::string& number, const Json& truth,
                     const std::string& plan_folder) {
  const SetOrder made_by = read_order(truth);
  return follow_up(made_by, read_planned_runs(set, number, made_by, plan_folder));
}

UpperBound find_upper_bound_after(const std::string& set, const std::string& number, const Json& truth,
                                  const std::string& plan_folder) {
  const SetOrder made_by = read_order(truth);
  if (plan_folder.empty()) return find_upper_bound(KnownSet(made_by), made_by);
  return find_upper_bound(KnownSet(made_by, read_planned_runs(set, number, made_by, plan_folder)), made_by);
}

std::size_t write_follow_up(const FollowUpOrder& order, const Progress& progress) {
  const Json truths = validation::open_truth(order.set, "").cases;
  const std::vector<std::string> numbers = list_plans(order);
  for (const std::string& number : numbers) {
    if (truths.contains(number)) continue;
    throw InputError({"a plan for a case that the validation set has not", follow_up_folder(order) + "/plans", 0, "",
                      number, "the cases of " + order.set, ""});
  }
  const std::string out = follow_up_folder(order) + "/sets";
  validation::require_new_folder(out, "followup");
  OutputFolder folder(out, false);
  std::vector<Files> made(numbers.size());
  parallel_for(
      numbers.size(), order.threads,
      [&](std::size_t i) {
        const std::string plan = (fs::path(follow_up_folder(order)) / "plans" / numbers[i]).string();
        made[i] = make_follow_up(order.set, numbers[i], truths.at(numbers[i]), plan);
      },
      progress);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (auto& [file, content] : made[i]) folder.add(numbers[i] + "/" + file, std::move(content));
  }
  throw_if_interrupted();
  folder.commit();
  return numbers.size();
}

}  // namespace rollrig::generator
