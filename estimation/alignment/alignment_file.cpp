#include "estimation/alignment/alignment_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/date_time/gregorian/gregorian_types.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "estimation/alignment/line_fit.h"
#include "measurements/logs/time_stamps.h"
#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::estimation {

namespace {

/// One class a tire, and classes that are aligned together.
AlignmentRules find_rules(const CsvTable& table, const std::vector<AlignmentRow>& rows) {
  std::map<std::string, std::string> by_tire;
  for (const AlignmentRow& row : rows) {
    const auto& [tire, before] = *by_tire.emplace(row.tire, row.tire_class).first;
    if (before != row.tire_class) {
      throw table.cell_error(row.row, "class", fmt::format("tire '{}' has two classes", tire),
                             fmt::format("{}, as in an earlier row", before));
    }
    if ((row.tire_class == "C3") != (rows.front().tire_class == "C3")) {
      throw table.cell_error(row.row, "class", "classes are mixed that are not aligned together",
                             fmt::format("{}; C1 and C2 are aligned together, C3 in a file of its own",
                                         rows.front().tire_class == "C3" ? "C3" : "C1 or C2"));
    }
  }
  return rows.front().tire_class == "C3" ? kRulesC3 : kRulesC1C2;
}

/// Which machine of the file is the candidate and which the reference; empty where there is none.
void choose_machines(const CsvTable& table, const std::vector<AlignmentRow>& rows, const AlignmentInput& input,
                     AlignmentFile& file) {
  std::set<std::string> all;
  for (const AlignmentRow& row : rows) {
    if (!row.machine.empty()) all.insert(row.machine);
  }
  const std::vector<std::string> names(all.begin(), all.end());
  for (const auto& [option, name] :
       {std::pair("--machine", input.machine), std::pair("--reference-machine", input.reference_machine)}) {
    if (name.empty() || all.count(name) > 0) continue;
    InputProblem problem = unknown_name("machine", name, names);
    problem.file = table.path();
    problem.key = option;
    throw InputError(problem);
  }
  file.machine = input.machine;
  file.reference_machine = input.reference_machine;
  if (!file.machine.empty() && file.machine == file.reference_machine) {
    throw InputError({"a machine is not aligned to itself", "command line", 0, "--reference-machine", file.machine,
                      "another machine of the file", ""});
  }
  std::vector<std::string> others;
  for (const std::string& name : names) {
    if (name != file.reference_machine) others.push_back(name);
  }
  if (!file.machine.empty() || others.empty()) return;
  if (others.size() > 1) {
    throw InputError({"the file has several machines", table.path(), 0, "machine", boost::algorithm::join(names, ", "),
                      "--machine <name> of the candidate, and --reference-machine <name> where the reference is among "
                      "them",
                      ""});
  }
  file.machine = others.front();
}

void add_measurement(TireMeasurements& tire, const AlignmentMeasurement& measurement) {
  const auto later = [](double time_s, const AlignmentMeasurement& other) { return time_s < other.time_s; };
  tire.all.insert(std::upper_bound(tire.all.begin(), tire.all.end(), measurement.time_s, later), measurement);
}

template <class Tires>
auto& find_or_add(Tires& tires, const std::string& name) {
  const auto found = std::find_if(tires.begin(), tires.end(), [&name](const auto& tire) { return tire.name == name; });
  if (found != tires.end()) return *found;
  tires.emplace_back();
  tires.back().name = name;
  return tires.back();
}

void sort_controls(std::vector<ControlTire>& controls) {
  for (ControlTire& control : controls) {
    std::stable_sort(control.measurements.begin(), control.measurements.end(),
                     [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  }
}

void sort_rows(const std::vector<AlignmentRow>& rows, AlignmentFile& file) {
  for (const AlignmentRow& row : rows) {
    const bool is_candidate = row.machine == file.machine;
    if (!is_candidate && row.machine != file.reference_machine) continue;
    if (row.is_control) {
      std::vector<ControlTire>& controls = is_candidate ? file.controls : file.reference_controls;
      find_or_add(controls, row.tire).measurements.push_back(row.measurement);
      continue;
    }
    AlignmentTire& tire = find_or_add(file.tires, row.tire);
    tire.tire_class = row.tire_class;
    add_measurement(is_candidate ? tire.candidate : tire.reference, row.measurement);
  }
  sort_controls(file.controls);
  sort_controls(file.reference_controls);
}

/// The rows of other machines. A machine that measured alignment tires often enough for an alignment is one of its own;
/// another one may be a name that is written in two ways.
void find_unused_rows(const CsvTable& table, const std::vector<AlignmentRow>& rows, AlignmentFile& file) {
  std::map<std::string, UnusedRows> by_machine;
  std::map<std::string, std::map<std::string, std::size_t>> counts;
  for (const AlignmentRow& row : rows) {
    if (row.machine == file.machine || row.machine == file.reference_machine) continue;
    UnusedRows& unused = by_machine[row.machine];
    unused.machine = row.machine;
    unused.lines.push_back(table.line_of(row.row));
    unused.controls += row.is_control ? 1 : 0;
    if (!row.is_control) ++counts[row.machine][row.tire];
  }
  for (const auto& [machine, unused] : by_machine) {
    const std::map<std::string, std::size_t>& tires = counts[machine];
    const bool is_machine =
        !tires.empty() && std::all_of(tires.begin(), tires.end(), [&file](const auto& tire) {
          return tire.second + 1 >= file.rules.measurements;
        });
    if (!is_machine) file.unused.push_back(unused);
  }
}

/// Leaves out the first measurement of each tire, and asks for two that are left.
void drop_first_measurement(const AlignmentFile& file, const std::string& tire, const std::string& machine,
                            bool first_excluded, TireMeasurements& measured) {
  if (!first_excluded && !measured.all.empty()) measured.all.front().is_used = false;
  const std::size_t used = measured.used().size();
  if (used >= 2) return;
  std::string not_used;
  for (const UnusedRows& unused : file.unused) {
    not_used += fmt::format("; {} of machine '{}' {} not used", format_count(unused.lines.size(), "row"), unused.machine,
                            unused.lines.size() == 1 ? "is" : "are");
  }
  throw InputError({fmt::format("tire '{}' has too few measurements{}{}", tire,
                                machine.empty() ? "" : fmt::format(" on machine '{}'", machine), not_used),
                    file.path, 0, "tire", format_count(measured.all.size(), "measurement"),
                    fmt::format("{} of each tire, the first of which is not used; at the least {}, for a mean and its "
                                "scatter{}",
                                file.rules.measurements, first_excluded ? 2 : 3,
                                first_excluded ? "" : " (--first-excluded if the file already omits the first ones)"),
                    ""});
}

struct ReferenceValues {
  std::map<std::string, double> by_tire;
  bool is_assigned = false;
};

/// Values in a column of the file: one for each tire.
ReferenceValues find_column_values(const CsvTable& table, const std::vector<AlignmentRow>& rows) {
  ReferenceValues values;
  const std::string column = find_reference_column(table);
  values.is_assigned = column == kAssignedColumn;
  for (const AlignmentRow& row : rows) {
    if (!row.reference_N_per_kN.has_value() || row.is_control) continue;
    const auto [before, is_new] = values.by_tire.emplace(row.tire, *row.reference_N_per_kN);
    if (is_new || before->second == *row.reference_N_per_kN) continue;
    throw table.cell_error(row.row, column, fmt::format("tire '{}' has two values to be aligned to", row.tire),
                           fmt::format("{:g}, as in an earlier row", before->second));
  }
  return values;
}

ReferenceValues read_reference_file(const std::string& path, const std::vector<AlignmentTire>& tires) {
  const CsvTable table = CsvTable::read(path);
  table.require_known({"tire", kReferenceColumn, kAssignedColumn});
  ReferenceValues values;
  const std::string found = find_reference_column(table);
  const std::string column = found.empty() ? kReferenceColumn : found;
  values.is_assigned = column == kAssignedColumn;
  std::vector<std::string> known;
  for (const AlignmentTire& tire : tires) known.push_back(tire.name);
  const std::vector<std::string> names = table.text("tire"), cells = table.text(column);
  for (std::size_t row = 0; row < names.size(); ++row) {
    const std::string name = boost::algorithm::trim_copy(names[row]);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      InputError error = table.cell_error(row, "tire", fmt::format("tire '{}' was not measured", name),
                                          boost::algorithm::join(known, ", "));
      InputProblem problem = error.problem();
      problem.nearest = nearest_name(name, known);
      throw InputError(problem);
    }
    if (!values.by_tire.emplace(name, read_rrc(table, row, column, boost::algorithm::trim_copy(cells[row]))).second) {
      throw table.cell_error(row, "tire", fmt::format("tire '{}' is there twice", name), "a row for each tire");
    }
  }
  return values;
}

/// Tires that only one of the two sides has.
void require_both_sides(const AlignmentFile& file, const std::string& where) {
  std::vector<std::string> of_reference_alone;
  for (const AlignmentTire& tire : file.tires) {
    if (tire.candidate.all.empty()) of_reference_alone.push_back(tire.name);
  }
  for (const AlignmentTire& tire : file.tires) {
    if (tire.candidate.all.empty()) {
      throw InputError({fmt::format("tire '{}' was not measured on the candidate machine", tire.name), file.path, 0,
                        "tire", "", "measurements of each alignment tire on both machines", ""});
    }
    if (!(tire.reference_N_per_kN > 0.0)) {
      throw InputError({fmt::format("tire '{}' has no value to be aligned to", tire.name), where, 0, "tire", "",
                        fmt::format("one for each alignment tire: measurements of --reference-machine, a column {} or "
                                    "{}, or a file of --reference-values; a control tire has 'control' in column use",
                                    kReferenceColumn, kAssignedColumn),
                        nearest_name(tire.name, of_reference_alone)});
    }
  }
}

void set_reference_values(const CsvTable& table, const std::vector<AlignmentRow>& rows, const AlignmentInput& input,
                          AlignmentFile& file) {
  const bool has_column = !find_reference_column(table).empty();
  const int sources =
      (has_column ? 1 : 0) + (input.reference_values.empty() ? 0 : 1) + (file.reference_machine.empty() ? 0 : 1);
  if (sources > 1) {
    throw InputError({"the values to be aligned to are given more than once", "command line", 0,
                      input.reference_values.empty() ? "--reference-machine" : "--reference-values", "",
                      fmt::format("one of: --reference-machine, --reference-values, a column {} or {}",
                                  kReferenceColumn, kAssignedColumn),
                      ""});
  }
  ReferenceValues values;
  if (has_column) values = find_column_values(table, rows);
  if (!input.reference_values.empty()) {
    values = read_reference_file(input.reference_values, file.tires);
    file.inputs.push_back(input.reference_values);
  }
  file.is_assigned = values.is_assigned;
  for (AlignmentTire& tire : file.tires) {
    if (!tire.reference.all.empty()) {
      drop_first_measurement(file, tire.name, file.reference_machine, input.first_excluded, tire.reference);
      tire.reference_N_per_kN = tire.reference.mean();
    } else if (const auto found = values.by_tire.find(tire.name); found != values.by_tire.end()) {
      tire.reference_N_per_kN = found->second;
    }
  }
  require_both_sides(file, input.reference_values.empty() ? file.path : input.reference_values);
}

void set_times(AlignmentFile& file) {
  file.first_s = file.tires.front().candidate.all.front().time_s;
  for (const AlignmentTire& tire : file.tires) {
    file.first_s = std::min(file.first_s, tire.candidate.all.front().time_s);
    file.last_s = std::max(file.last_s, tire.candidate.all.back().time_s);
  }
  file.newest_s = file.complete_s = file.last_s;
  for (const AlignmentTire& tire : file.tires) {
    if (!tire.reference.all.empty()) file.complete_s = std::max(file.complete_s, tire.reference.all.back().time_s);
  }
  for (const ControlTire& control : file.controls) {
    file.newest_s = std::max(file.newest_s, control.measurements.back().time_s);
  }
}

std::vector<double> list_side_values(const AlignmentFile& file, TireMeasurements AlignmentTire::*side) {
  std::vector<double> values;
  for (const AlignmentTire& tire : file.tires) {
    for (const AlignmentMeasurement& one : (tire.*side).all) values.push_back(one.rrc_N_per_kN);
  }
  return values;
}

boost::gregorian::date to_date(double time_s) {
  const auto days = static_cast<long>(std::floor(time_s / measurements::kDay_s));
  return boost::gregorian::date(1970, 1, 1) + boost::gregorian::days(days);
}

}  // namespace

std::vector<double> TireMeasurements::used() const {
  std::vector<double> values;
  for (const AlignmentMeasurement& one : all) {
    if (one.is_used) values.push_back(one.rrc_N_per_kN);
  }
  return values;
}

double TireMeasurements::mean() const {
  const std::vector<double> values = used();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> list_candidate_values(const AlignmentFile& file) {
  return list_side_values(file, &AlignmentTire::candidate);
}

double find_candidate_step(const AlignmentFile& file) { return find_value_step(list_candidate_values(file)); }

double find_reference_step(const AlignmentFile& file) {
  std::vector<double> values = list_side_values(file, &AlignmentTire::reference);
  if (values.empty()) {
    for (const AlignmentTire& tire : file.tires) values.push_back(tire.reference_N_per_kN);
  }
  return find_value_step(values);
}

std::string format_day(double time_s) {
  const boost::gregorian::date::ymd_type day = to_date(time_s).year_month_day();
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year), static_cast<int>(day.month.as_number()),
                     static_cast<int>(day.day));
}

