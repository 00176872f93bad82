#include <fmt/format.h>

#include <cmath>

#include "measurements/logs/import.h"
#include "sim/core/csv.h"

namespace rollrig::measurements {
namespace {

std::string make_run_csv(const ResampledRun& run) {
  std::vector<std::string> header{"time_s"};
  for (const auto& column : run.columns) header.push_back(column.first.header());
  CsvWriter csv(header);
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    csv.add(run.time_s[row]);
    for (const auto& [quantity, values] : run.columns) csv.add(quantity.file_unit().from_si(values[row]));
    csv.end_row();
  }
  return csv.take();
}

std::string make_set_toml(const Mapping& mapping, const Import& imported) {
  std::string text = "# Made by rollrig import; import.json says how.\n";
  for (const ClockEstimate& clock : imported.clocks) {
    text += fmt::format("# clock of {}: shift {:.3f} +- {:.3f} s (1 sd)\n", quote(clock.tire_log), clock.clock.shift_s,
                        clock.calc_shift_sd_s());
  }
  text += fmt::format("{}name = {}\ntire = \"tire.toml\"\n{}\nbaseline = {}\n", write_set_format(*mapping.set.kind),
                      quote(mapping.set.name),
                      mapping.set.kind->names_rig() ? "rig = \"rig.toml\"" : "vehicle = \"vehicle.toml\"",
                      quote(mapping.baseline));
  text += write_sensors(imported.sensors);
  for (const ImportedRun& run : imported.runs) text += write_run_table(run.plan);
  return text;
}

std::string make_marks_csv(const Import& imported) {
  CsvWriter csv({"log", "line", "column", "from_s", "to_s", "value", "reason"});
  for (const Log& log : imported.logs) {
    for (const Mark& mark : log.marks) {
      csv.add_row(mark.log, static_cast<double>(mark.line), mark.column.header(), CsvWriter::Rounded{mark.from_s, 15},
                  CsvWriter::Rounded{mark.to_s, 15}, mark.value.value_or(std::nan("")), mark.reason);
    }
  }
  return csv.take();
}

Json make_clock_json(const ClockEstimate& clock) {
  return {
      {"torque_log", clock.torque_log},
      {"tire_log", clock.tire_log},
      {"method", clock.method},
      {"shift_s", clock.clock.shift_s},
      {"shift_sd_s", clock.calc_shift_sd_s()},
      {"sd_parts_s",
       {{"statistical", clock.statistical_sd_s}, {"sampling", clock.sampling_sd_s}, {"response_lag", clock.lag_sd_s}}},
      {"at_tire_log_s", clock.clock.reference_s},
      {"rate_ppm", 1e6 * clock.clock.rate},
      {"rate_sd_ppm", 1e6 * clock.rate_sd},
      {"rate_is_decided_by_data", clock.rate_is_decided},
      {"searched_s", {clock.searched_from_s, clock.searched_to_s}},
      {"log_likelihood_gain", clock.gain},
      {"log_likelihood_gain_of_next", clock.gain_next},
      {"evidence", make_list(clock.evidence, [](const ClockEvidence& evidence) -> Json {
         return {{"channel", evidence.channel.header()},
                 {"kind", evidence.is_common ? "common" : "response"},
                 {"rows", evidence.rows},
                 {"explained_percent", 100.0 * evidence.explained}};
       })}};
}

/// A value as the log has it, without what the way to SI and back added in the last digits.
Json as_read(double value) { return std::stod(fmt::format("{:.12g}", value)); }

template <class T>
Json make_json(const QuantityMap<T>& values) {
  Json json = Json::object();
  for (const auto& [quantity, value] : values) json[quantity.header()] = value;
  return json;
}

Json make_log_json(const Log& log) {
  return {{"file", log.file},
          {"form", log.form},
          {"rows", log.time_s.size()},
          {"interval_s", log.interval_s},
          {"ignored_columns", log.ignored_columns},
          {"taken_as_zero", make_json(log.dead_banded)},
          {"marks", make_list(log.marks, [](const Mark& mark) -> Json {
             return {{"line", mark.line},
                     {"column", mark.column.name().empty() ? Json(nullptr) : Json(mark.column.header())},
                     {"from_s", mark.from_s},
                     {"to_s", mark.to_s},
                     {"value", mark.value.has_value() ? as_read(*mark.value) : Json(nullptr)},
                     {"reason", mark.reason}};
           })}};
}

Json make_run_json(const ImportedRun& run) {
  return {{"id", run.plan.id},
          {"rows", run.rows.time_s.size()},
          {"start_on_torque_log_s", run.rows.start_s},
          {"clock", run.clock.has_value() ? Json(*run.clock) : Json(nullptr)},
          {"samples_a_row", make_json(run.rows.samples_a_row)},
          {"rows_between_samples", make_json(run.rows.rows_between)},
          {"empty", make_list(run.rows.empty, [](const EmptyRange& range) -> Json {
             return {{"column", range.column.header()},
                     {"from_s", range.from_s},
                     {"to_s", range.to_s},
                     {"rows", range.rows},
                     {"rows_left_out", range.rows_left_out},
                     {"reason", range.reason}};
           })}};
}

}  // namespace

std::map<std::string, std::string> make_set_files(const Mapping& mapping, const Import& imported) {
  std::map<std::string, std::string> files;
  files["set.toml"] = make_set_toml(mapping, imported);
  files["tire.toml"] = mapping.set.tire.content;
  files.merge(mapping.set.kind->names_rig() ? std::map<std::string, std::string>{{"rig.toml", mapping.machine_content}}
                                            : rigs::write_vehicle_files(*mapping.set.vehicle, mapping.machine_content));
  for (const ImportedRun& run : imported.runs) files[run.plan.id + ".csv"] = make_run_csv(run.rows);
  files["marks.csv"] = make_marks_csv(imported);
  files["import.json"] = to_text(make_import_json(mapping, imported));
  return files;
}

Json make_import_json(const Mapping& mapping, const Import& imported) {
  return {{"format", "rollrig-import-report/1"},
          {"set", mapping.set.name},
          {"clocks", make_list(imported.clocks, make_clock_json)},
          {"runs", make_list(imported.runs, make_run_json)},
          {"logs", make_list(imported.logs, make_log_json)},
          {"warnings", imported.warnings}};
}

}  // namespace rollrig::measurements
