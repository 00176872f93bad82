#include "rollrig/run.h"

#include <fmt/format.h>

#include <filesystem>

#include "api/add_uncertainty.h"
#include "api/data.h"
#include "api/report_files.h"
#include "report/page.h"
#include "report/run_page.h"
#include "report/run_reports.h"
#include "sim/core/file_io.h"

namespace fs = std::filesystem;

namespace rollrig {

struct Run::Data {
  scenarios::RunSpec spec;
  scenarios::PreparedRun run;  // refers to spec
  std::vector<report::ReportFile> files;
};

namespace {

/// What a scenario declares of a result.
std::string find_doc(const scenarios::Scenario& scenario, const std::string& key) {
  for (const scenarios::ResultInfo& info : scenario.results) {
    if (info.key == key) return info.doc;
  }
  return {};
}

Recording make_recording(const sim::Recording<double>& recorded) {
  Recording recording;
  recording.time_s = recorded.time_s;
  recording.phase = recorded.phase;
  for (const sim::PhaseSpan& span : recorded.phases) recording.phases.push_back({span.name, span.start_s, span.end_s});
  for (std::size_t i = 0; i < recorded.channels.size(); ++i) {
    recording.channels.push_back(make_channel(recorded.channels[i].quantity, recorded.values[i]));
  }
  return recording;
}

/// Single results of a JSON object, those of an object in it by "tire_file.rrc_N_per_kN". `prefix` stands before the
/// keys of records in the scenario's declarations.
std::vector<ResultValue> list_values(const scenarios::Scenario& scenario, const Json& result,
                                     const std::string& prefix = "") {
  std::vector<ResultValue> values;
  for (const auto& [key, value] : result.items()) {
    if (value.is_array()) continue;
    if (value.is_object()) {
      for (ResultValue& inner : list_values(scenario, value, prefix + key + ".")) {
        inner.name = key + "." + inner.name;
        values.push_back(std::move(inner));
      }
      continue;
    }
    values.push_back({key, plain_name(key), unit_of_key(key).symbol, find_doc(scenario, prefix + key), {}, {}});
    if (value.is_number()) values.back().number = value.get<double>();
    if (value.is_boolean()) values.back().number = value.get<bool>() ? 1.0 : 0.0;
    if (value.is_string()) values.back().text = value.get<std::string>();
  }
  return values;
}

std::vector<ResultRecords> list_records(const scenarios::Scenario& scenario, const Json& result) {
  std::vector<ResultRecords> lists;
  for (const auto& [key, value] : result.items()) {
    if (!value.is_array()) continue;
    lists.push_back({key, find_doc(scenario, key), {}});
    for (const Json& record : value) lists.back().records.push_back(list_values(scenario, record, key + "[]."));
  }
  return lists;
}

/// What a file is to a run.
std::string find_role(const scenarios::RunSpec& spec, const RunInput& input, const std::string& path) {
  const auto is = [&path](const std::string& other) {
    std::error_code none;
    return !other.empty() && fs::equivalent(path, other, none);
  };
  if (is(spec.tire.path)) return "tire";
  if (is(spec.rig.path)) return "rig";
  if (spec.vehicle.has_value() && is(spec.vehicle->path)) return "vehicle";
  if (is_file_name(input.scenario_or_file) && is(input.scenario_or_file)) return "run";
  return fs::path(path).extension() == ".toml" ? "other file" : "data";
}

/// Adds the uncertainty to the result that is there. Returns its tables, none where it was not asked for.
std::vector<Table> add_run_uncertainty(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome,
                                       const UncertaintyOptions& options, const Progress& progress, Json& json,
                                       RunResult& result) {
  const bool is_possible = !outcome.why_no_uncertainty.has_value();
  if (!wants_uncertainty(options, is_possible)) return {};
  if (!is_possible) throw InputError(*outcome.why_no_uncertainty);
  UncertaintyOptions how = options;
  how.seed = spec.seed;
  std::vector<Table> tables = add_uncertainty(outcome.make_measurement_model(), how, progress, json);
  result.text += format_tables(tables);
  return tables;
}

}  // namespace

Run::Run(const RunInput& input) {
  const ReadRecorder recorder;
  const auto data = std::make_shared<Data>();
  data->spec = read_run(input);
  data->run = scenarios::prepare_run(data->spec);
  data->files =
      list_report_files(recorder, [&](const std::string& path) { return find_role(data->spec, input, path); });
  data_ = data;
}

const std::string& Run::scenario() const { return data_->spec.scenario->text.name; }
bool Run::writes_set() const { return data_->spec.scenario->writes_sets; }
bool Run::has_sensors() const { return data_->spec.sensors.has_value(); }

bool Run::has_test_report() const { return report::find_run_report(scenario()) != nullptr; }
bool Run::has_uncertainty() const { return data_->spec.scenario->has_uncertainty; }

std::vector<std::string> list_scenarios_with_test_report() { return report::list_run_reports(); }

std::vector<std::string> list_scenarios_with_uncertainty() {
  std::vector<std::string> names;
  for (const scenarios::Scenario* scenario : scenarios::all_scenarios()) {
    if (scenario->has_uncertainty) names.push_back(scenario->text.name);
  }
  return names;
}

void Run::check(const UncertaintyOptions& uncertainty) const {
  const bool is_asked = uncertainty.budget || uncertainty.monte_carlo_trials != 0;
  if (is_asked && !has_uncertainty()) {
    throw InputError({fmt::format("the results of scenario '{}' have no uncertainty budget", scenario()),
                      "command line", 0, uncertainty.monte_carlo_trials != 0 ? "--monte-carlo" : "--uncertainty", "",
                      fmt::format("a scenario with one: {}", fmt::join(list_scenarios_with_uncertainty(), ", ")), ""});
  }
  check_uncertainty(uncertainty);
}

RunResult Run::carry_out(const Progress& progress, const UncertaintyOptions& uncertainty) const {
  check(uncertainty);
  using Ledger = sim::EnergyTerm::Ledger;
  const sim::Progress show = [&progress](double done) { progress(done, ""); };
  const auto outcome = std::make_shared<const scenarios::Outcome>(data_->run(progress ? show : sim::Progress()));
  const scenarios::RunSpec& spec = data_->spec;
  RunResult result;
  result.values = list_values(*spec.scenario, outcome->result);
  result.records = list_records(*spec.scenario, outcome->result);
  result.warnings = outcome->warnings;
  result.mechanical_closure = outcome->recording.audit.calc_closure(Ledger::kMechanical);
  result.thermal_closure = outcome->recording.audit.calc_closure(Ledger::kThermal);
  result.text = report::format_outcome(spec, *outcome);
  Json json = scenarios::make_result_json(spec, *outcome);
  const std::vector<Table> budgets = add_run_uncertainty(spec, *outcome, uncertainty, progress, json, result);
  result.json = to_text(json);
  result.make_files = [data = data_, outcome, json = result.json] {
    return FolderFiles{{"result.json", json},
                       {"recording.csv", scenarios::make_recording_csv(outcome->recording)},
                       {"manifest.json", to_text(scenarios::make_manifest(data->spec, *outcome))}};
  };
  result.make_page = [data = data_, outcome, budgets, of_json = json.value("uncertainty", Json())] {
    report::Page page = report::make_run_page(data->spec, *outcome);
    if (!budgets.empty()) put_budgets_on_tiles(of_json, page);
    return make_page_with_uncertainty(std::move(page), budgets);
  };
  if (has_test_report()) {
    result.make_test_report = [data = data_, outcome, json = std::move(json)] {
      return report::make_report_html(report::make_run_report(data->spec, *outcome, json, data->files),
                                      report::find_report_date());
    };
  }
  result.make_recording = [outcome] { return make_recording(outcome->recording); };
  if (!writes_set()) return result;
  result.make_set_files = [data = data_, outcome] {
    return to_folder(scenarios::write_measurement_set(data->spec, *outcome, data->spec.scenario->text.name));
  };
  return result;
}

}  // namespace rollrig
