#include "estimation/alignment/alignment_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "estimation/alignment/alignment_rules.h"
#include "estimation/run_checks/robust_statistics.h"
#include "measurements/logs/time_stamps.h"
#include "sim/core/error.h"
#include "sim/core/limits.h"
#include "sim/core/text.h"

namespace rollrig::estimation {

namespace {

constexpr double kMostRatio = 1.5;  // Assumed: of a value over the median of its tire; repeats differ by 1 %
constexpr const char* kDateForm = "a day such as 2026-03-02, or with a time, 2026-03-02T14:30";

std::string trimmed(const std::string& text) { return boost::algorithm::trim_copy(text); }

/// The cells of a column, trimmed; empty ones where the column is absent.
std::vector<std::string> read_words(const CsvTable& table, const std::string& column) {
  if (!table.has(column)) return std::vector<std::string>(table.row_count());
  std::vector<std::string> words = table.text(column);
  for (std::string& word : words) boost::algorithm::trim(word);
  return words;
}

bool has_clock(const std::string& date) { return date.find(':') != std::string::npos; }

/// Day and month are in one order only, since 03/04/2026 may be two days. Throws std::invalid_argument.
double parse_time_s(const std::string& text) {
  if (text.size() < 5 || text[4] != '-' || text.find_first_not_of("0123456789") != 4 || text < "1970" ||
      text > "2200") {
    throw std::invalid_argument("not a day of these times");
  }
  if (has_clock(text)) return measurements::parse_date_time_s(text, "ymd");
  return measurements::parse_date_days(text, "ymd") * measurements::kDay_s;
}

double read_time_s(const CsvTable& table, std::size_t row, const std::string& text) {
  try {
    return parse_time_s(text);
  } catch (const std::invalid_argument&) {
    throw table.cell_error(row, "date", fmt::format("'{}' is no date", text), kDateForm);
  }
}

std::string find_value_column(const CsvTable& table) {
  if (table.has(kRrcColumn) != table.has(kRrcPerTonneColumn))
    return table.has(kRrcColumn) ? kRrcColumn : kRrcPerTonneColumn;
  if (!table.has(kRrcColumn)) table.text(kRrcColumn);  // throws: the column is missing
  throw InputError({"the measured value is there twice", table.path(), 1, kRrcPerTonneColumn, "",
                    fmt::format("one of the columns {} and {}", kRrcColumn, kRrcPerTonneColumn), ""});
}

void check_class(const CsvTable& table, const AlignmentRow& row) {
  if (std::find(kTireClasses.begin(), kTireClasses.end(), row.tire_class) != kTireClasses.end()) return;
  throw table.cell_error(
      row.row, "class",
      row.tire_class.empty() ? "a measurement has no tire class" : fmt::format("'{}' is no tire class", row.tire_class),
      "C1 (cars), C2 (vans) or C3 (trucks and buses)");
}

bool read_use(const CsvTable& table, std::size_t row, const std::string& text) {
  if (text.empty() || text == "alignment") return false;
  if (text == "control") return true;
  throw table.cell_error(row, "use", fmt::format("'{}' is no use of a measurement", text),
                         "alignment, control, or an empty field for alignment");
}

/// One measurement at a time: the same row copied, or the day without the time of day.
void require_own_times(const CsvTable& table, const std::vector<AlignmentRow>& rows) {
  std::map<std::tuple<std::string, std::string, double>, std::size_t> seen;
  for (const AlignmentRow& row : rows) {
    const auto [before, is_new] = seen.emplace(std::tuple(row.machine, row.tire, row.measurement.time_s), row.row);
    if (is_new) continue;
    const bool is_copy = rows[before->second].measurement.rrc_N_per_kN == row.measurement.rrc_N_per_kN;
    throw table.cell_error(row.row, "date",
                           fmt::format("tire '{}' was measured twice at one time{}", row.tire,
                                       is_copy ? fmt::format(", with one value: is the row of line {} copied?",
                                                             table.line_of(before->second))
                                               : ""),
                           "a row for each measurement, from the mounting of the tire on; with a time of day, as "
                           "2026-03-02T14:30, where a "
                           "day has two of one tire");
  }
}

/// A value that is far from the others of its tire on its machine: a unit, or a digit.
void require_like_values(const CsvTable& table, const std::vector<AlignmentRow>& rows) {
  std::map<std::string, std::vector<double>> by_tire;
  for (const AlignmentRow& row : rows) by_tire[row.tire].push_back(row.measurement.rrc_N_per_kN);
  for (const AlignmentRow& row : rows) {
    const double median = calc_median(by_tire[row.tire]);
    const double value = row.measurement.rrc_N_per_kN;
    if (is_at_most(std::max(value / median, median / value), kMostRatio)) continue;
    throw table.cell_error(row.row, find_value_column(table),
                           fmt::format("this value is far from the others of tire '{}'", row.tire),
                           fmt::format("within a factor of {:g} of their median, {:.4g} N/kN", kMostRatio, median));
  }
}

}  // namespace

double read_rrc(const CsvTable& table, std::size_t row, const std::string& column, const std::string& text) {
  const std::optional<double> value = parse_number(text);
  const std::string allowed =
      fmt::format("a coefficient in N/kN (as kg/t) of {:g} to {:g}", kLeastRrc_N_per_kN, kMostRrc_N_per_kN);
  if (!value.has_value()) {
    throw table.cell_error(row, column, text.empty() ? "a measurement has no value" : "this is no number", allowed);
  }
  if (*value >= kLeastRrc_N_per_kN && *value <= kMostRrc_N_per_kN) return *value;
  throw table.cell_error(row, column, "this is no rolling resistance coefficient in N/kN" + guess_unit(*value),
                         allowed);
}

std::string find_reference_column(const CsvTable& table) {
  if (table.has(kReferenceColumn) && table.has(kAssignedColumn)) {
    throw InputError(
        {"the value to which a tire is aligned is there twice", table.path(), 1, kAssignedColumn, "",
         fmt::format("{} (of the reference laboratory) or {} (of the network)", kReferenceColumn, kAssignedColumn),
         ""});
  }
  return table.has(kAssignedColumn) ? kAssignedColumn : table.has(kReferenceColumn) ? kReferenceColumn : "";
}

std::vector<AlignmentRow> read_alignment_rows(const CsvTable& table) {
  table.require_known(
      {"tire", "class", "date", "machine", "use", kRrcColumn, kRrcPerTonneColumn, kReferenceColumn, kAssignedColumn});
  const std::string value_column = find_value_column(table), reference_column = find_reference_column(table);
  const std::vector<std::string> tires = table.text("tire"), classes = table.text("class"), dates = table.text("date"),
                                 values = table.text(value_column), machines = read_words(table, "machine"),
                                 uses = read_words(table, "use"), references = read_words(table, reference_column);
  std::vector<AlignmentRow> rows;
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    AlignmentRow row{i, trimmed(tires[i]), trimmed(classes[i]), machines[i], read_use(table, i, uses[i]), {}, {}};
    if (row.tire.empty()) throw table.cell_error(i, "tire", "a measurement names no tire", "a name");
    if (table.has("machine") && row.machine.empty()) {
      throw table.cell_error(i, "machine", "a measurement names no machine", "a name, or no such column at all");
    }
    check_class(table, row);
    row.measurement.time_s = read_time_s(table, i, trimmed(dates[i]));
    row.measurement.is_day_alone = !has_clock(dates[i]);
    row.measurement.rrc_N_per_kN = read_rrc(table, i, value_column, trimmed(values[i]));
    if (!references[i].empty()) row.reference_N_per_kN = read_rrc(table, i, reference_column, references[i]);
    rows.push_back(row);
  }
  require_own_times(table, rows);
  require_like_values(table, rows);
  return rows;
}

std::string guess_unit(double rrc_N_per_kN) {
  const auto fits = [rrc_N_per_kN](double factor) {
    const double value = factor * rrc_N_per_kN;
    return value >= kLeastRrc_N_per_kN && value <= kMostRrc_N_per_kN;
  };
  if (fits(1e3)) return ": it would be one as a plain ratio; multiply by 1000";
  if (fits(10.0)) return ": it would be one in percent; multiply by 10";
  if (fits(0.1)) return ": is the decimal point missing?";
  if (rrc_N_per_kN > kMostRrc_N_per_kN) return ": a force in N? divide it by the load in kN";
  return "";
}

double read_day_s(const std::string& text, const std::string& option) {
  try {
    return std::floor(parse_time_s(text) / measurements::kDay_s) * measurements::kDay_s;
  } catch (const std::invalid_argument&) {
    throw InputError(
        {fmt::format("'{}' is not a date", text), "command line", 0, option, text, "a day such as 2026-03-02", ""});
  }
}

}  // namespace rollrig::estimation
