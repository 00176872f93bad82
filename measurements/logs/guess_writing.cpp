// Guesses as a mapping, as a set.toml, and as a table for a person.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <boost/algorithm/string/replace.hpp>

#include "measurements/logs/guess.h"
#include "measurements/sensor_file.h"

namespace fs = std::filesystem;

namespace rollrig::measurements {
namespace {

constexpr double kFastest_s = 1.0;  // of the rows of a set; a faster log is averaged

bool is_file_path(const std::string& name) {
  return name.find('/') != std::string::npos || fs::path(name).extension() == ".toml";
}

/// A name of an asset as it is; a path as it is seen from a folder.
std::string name_from(const std::string& folder, const std::string& name) {
  if (!is_file_path(name)) return name;
  const fs::path base = fs::weakly_canonical(fs::absolute(folder.empty() ? "." : folder));
  return fs::weakly_canonical(fs::absolute(name)).lexically_relative(base).string();
}

std::string find_set_name(const GuessOptions& options) {
  if (!options.name.empty()) return options.name;
  const fs::path folder = fs::weakly_canonical(fs::absolute(options.folder));
  return (fs::is_directory(folder) ? folder.filename() : folder.stem()).string();
}

/// The preset of sensors for logs that say nothing of them.
std::string find_sensors(const Guess& guess) {
  if (!guess.source.options.sensors.empty()) return guess.source.options.sensors;
  if (!guess.source.kind->default_sensors.empty()) return guess.source.kind->word;
  const bool has_gas = std::any_of(guess.columns.begin(), guess.columns.end(), [](const GuessedColumn& column) {
    return column.target == models::quantities::kGasTemperature;
  });
  return has_gas ? "source_with_gas" : "source";
}

/// Sensors of the channels that the logs have.
models::SensorSet read_sensors_of_logs(const Guess& guess) {
  models::SensorSet sensors = read_sensor_asset(find_sensors(guess));
  models::SensorSet of_logs;
  for (const GuessedColumn& column : guess.columns) {
    const auto sensor = sensors.find(column.target);
    if (sensor != sensors.end()) of_logs.insert(*sensor);
  }
  return of_logs;
}

std::string explain_sensors(const Guess& guess) {
  return guess.source.options.sensors.empty()
             ? "Assumed: the logs do not tell the errors of the sensors; data sheets do"
             : "as --sensors says";
}

std::string name_separator(char separator) {
  return separator == ';' ? "semicolon" : separator == '\t' ? "tab" : "comma";
}

std::string show_column_value(const GuessedColumn& column) {
  if (column.value.has_value()) return fmt::format("{{ value = {:.10g} }}", *column.value);
  const bool is_plain = column.unit.suffix == column.target.unit_suffix() && column.unit.factor == 1.0 &&
                        column.unit.offset == 0.0 && column.sign == 1.0 && column.dead_band == 0.0;
  if (is_plain) return quote(column.heading);
  std::string text = fmt::format("{{ column = {}", quote(column.heading));
  if (column.unit.suffix != column.target.unit_suffix()) text += fmt::format(", unit = {}", quote(column.unit.suffix));
  const double factor = column.sign * column.unit.factor;
  if (factor != 1.0) text += fmt::format(", factor = {:.13g}", factor);
  if (column.unit.offset != 0.0) text += fmt::format(", offset = {:.10g}", column.unit.offset);
  if (column.dead_band != 0.0) text += fmt::format(", dead_band = {:.10g}", column.dead_band);
  return text + " }";
}

/// "key = value   # comment", one below the other.
class CommentedText {
 public:
  void line(const std::string& key, const std::string& value, const std::string& comment) {
    const std::string assignment = fmt::format("{} = {}", key, value);
    text_ += comment.empty() ? assignment + "\n" : fmt::format("{:<48} # {}\n", assignment, comment);
  }
  void text(const std::string& more) { text_ += more; }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void write_form(const GuessedForm& form, CommentedText& out) {
  out.line("separator", quote(name_separator(form.csv.separator)), "guessed: gives rows of one length");
  out.line("decimal", quote(form.csv.decimal == ',' ? "comma" : "point"),
           form.has_decimals ? "guessed: from the numbers" : "guessed: no number has decimals");
  out.line("header_line", std::to_string(form.csv.header_line), "guessed: the names above the numbers");
  out.line("first_row_line", std::to_string(form.csv.first_row_line),
           form.units.empty() ? "guessed: the first line of numbers" : "guessed: below a line of units");
  if (form.missing.empty()) return;
  std::string words;
  for (const std::string& word : form.missing) words += (words.empty() ? "" : ", ") + quote(word);
  out.line("missing", "[" + words + "]", "guessed: stand in the place of numbers");
}

void write_time(const GuessedTime& time, CommentedText& out) {
  out.line("column", quote(time.heading), "guessed: " + time.reason);
  out.line("form", quote(time.form), "guessed");
  if (time.form == "seconds" && time.unit != "s") out.line("unit", quote(time.unit), "guessed");
  if (!time.date_heading.empty()) out.line("date_column", quote(time.date_heading), "guessed: cells are dates");
  if (!time.date.empty()) out.line("date", quote(time.date), "any day: the logs state none");
  if (!time.date_order.empty()) out.line("date_order", quote(time.date_order), "guessed");
}

/// Keys of a [[run]] of sets and mappings that say how the tire was at the start.
void write_tire_state(const GuessedRun& run, CommentedText& out) {
  out.line("session", quote(run.session), "guessed, as the next keys: " + run.reason);
  out.line("initial_tire_temperature_degC", fmt::format("{:.2f}", run.initial_tire_temperature_K - kZeroCelsius_K), "");
  out.line("cold_pressure_kPa", fmt::format("{:.10g}", run.cold_pressure_Pa / 1e3), "");
  if (run.rest_before_s.has_value() && *run.rest_before_s > 0.0) {
    out.line("rest_before_min", fmt::format("{:.10g}", *run.rest_before_s / 60.0), "");
  } else if (run.rest_before_s.has_value()) {
    out.line("tire_state", quote("warm"), "right after another run");
  }
}

void write_tire_and_machine(const Guess& guess, const std::string& folder, CommentedText& out) {
  const GuessOptions& options = guess.source.options;
  out.line("name", quote(find_set_name(options)), "");
  out.line("tire", quote(name_from(folder, options.tire)), "");
  if (options.vehicle.empty()) {
    out.line("rig", quote(name_from(folder, options.rig)), "");
  } else {
    out.line("kind", quote("road"), "");
    out.line("vehicle", quote(name_from(folder, options.vehicle)), "");
  }
}

std::string describe_run(const GuessedRun& run) {
  const std::string rest = !run.rest_before_s.has_value() ? "soaked"
                           : *run.rest_before_s > 0.0     ? fmt::format("rest {:.4g} min", *run.rest_before_s / 60.0)
                                                          : "warm";
  return fmt::format("{:.1f} degC, {:.1f} kPa, {}, session {}", run.initial_tire_temperature_K - kZeroCelsius_K,
                     run.cold_pressure_Pa / 1e3, rest, run.session);
}

}  // namespace

std::vector<GuessLine> list_guesses(const Guess& guess) {
  const GuessedForm& form = guess.source.form;
  std::vector<GuessLine> lines{
      {"form",
       fmt::format("{}, decimal {}, headings in line {}, rows from line {}", name_separator(form.csv.separator),
                   form.csv.decimal == ',' ? "comma" : "point", form.csv.header_line, form.csv.first_row_line),
       form.units.empty() ? "" : "with a line of units"},
      {"time",
       fmt::format("'{}', {}", guess.time.heading, guess.time.form == "seconds" ? guess.time.unit : guess.time.form),
       guess.time.reason}};
  for (const GuessedColumn& column : guess.columns) {
    lines.push_back({column.target.header(),
                     column.value.has_value()
                         ? fmt::format("{:.10g}", *column.value)
                         : fmt::format("'{}', {}{}", column.heading, column.sign < 0.0 ? "-" : "", column.unit.written),
                     column.reason});
  }
  for (const GuessedRun& run : guess.runs) lines.push_back({"run " + run.id, describe_run(run), run.reason});
  lines.push_back({"sensors", find_sensors(guess), explain_sensors(guess)});
  if (!guess.unread.empty()) lines.push_back({"not read", fmt::format("{}", fmt::join(guess.unread, ", ")), ""});
  return lines;
}

bool are_files_of_set(const Guess& guess) {
  const CsvForm& csv = guess.source.form.csv;
  if (csv.separator != ',' || csv.decimal != '.' || csv.header_line != 1 || csv.first_row_line != 2) return false;
  if (guess.time.heading != "time_s" || !guess.unread.empty() || !guess.source.form.missing.empty()) return false;
  return std::all_of(guess.columns.begin(), guess.columns.end(), [](const GuessedColumn& column) {
    return column.heading == column.target.header() && column.sign == 1.0 && column.dead_band == 0.0;
  });
}

std::string write_guessed_mapping(const Guess& guess, const std::string& folder) {
  CommentedText out;
  out.text(
      "# Guessed from the logs. Check the comments, correct what is wrong, and run rollrig import on this file.\n");
  out.text("format = \"rollrig-import/1\"\n");
  write_tire_and_machine(guess, folder, out);
  out.line("sensors", quote(name_from(folder, find_sensors(guess))), explain_sensors(guess));
  if (guess.interval_s < 0.75 * kFastest_s) {
    out.line("interval_s", fmt::format("{:.4g}", kFastest_s),
             fmt::format("the logs have a row each {:.4g} s: means over one second", guess.interval_s));
  }
  if (guess.interval_s > 2.5) {
    out.line("longest_given_gap_s", fmt::format("{:.4g}", 2.0 * guess.interval_s),
             fmt::format("the logs have a row each {:.4g} s", guess.interval_s));
  }
  out.text("\n[torque_log]\n");
  write_form(guess.source.form, out);
  out.text("\n[torque_log.time]\n");
  write_time(guess.time, out);
  out.text("\n[torque_log.columns]\n");
  for (const GuessedColumn& column : guess.columns) {
    out.line(column.target.header(), show_column_value(column), "guessed: " + column.reason);
  }
  if (!guess.unread.empty()) out.text(fmt::format("# not read: {}\n", fmt::join(guess.unread, ", ")));
  for (const GuessedRun& run : guess.runs) {
    out.text("\n[[run]]\n");
    out.line("id", quote(run.id), "");
    out.line("torque_log", quote(name_from(folder, fs::absolute(run.path).string())), "");
    write_tire_state(run, out);
  }
  return out.take();
}

std::string write_guessed_set(const Guess& guess, const std::string& folder) {
  CommentedText out;
  out.text("# The CSV files are those of a set as they are. Guessed is what has a comment.\n");
  out.text(write_set_format(*guess.source.kind));
  write_tire_and_machine(guess, folder, out);
  out.text(fmt::format("\n# Sensors: {}. {}\n", find_sensors(guess), explain_sensors(guess)));
  out.text(write_sensors(read_sensors_of_logs(guess)));
  for (const GuessedRun& run : guess.runs) {
    out.text("\n[[run]]\n");
    out.line("id", quote(run.id), "");
    out.line("file", quote(name_from(folder, fs::absolute(run.path).string())), "");
    write_tire_state(run, out);
  }
  return out.take();
}

}  // namespace rollrig::measurements
