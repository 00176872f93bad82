#include "tests/support/foreign_logs.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <random>

#include "tests/support/temporary_folder.h"

namespace rollrig::tests {
namespace {

constexpr double kDay_s = 86400.0;
constexpr double kFirstMorning_s = 19786.0 * kDay_s + 8.0 * 3600.0;  // 2024-03-04, 8 o'clock, since 1970-01-01

/// Names of the columns in two languages and three wordings.
const std::map<std::string, std::array<std::array<const char*, 3>, 2>>& names() {
  static const std::map<std::string, std::array<std::array<const char*, 3>, 2>> all{
      {"speed_km_h", {{{"Drum speed", "Velocity", "v"}, {"Geschwindigkeit", "Trommelgeschwindigkeit", "v"}}}},
      {"load_N", {{{"Wheel load", "Normal force", "Fz"}, {"Radlast", "Aufstandskraft", "Last"}}}},
      {"ambient_degC",
       {{{"Ambient temperature", "Room temp", "T_amb"}, {"Umgebungstemperatur", "Lufttemperatur", "T_Luft"}}}},
      {"drum_torque_Nm", {{{"Torque", "Drum torque", "M"}, {"Drehmoment", "Moment", "M"}}}},
      {"liner_temperature_degC",
       {{{"Inner liner temperature", "Tire temp", "T_liner"},
         {"Reifentemperatur", "Reifeninnentemperatur", "T_innen"}}}},
      {"cavity_pressure_kPa", {{{"Inflation pressure", "Tire pressure", "p"}, {"Reifendruck", "Druck", "p"}}}}};
  return all;
}

struct Conversion {
  const char* unit;
  double factor, offset;  // from the unit of the set
};

Conversion find_conversion(const std::string& column, const LoggerStyle& style) {
  static const std::map<std::string, Conversion> all{
      {"km/h", {"km/h", 1.0, 0.0}},    {"m/s", {"m/s", 1.0 / 3.6, 0.0}}, {"mph", {"mph", 1.0 / 1.609344, 0.0}},
      {"N", {"N", 1.0, 0.0}},          {"kN", {"kN", 1e-3, 0.0}},        {"kgf", {"kg", 1.0 / 9.80665, 0.0}},
      {"degC", {"\u00B0C", 1.0, 0.0}}, {"degF", {"\u00B0F", 1.8, 32.0}}, {"K", {"K", 1.0, 273.15}},
      {"bar", {"bar", 1e-2, 0.0}},     {"kPa", {"kPa", 1.0, 0.0}},       {"psi", {"psi", 1.0 / 6.894757293168, 0.0}},
      {"mbar", {"mbar", 10.0, 0.0}}};
  if (column == "speed_km_h") return all.at(style.speed_unit);
  if (column == "load_N") return all.at(style.load_unit);
  if (column == "cavity_pressure_kPa") return all.at(style.pressure_unit);
  if (column == "drum_torque_Nm") return {"Nm", 1.0, 0.0};
  return all.at(style.temperature_unit);
}

std::string make_heading(const std::string& name, const std::string& unit, const LoggerStyle& style) {
  switch (style.units) {
    case LoggerStyle::Units::kBrackets:
      return fmt::format("{} [{}]", name, unit);
    case LoggerStyle::Units::kParentheses:
      return fmt::format("{} ({})", name, unit);
    case LoggerStyle::Units::kSlash:
      return fmt::format("{} / {}", name, unit);
    case LoggerStyle::Units::kUnderscore:
      return fmt::format("{}_{}", name, unit);
    case LoggerStyle::Units::kRow:
    case LoggerStyle::Units::kNone:
      return name;
  }
  return name;
}

std::string show(double value, int decimals, const LoggerStyle& style) {
  if (std::isnan(value)) return style.gap_word;
  std::string text = fmt::format("{:.{}f}", value, decimals);
  for (char& c : text) c = c == '.' ? style.decimal : c;
  return text;
}

/// Day and time of day of an instant.
struct Instant {
  int year, month, day;
  double second_of_day;
};

Instant split_instant(double time_s) {
  const double days = std::floor(time_s / kDay_s);
  const int day_of_march = 4 + static_cast<int>(days - 19786.0);
  return {2024, 3, day_of_march, time_s - days * kDay_s};
}

std::string show_clock(double second_of_day, char decimal) {
  const auto ms = static_cast<long>(std::lround(1e3 * second_of_day));
  return fmt::format("{:02}:{:02}:{:02}{}{:03}", ms / 3600000, ms / 60000 % 60, ms / 1000 % 60, decimal, ms % 1000);
}

/// The cells of time of a row.
std::vector<std::string> show_time(double start_s, double time_s, const LoggerStyle& style) {
  const Instant at = split_instant(start_s + time_s);
  switch (style.time) {
    case LoggerStyle::Time::kSeconds:
      return {show(time_s, 1, style)};
    case LoggerStyle::Time::kMilliseconds:
      return {show(1e3 * time_s, 0, style)};
    case LoggerStyle::Time::kMinutes:
      return {show(time_s / 60.0, 5, style)};
    case LoggerStyle::Time::kIso8601:
      return {fmt::format("{}-{:02}-{:02}T{}", at.year, at.month, at.day, show_clock(at.second_of_day, '.'))};
    case LoggerStyle::Time::kClockAndDate:
      return {fmt::format("{:02}.{:02}.{}", at.day, at.month, at.year), show_clock(at.second_of_day, style.decimal)};
    case LoggerStyle::Time::kSpreadsheetDays:
      return {show(25569.0 + (start_s + time_s) / kDay_s, 9, style)};
    case LoggerStyle::Time::kEpochSeconds:
      return {show(start_s + time_s, 1, style)};
  }
  return {};
}

std::vector<std::string> make_time_headings(const LoggerStyle& style) {
  const std::string name = style.is_german ? "Zeit" : "Time";
  switch (style.time) {
    case LoggerStyle::Time::kSeconds:
      return {make_heading(name, "s", style)};
    case LoggerStyle::Time::kMilliseconds:
      return {make_heading(name, "ms", style)};
    case LoggerStyle::Time::kMinutes:
      return {make_heading(name, "min", style)};
    case LoggerStyle::Time::kClockAndDate:
      return style.is_german ? std::vector<std::string>{"Datum", "Uhrzeit"} : std::vector<std::string>{"Date", "Time"};
    case LoggerStyle::Time::kIso8601:
    case LoggerStyle::Time::kSpreadsheetDays:
    case LoggerStyle::Time::kEpochSeconds:
      return {style.is_german ? "Zeitstempel" : "Timestamp"};
  }
  return {};
}

std::string join_cells(const std::vector<std::string>& cells, const LoggerStyle& style) {
  return fmt::format("{}\n", fmt::join(cells, std::string(1, style.separator)));
}

std::string make_head(const LoggerStyle& style) {
  std::string text;
  if (style.lines_above > 0) text += style.is_german ? "Pr\u00FCfstand PV16\n" : "Test rig PV16\n";
  if (style.lines_above > 1) text += style.is_german ? "Bearbeiter: N. N.\n" : "Operator: N. N.\n";
  std::vector<std::string> headings = make_time_headings(style);
  std::vector<std::string> units(headings.size());
  if (style.time == LoggerStyle::Time::kSeconds) units[0] = "s";
  if (style.time == LoggerStyle::Time::kMilliseconds) units[0] = "ms";
  if (style.time == LoggerStyle::Time::kMinutes) units[0] = "min";
  for (const auto& [column, words] : names()) {
    const char* name = words[style.is_german ? 1 : 0][static_cast<std::size_t>(style.wording)];
    const std::string unit = find_conversion(column, style).unit;
    headings.push_back(make_heading(name, unit, style));
    units.push_back(unit);
  }
  if (style.counts_rows) {
    headings.push_back(style.is_german ? "Messwert Nr." : "Sample no.");
    units.emplace_back();
  }
  text += join_cells(headings, style);
  if (style.units == LoggerStyle::Units::kRow) text += join_cells(units, style);
  return text;
}

}  // namespace

LoggerStyle make_logger_style(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto pick = [&random](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  const auto pick_text = [&pick](const std::vector<std::string>& words) { return words[pick(words.size())]; };
  LoggerStyle style;
  style.is_german = pick(2) == 1;
  style.separator = std::string(";\t,")[pick(3)];
  style.decimal = style.separator != ',' && pick(3) > 0 ? ',' : '.';
  style.time = static_cast<LoggerStyle::Time>(pick(7));
  style.units = static_cast<LoggerStyle::Units>(pick(6));
  style.wording = static_cast<int>(pick(3));
  style.speed_unit = pick_text({"km/h", "km/h", "m/s", "mph"});
  style.load_unit = pick_text({"N", "kN", "kgf"});
  style.temperature_unit = pick_text({"degC", "degC", "degC", "degF", "K"});
  style.pressure_unit = pick_text({"bar", "kPa", "psi", "mbar"});
  style.lines_above = static_cast<int>(pick(3));
  style.gap_word = pick_text({"", "", "NaN", "---", "ERR"});
  style.counts_rows = pick(2) == 1;
  style.every = 5;
  return style;
}

std::string describe(const LoggerStyle& style) {
  return fmt::format(
      "german {}, separator '{}', decimal '{}', time {}, units {}, wording {}, {} {} {} {}, above {}, '{}'",
      style.is_german, style.separator, style.decimal, static_cast<int>(style.time), static_cast<int>(style.units),
      style.wording, style.speed_unit, style.load_unit, style.temperature_unit, style.pressure_unit, style.lines_above,
      style.gap_word);
}

bool is_dated(const LoggerStyle& style) {
  return style.time != LoggerStyle::Time::kSeconds && style.time != LoggerStyle::Time::kMilliseconds &&
         style.time != LoggerStyle::Time::kMinutes;
}

void write_foreign_logs(const measurements::MeasurementSet& set, const LoggerStyle& style, const std::string& folder) {
  double start_s = kFirstMorning_s;
  for (const measurements::MeasuredRun& run : set.runs) {
    if (&run != &set.runs.front()) {  // start_s is the end of the run before
      start_s = run.rest_before_s.has_value() ? start_s + *run.rest_before_s
                                              : (std::floor(start_s / kDay_s) + 1.0) * kDay_s + 8.0 * 3600.0;
    }
    std::string text = make_head(style);
    for (std::size_t row = 0; row < run.time_s.size(); row += static_cast<std::size_t>(style.every)) {
      std::vector<std::string> cells = show_time(start_s, run.time_s[row], style);
      for (const auto& [column, words] : names()) {
        const Conversion to = find_conversion(column, style);
        const double value = unit_of_key(column).from_si(run.columns.at(column)[row]);
        cells.push_back(show(to.factor * value + to.offset, 4, style));
      }
      if (style.counts_rows) cells.push_back(std::to_string(row + 1));
      text += join_cells(cells, style);
    }
    start_s += run.time_s.back();
    write_file(folder + "/" + run.id + ".csv", text);
  }
}

}  // namespace rollrig::tests