double add_years(double time_s, int years) {
  const boost::gregorian::date day = to_date(time_s);
  const int year = static_cast<int>(day.year()) + years;
  const int last =
      boost::gregorian::gregorian_calendar::end_of_month_day(static_cast<unsigned short>(year), day.month());
  const boost::gregorian::date later(static_cast<unsigned short>(year), day.month(),
                                     static_cast<unsigned short>(std::min<int>(day.day(), last)));
  return static_cast<double>((later - boost::gregorian::date(1970, 1, 1)).days()) * measurements::kDay_s;
}

AlignmentFile read_alignment_file(const AlignmentInput& input) {
  const CsvTable table = CsvTable::read(input.file);
  const std::vector<AlignmentRow> rows = read_alignment_rows(table);
  AlignmentFile file;
  file.path = input.file;
  file.inputs = {input.file};
  file.rules = find_rules(table, rows);
  choose_machines(table, rows, input, file);
  sort_rows(rows, file);
  find_unused_rows(table, rows, file);
  if (file.tires.empty()) {
    throw InputError({"the file has no measurement of an alignment tire", file.path, 0, "use", "",
                      fmt::format("measurements of at least {} alignment tires", file.rules.least_tires), ""});
  }
  set_reference_values(table, rows, input, file);
  for (AlignmentTire& tire : file.tires)
    drop_first_measurement(file, tire.name, file.machine, input.first_excluded, tire.candidate);
  std::sort(file.tires.begin(), file.tires.end(),
            [](const auto& a, const auto& b) { return a.candidate.mean() < b.candidate.mean(); });
  set_times(file);
  return file;
}

}  // namespace rollrig::estimation
