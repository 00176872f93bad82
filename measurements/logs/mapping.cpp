#include "measurements/logs/mapping.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include <boost/algorithm/string/case_conv.hpp>

#include "measurements/sensor_file.h"
#include "sim/core/assets.h"
#include "sim/core/file_io.h"
#include "sim/core/text_encoding.h"
#include "sim/core/unit_names.h"

namespace fs = std::filesystem;

namespace rollrig::measurements {
namespace {

/// The unit of a column: one of the dimension that the column of the set has.
Unit read_unit(TableReader& reader, const Quantity& target) {
  const Unit wanted = target.file_unit();
  if (!reader.has("unit")) {
    reader.accept("unit");
    return wanted;
  }
  const std::string text = reader.text("unit");
  try {
    return parse_unit(text, wanted);
  } catch (const std::invalid_argument& error) {
    const std::vector<std::string> names = list_unit_names(wanted.dimension);
    InputProblem problem =
        reader
            .problem("unit", fmt::format("'{}' is no unit of {}: {}", text, target.header(), error.what()),
                     fmt::format("{}, or another unit of {} that UDUNITS knows", fmt::join(names, ", "),
                                 describe_dimension(wanted.dimension)))
            .problem();
    problem.nearest = nearest_name(text, names);
    throw InputError(problem);
  }
}

LogColumn read_mapped_column(const ConfigTable& columns, const rigs::Column& of_set, const std::string& table_name) {
  LogColumn column;
  const std::string heading = of_set.quantity.header();
  column.target = of_set.quantity;
  column.allowed = of_set.range;
  column.unit = of_set.quantity.file_unit();
  const ConfigValue& value = *columns.find(heading);
  if (const auto* name = std::get_if<std::string>(&value.data)) {
    column.column = *name;
    return column;
  }
  TableReader parent(columns, table_name);
  TableReader reader(*parent.table(heading), fmt::format("{} {}", table_name, heading));
  if (reader.has("value")) {
    const Field constant{"value", of_set.range, "constant"};
    column.constant_SI = column.unit.to_si(reader.number(constant));
    reader.finish();
    return column;
  }
  column.column = reader.text("column");
  column.unit = read_unit(reader, column.target);
  column.factor = reader.number({"factor", any_number(), "", 1.0});
  if (column.factor == 0.0) throw reader.problem("factor", "a factor of 0 leaves nothing", "any number but 0");
  column.offset = reader.number({"offset", any_number(), "", 0.0});
  column.allowed.lower = reader.number({"lowest", of_set.range, "", of_set.range.lower});
  column.allowed.upper = reader.number({"highest", of_set.range, "", of_set.range.upper});
  column.dead_band = reader.number({"dead_band", non_negative(), "", 0.0});
  reader.finish();
  return column;
}

void read_columns(TableReader& log, const MachineKind& kind, LogForm& form) {
  const ConfigTable* table = log.table("columns");
  const std::string name = fmt::format("[{}.columns]", form.name);
  if (table == nullptr)
    throw log.problem("columns", "the log has no columns", name + " with <column of the set> = ...");
  TableReader reader(*table, name);
  const std::vector<rigs::Column> columns = kind.columns.all();
  for (const rigs::Column& column : columns) reader.accept(column.quantity.header());
  reader.finish();
  for (const rigs::Column& column : columns) {
    if (table->find(column.quantity.header()) != nullptr)
      form.columns.push_back(read_mapped_column(*table, column, name));
  }
}

/// A date of a mapping is wrong where it stands, not where the first row is read.
void require_date(const TableReader& reader, const TimeColumn& time) {
  if (!time.date_column.empty()) {
    throw reader.problem("date", "the date is given twice: date and date_column", "one of them");
  }
  try {
    parse_date_days(time.date, time.date_order);
  } catch (const std::invalid_argument& error) {
    throw reader.problem("date", error.what(), "a date such as 2024-03-05, in the order of date_order (ymd)");
  }
}

void read_time(TableReader& log, LogForm& form) {
  const ConfigTable* table = log.table("time");
  const std::string name = fmt::format("[{}.time]", form.name);
  if (table == nullptr) throw log.problem("time", "the log has no time", name + " with column and form");
  TableReader reader(*table, name);
  TimeColumn& time = form.time;
  time.column = reader.text("column");
  const std::vector<std::string>& names = time_form_names();
  const auto at = std::find(names.begin(), names.end(), reader.text("form", names)) - names.begin();
  time.form = static_cast<TimeForm>(at);
  const std::string unit = reader.text_or("unit", "s", {"s", "ms", "us", "min", "h"});
  if (unit != "s" && time.form != TimeForm::kSeconds && time.form != TimeForm::kEpochSeconds) {
    throw reader.problem("unit", "only times that are numbers have a unit", "form = \"seconds\" or \"epoch_seconds\"");
  }
  time.unit_s = unit == "us" ? 1e-6 : unit_of_key("time_" + unit).factor;
  time.date_column = reader.text_or("date_column", "");
  time.date = reader.text_or("date", "");
  time.date_order = reader.text_or("date_order", "ymd", date_orders());
  const bool is_clock = time.form == TimeForm::kClock;
  if (reader.has("date_order") && !is_clock && time.form != TimeForm::kDateTime) {
    throw reader.problem("date_order", "times of this form have no date to be read",
                         "form = \"clock\" or \"date_time\"");
  }
  if (is_clock == (time.date.empty() && time.date_column.empty())) {
    throw reader.problem("form", is_clock ? "a time of day has no date" : "only times of day need a date",
                         "date = \"2024-03-05\" or date_column with form = \"clock\", neither with another");
  }
  if (!time.date.empty()) require_date(reader, time);
  time.utc_offset_s = reader.number_or_none({"utc_offset_h", between(-14.0, 14.0), ""});
  if (time.utc_offset_s.has_value() && time.form == TimeForm::kSeconds) {
    throw reader.problem("utc_offset_h", "seconds from a start of their own have no offset to UTC",
                         "no such key with form = \"seconds\"; form = \"epoch_seconds\" counts from 1970");
  }
  reader.finish();
}

LogForm read_log_form(const ConfigTable& table, const std::string& name, const MachineKind& kind) {
  LogForm form;
  form.name = name;
  TableReader reader(table, fmt::format("[{}]", name));
  const std::string separator = reader.text_or("separator", "comma", {"comma", "semicolon", "tab"});
  form.csv.separator = separator == "comma" ? ',' : separator == "semicolon" ? ';' : '\t';
  form.csv.decimal = reader.text_or("decimal", "point", {"point", "comma"}) == "point" ? '.' : ',';
  if (form.csv.decimal == form.csv.separator) {
    throw reader.problem("decimal", "separator and decimal are both a comma", "separator = \"semicolon\" or \"tab\"");
  }
  form.csv.encoding = reader.text_or("encoding", "utf-8", encoding_names());
  form.csv.encoding_hint = fmt::format(
      "text as encoding of [{}] says: \"utf-8\" (default), \"windows-1252\" or, with a byte order mark, \"utf-16\"",
      name);
  form.csv.hint = "separator, decimal, header_line and first_row_line of the mapping say how a log is written";
  form.csv.header_line = reader.count({"header_line", between(1, 1000), "", 1.0});
  form.csv.first_row_line =
      reader.count({"first_row_line", between(2, 1100), "", static_cast<double>(form.csv.header_line + 1)});
  if (form.csv.first_row_line <= form.csv.header_line) {
    throw reader.problem("first_row_line", "the first row stands above the header", "more than header_line");
  }
  form.missing = {"NaN", "nan", "NAN", "-", "--", "---", "#N/A"};
  if (const ConfigValue* missing = table.find("missing")) {
    const ConfigArray* array = missing->as_array();
    if (array == nullptr) throw reader.problem("missing", "'missing' must be a list", "missing = [\"OVER\", \"NaN\"]");
    form.missing.clear();
    for (const ConfigValue& item : *array) {
      const auto* text = std::get_if<std::string>(&item.data);
      if (text == nullptr) throw reader.problem("missing", "'missing' must hold strings", "missing = [\"OVER\"]");
      form.missing.push_back(*text);
    }
  }
  reader.accept("missing");
  read_time(reader, form);
  read_columns(reader, kind, form);
  reader.finish();
  return form;
}

void read_clock(TableReader& top, ClockPlan& clock) {
  const ConfigTable* table = top.table("clock");
  if (table == nullptr) return;
  TableReader reader(*table, "[clock]");
  clock.largest_shift_s = reader.number({"largest_shift_s", between(1.0, 86400.0), "", clock.largest_shift_s});
  clock.rate_sd = 1e-6 * reader.number({"rate_sd_ppm", between(0.0, 20000.0), "", 1e6 * clock.rate_sd});
  clock.response_lag_sd_s = reader.number({"response_lag_sd_s", non_negative(), "", clock.response_lag_sd_s});
  clock.largest_sd_s = reader.number({"largest_sd_s", positive(), "", clock.largest_sd_s});
  clock.load_changes_at_rows = reader.text_or("load_changes", "between_rows", {"between_rows", "at_rows"}) == "at_rows";
  clock.shift_s = reader.number_or_none({"shift_s", any_number(), ""});
  clock.shift_sd_s = reader.number_or_none({"shift_sd_s", positive(), ""});
  if (clock.shift_s.has_value() != clock.shift_sd_s.has_value()) {
    throw reader.problem("shift_s", "a shift stands without its uncertainty, or the other way round",
                         "shift_s and shift_sd_s, both or neither");
  }
  reader.finish();
}

RunPlan read_run_plan(const ConfigTable& table, const std::string& folder, const Mapping& mapping) {
  TableReader reader(table, "[[run]]");
  RunPlan run;
  run.origin = table.origin;
  run.id = reader.text("id");
  if (run.id.empty() || run.id.front() == '.' || run.id.find_first_of("/\\\"") != std::string::npos) {
    throw reader.problem("id", "a run's id names its file", "a name without / \\ and \", not starting with a dot");
  }
  if (boost::algorithm::to_lower_copy(run.id) == "marks") {
    throw reader.problem("id", "marks.csv is the file of what was not taken over", "another id");
  }
  read_run_table(reader, run);
  run.torque_log = (fs::path(folder) / reader.text("torque_log")).string();
  const std::string tire_log = mapping.tire_log.has_value() ? reader.text("tire_log") : std::string();
  if (!tire_log.empty()) run.tire_log = (fs::path(folder) / tire_log).string();
  run.from = reader.text_or("from", "");
  run.to = reader.text_or("to", "");
  reader.finish();
  return run;
}

void read_tire_and_machine(TableReader& reader, const std::string& folder, Mapping& mapping) {
  MeasurementSet& set = mapping.set;
  const std::string tire = find_asset_of(reader, "tire", folder, "tires", reader.text("tire"));
  set.tire = models::read_tire(read_config(tire));
  set.tire.content = read_text_file(tire);
  mapping.machine_content = read_machine(reader, folder, set);
}

void read_sensor_tables(TableReader& reader, const std::string& folder, MeasurementSet& set) {
  const ConfigValue* value = reader.source().find("sensors");
  if (value != nullptr && value->as_table() == nullptr) {
    set.sensors = read_sensor_asset(find_asset_of(reader, "sensors", folder, "sensors", reader.text("sensors")));
    return;
  }
  const ConfigTable* table = reader.table("sensors");
  if (table == nullptr) {
    throw reader.problem("sensors", "the mapping says nothing of the sensors",
                         "sensors = a name under assets/sensors or a path, or [sensors.<channel>] tables");
  }
  set.sensors = models::read_sensors(*table, measured_channels(*set.kind));
}

bool maps(const LogForm& form, const Quantity& target) {
  return std::any_of(form.columns.begin(), form.columns.end(),
                     [&target](const LogColumn& column) { return column.target == target; });
}

/// Each given column must come from somewhere, each measured one from one log only and with a sensor.
void check_columns(const TableReader& reader, const Mapping& mapping) {
  const rigs::RunColumns& columns = mapping.set.kind->columns;
  for (const rigs::Column& column : columns.given) {
    const std::string heading = column.quantity.header();
    const bool in_tire = mapping.tire_log.has_value() && maps(*mapping.tire_log, column.quantity);
    if (maps(mapping.torque_log, column.quantity) || in_tire) continue;
    throw reader.problem("torque_log", fmt::format("no log gives '{}', which every row of the set needs", heading),
                         fmt::format("{} = \"<column>\" or {{ value = ... }} under [torque_log.columns]", heading));
  }
  bool any = false;
  for (const rigs::Column& column : columns.measured) {
    const std::string heading = column.quantity.header();
    const bool in_torque = maps(mapping.torque_log, column.quantity);
    const bool in_tire = mapping.tire_log.has_value() && maps(*mapping.tire_log, column.quantity);
    any = any || in_torque || in_tire;
    if (in_torque && in_tire) {
      throw reader.problem("tire_log", fmt::format("both logs give '{}'", heading),
                           "a measured column from one log only");
    }
    if ((in_torque || in_tire) && mapping.set.sensors.count(column.quantity) == 0) {
      throw reader.problem(
          "sensors", fmt::format("'{}' is measured, and no sensor is given for it", heading),
          fmt::format("[sensors.{}] with offset_sd, drift_sd, drift_time_s, noise_sd, resolution", heading));
    }
  }
  if (!any)
    throw reader.problem("torque_log", "no log gives a measured column",
                         mapping.set.kind->traits.force.header() + " = \"<column>\", ...");
}

}  // namespace

Mapping read_mapping(const std::string& path, const std::string& data_folder) {
  return read_mapping(read_config(path), path, data_folder);
}

Mapping read_mapping(const ConfigTable& config, const std::string& path, const std::string& data_folder) {
  const std::string base = fs::path(path).parent_path().string();
  TableReader reader(config, "");
  check_format(reader, "rollrig-import", 1);
  Mapping mapping;
  mapping.set.name = reader.text("name");
  mapping.baseline = reader.text_or("baseline", "combined", {"combined", "constant_rrc"});
  read_tire_and_machine(reader, base, mapping);
  read_sensor_tables(reader, base, mapping.set);
  const ConfigTable* torque_log = reader.table("torque_log");
  if (torque_log == nullptr) throw reader.problem("torque_log", "the mapping has no [torque_log]", "[torque_log]");
  mapping.torque_log = read_log_form(*torque_log, "torque_log", *mapping.set.kind);
  if (const ConfigTable* tire_log = reader.table("tire_log")) {
    mapping.tire_log = read_log_form(*tire_log, "tire_log", *mapping.set.kind);
  }
  read_clock(reader, mapping.clock);
  mapping.interval_s = reader.number_or_none({"interval_s", between(0.01, 3600.0), ""});
  mapping.longest_given_gap_s = reader.number({"longest_given_gap_s", non_negative(), "", mapping.longest_given_gap_s});
  mapping.spike_threshold = reader.number({"spike_threshold", between(4.0, 1000.0), "", mapping.spike_threshold});
  const std::string folder = data_folder.empty() ? base : data_folder;
  for (const ConfigTable* run : reader.tables("run")) mapping.runs.push_back(read_run_plan(*run, folder, mapping));
  if (mapping.runs.empty()) throw reader.problem("run", "the mapping has no runs", "one [[run]] table at least");
  for (std::size_t i = 0; i < mapping.runs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (mapping.runs[k].id != mapping.runs[i].id) continue;
      throw InputError({"two runs have one id", path, mapping.runs[i].origin.line, "[[run]] id", mapping.runs[i].id,
                        "a different id for every run", ""});
    }
  }
  reader.finish();
  check_columns(reader, mapping);
  return mapping;
}

}  // namespace rollrig::measurements
