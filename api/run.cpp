#include "rollrig/run.h"

#include "api/data.h"
#include "report/page.h"
#include "report/run_page.h"

namespace rollrig {

struct Run::Data {
  scenarios::RunSpec spec;
  scenarios::PreparedRun run;  // refers to spec
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

/// Single results of a JSON object; `prefix` stands before the keys of records in the scenario's declarations.
std::vector<ResultValue> list_values(const scenarios::Scenario& scenario, const Json& result,
                                     const std::string& prefix = "") {
  std::vector<ResultValue> values;
  for (const auto& [key, value] : result.items()) {
    if (value.is_array()) continue;
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

}  // namespace

Run::Run(const RunInput& input) {
  const auto data = std::make_shared<Data>();
  data->spec = read_run(input);
  data->run = scenarios::prepare_run(data->spec);
  data_ = data;
}

const std::string& Run::scenario() const { return data_->spec.scenario->text.name; }
bool Run::writes_set() const { return data_->spec.scenario->writes_sets; }
bool Run::has_sensors() const { return data_->spec.sensors.has_value(); }

RunResult Run::carry_out(const Progress& progress) const {
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
  result.json = to_text(scenarios::make_result_json(spec, *outcome));
  result.make_files = [data = data_, outcome, json = result.json] {
    return FolderFiles{{"result.json", json},
                       {"recording.csv", scenarios::make_recording_csv(outcome->recording)},
                       {"manifest.json", to_text(scenarios::make_manifest(data->spec, *outcome))}};
  };
  result.make_page = [data = data_, outcome] { return report::make_html(report::make_run_page(data->spec, *outcome)); };
  result.make_recording = [outcome] { return make_recording(outcome->recording); };
  if (!writes_set()) return result;
  result.make_set_files = [data = data_, outcome] {
    return to_folder(scenarios::write_measurement_set(data->spec, *outcome, data->spec.scenario->text.name));
  };
  return result;
}

}  // namespace rollrig
