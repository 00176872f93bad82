#include "measurements/logs/guess.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>

#include "sim/core/assets.h"
#include "sim/core/error.h"
#include "sim/core/interrupt.h"

namespace fs = std::filesystem;

namespace rollrig::measurements {
namespace {

/// Numbers in names count as numbers, so that run 10 follows run 9.
bool is_before(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::size_t end_i = std::min(a.find_first_not_of("0123456789", i), a.size());
      const std::size_t end_j = std::min(b.find_first_not_of("0123456789", j), b.size());
      const std::string x = a.substr(i, end_i - i), y = b.substr(j, end_j - j);
      const std::string plain_x = x.substr(std::min(x.find_first_not_of('0'), x.size()));
      const std::string plain_y = y.substr(std::min(y.find_first_not_of('0'), y.size()));
      if (plain_x != plain_y) {
        return plain_x.size() != plain_y.size() ? plain_x.size() < plain_y.size() : plain_x < plain_y;
      }
      i = end_i;
      j = end_j;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  return a < b;
}

/// Tables of text in a folder: the .csv files, or where there are none those with another ending of such files.
std::vector<std::string> list_log_files(const std::string& folder) {
  if (!fs::exists(folder)) {
    throw InputError(
        {fmt::format("no such file or folder '{}'", folder), folder, 0, "", "", "a log or a folder of logs", ""});
  }
  if (!fs::is_directory(folder)) return {folder};
  std::vector<std::string> files, others;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string ending = boost::algorithm::to_lower_copy(entry.path().extension().string());
    if (!entry.is_regular_file()) continue;
    if (ending == ".csv") files.push_back(entry.path().string());
    if (ending == ".txt" || ending == ".tsv" || ending == ".asc" || ending == ".dat") {
      others.push_back(entry.path().string());
    }
  }
  if (files.empty()) files = others;
  std::sort(files.begin(), files.end(), &is_before);
  if (files.empty()) {
    throw InputError(
        {"there are no logs in the folder", folder, 0, "", "", "files .csv, else .txt, .tsv, .asc or .dat", ""});
  }
  return files;
}

/// The form of all files, which have one. Words in the place of numbers are those of all.
GuessedForm guess_common_form(const std::vector<std::string>& files) {
  GuessedForm common = guess_form(files.front());
  for (std::size_t i = 1; i < files.size(); ++i) {
    GuessedForm form = guess_form(files[i]);
    if (!form.has_decimals) form.csv.decimal = common.csv.decimal;  // whole numbers alone
    if (!common.has_decimals) common.csv.decimal = form.csv.decimal;
    common.has_decimals = common.has_decimals || form.has_decimals;
    if (!(form == common)) {
      throw InputError({fmt::format("the logs are of different forms: this one and {}", files.front()), files[i],
                        form.csv.header_line, "", fmt::format("{}", fmt::join(form.headings, ", ")),
                        fmt::format("the same headings, units and signs in all logs of a folder, as {}; else a mapping "
                                    "(docs/import.md)",
                                    fmt::join(common.headings, ", ")),
                        ""});
    }
    for (const std::string& word : form.missing) {
      if (std::find(common.missing.begin(), common.missing.end(), word) == common.missing.end()) {
        common.missing.push_back(word);
      }
    }
  }
  return common;
}

InputError need_option(const std::string& what, const std::string& option, const std::string& allowed) {
  return InputError({what, "command line", 0, option, "", allowed, ""});
}

models::TireFile read_tire_of(const GuessOptions& options) {
  if (options.tire.empty()) {
    throw need_option("the logs do not tell the tire", "--tire",
                      "--tire <name or path>; see rollrig list tires; rollrig new tire makes one");
  }
  return models::read_tire(read_config(find_asset("tires", options.tire)));
}

void read_machine_of(const GuessOptions& options, GuessSource& source) {
  if (!options.vehicle.empty()) {
    source.kind = &rigs::find_kind_without_rig(&models::is_any);
    return;
  }
  if (options.rig.empty()) {
    throw need_option("the logs do not tell the rig", "--rig",
                      "--rig <name or path>, or --vehicle of a set of the road; see rollrig list rigs; rollrig new rig "
                      "makes one");
  }
  const rigs::RigFile rig = rigs::read_rig(read_config(find_asset("rigs", options.rig)));
  if (!rig.kind->names_rig()) {
    throw need_option(fmt::format("rig '{}' is a road, where a set names a vehicle", rig.name), "--vehicle",
                      "--vehicle <name or path>");
  }
  source.kind = rig.kind;
  source.drum_diameter_m = rig.is_curved() ? rig.drum.diameter_m : 0.0;
}

/// Refuses a column that sets of this kind do not have.
template <class Map>
void require_known_columns(const GuessSource& source, const Map& given, const char* option, bool may_be_time) {
  std::vector<std::string> known;
  for (const rigs::Column& column : source.kind->columns.all()) known.push_back(column.quantity.header());
  if (may_be_time) known.emplace_back("time");
  for (const auto& [header, value] : given) {
    if (std::find(known.begin(), known.end(), header) != known.end()) continue;
    InputProblem problem = unknown_name("column of a set", header, known);
    problem.file = "command line";
    problem.key = option;
    throw InputError(problem);
  }
}

void require_date_order(const std::string& order) {
  const std::vector<std::string> known{"ymd", "dmy", "mdy"};
  if (order.empty() || std::find(known.begin(), known.end(), order) != known.end()) return;
  InputProblem problem = unknown_name("order of a date", order, known);
  problem.file = "command line";
  problem.key = "--date-order";
  throw InputError(problem);
}

/// The median of the times between rows.
double find_interval_s(const Guess& guess) {
  std::vector<double> steps_s;
  for (const GuessedLog& log : guess.source.logs) {
    const std::vector<double> times_s = read_guessed_times(guess.source, guess.time, log);
    for (std::size_t row = 1; row < times_s.size(); ++row) steps_s.push_back(times_s[row] - times_s[row - 1]);
  }
  if (steps_s.empty()) return 0.0;
  std::sort(steps_s.begin(), steps_s.end());
  return steps_s[steps_s.size() / 2];
}

}  // namespace

std::vector<double> GuessSource::numbers_of(const std::string& heading) const {
  std::vector<double> numbers;
  for (const GuessedLog& log : logs) {
    for (const std::string& cell : log.cells_of(heading)) {
      numbers.push_back(parse_log_number(cell, form.csv.decimal).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
  }
  return numbers;
}

const HeadingParts& GuessSource::parts_of(const std::string& heading) const {
  const auto at = std::find(form.headings.begin(), form.headings.end(), heading);
  return headings.at(static_cast<std::size_t>(at - form.headings.begin()));
}

InputError GuessSource::problem(const std::string& what, const std::string& option, const std::string& value,
                                const std::string& allowed) const {
  return InputError({what, logs.front().path, form.csv.header_line, option, value, allowed, ""});
}

Guess guess_logs(const GuessOptions& options) { return guess_logs(options, read_tire_of(options)); }

Guess guess_logs(const GuessOptions& options, const models::TireFile& tire) {
  require_date_order(options.date_order);
  Guess guess{{options, {}, {}, {}, nullptr, tire, 0.0}, {}, {}, {}, {}, 0.0};
  GuessSource& source = guess.source;
  const std::vector<std::string> files = list_log_files(options.folder);
  read_machine_of(options, source);
  require_known_columns(source, options.columns, "--column", true);
  require_known_columns(source, options.units, "--unit", true);
  require_known_columns(source, options.values, "--value", false);
  source.form = guess_common_form(files);
  for (std::size_t i = 0; i < source.form.headings.size(); ++i) {
    source.headings.push_back(
        split_heading(source.form.headings[i], i < source.form.units.size() ? source.form.units[i] : ""));
  }
  for (const std::string& file : files) {
    throw_if_interrupted();
    source.logs.push_back({file, read_guessed_table(file, source.form), {}});
    for (const std::string& heading : source.logs.back().table.columns()) {
      source.logs.back().cells[heading] = source.logs.back().table.text(heading);
    }
  }
  source.form.headings = source.logs.front().table.columns();  // with the blanks that the reader of logs keeps
  guess.time = guess_time(source);
  guess.columns = guess_columns(source, guess.time);
  guess.runs = guess_runs(source, guess.time, guess.columns);
  guess.interval_s = find_interval_s(guess);
  for (const std::string& heading : source.form.headings) {
    const bool is_read = heading == guess.time.heading || heading == guess.time.date_heading ||
                         std::any_of(guess.columns.begin(), guess.columns.end(),
                                     [&heading](const auto& column) { return column.heading == heading; });
    if (!is_read) guess.unread.push_back(heading);
  }
  return guess;
}

}  // namespace rollrig::measurements
