#pragma once
/// What results have in common. Every number stands in the unit that its name ends in, as in files ("speed_km_h" in
/// km/h), and that `unit` shows; docs/formats.md has the units.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#pragma GCC visibility push(default)
namespace rollrig {

/// A result of a scenario, as declared there once.
struct ResultValue {
  std::string name;              // key of result.json: "rrc_25degC_2m_N_per_kN"
  std::string label;             // the same in words, without the unit
  std::string unit;              // its symbol, "N/kN"; empty for words and ratios
  std::string doc;               // what it means
  std::optional<double> number;  // none for words, and where there is no value; yes is 1, no is 0
  std::string text;              // of words
};

/// A list of results: one record for each cycle, section or speed.
struct ResultRecords {
  std::string name;  // key of result.json
  std::string doc;
  std::vector<std::vector<ResultValue>> records;
};

/// A limit of the range in which a number is allowed.
enum class RangeLimit { kNone, kLower, kUpper };

/// A fitted number with its interval of 95 %.
struct ParameterEstimate {
  std::string name;  // "<effect>.<key>", or the key of a file
  double value = 0.0;
  double sd = 0.0;
  double low_95 = 0.0;
  double high_95 = 0.0;
  std::string unit;
  RangeLimit on_limit = RangeLimit::kNone;  // of an effect's parameter: the limit on which the estimate is
};

/// A recorded quantity.
struct Channel {
  std::string name;            // heading of its column: "drum_torque_Nm"; of one wheel with its place before the unit
  std::string unit;            // symbol
  std::vector<double> values;  // one a row; NaN where there is no sample
};

/// Files of a folder: name, which may lie in a folder below, and content.
using FolderFiles = std::vector<std::pair<std::string, std::string>>;

/// A result in the forms that the command line writes.
struct Report {
  std::string text;                         // for the terminal: tables as wide as that of standard output
  std::string json;                         // of --json
  std::function<FolderFiles()> make_files;  // of --out; null where there are none
  std::function<std::string()> make_page;   // of --html: a page for any browser, which needs no other file
  /// Of --report: a test report for A4, one file of HTML without a script; null where there is none. Its date is
  /// today's in UTC, or that of the environment variable SOURCE_DATE_EPOCH.
  std::function<std::string()> make_test_report;
};

/// Writes a folder, whole or not at all. Throws InputError where it cannot be written, and where it holds files already
/// unless `force` is set.
void write_folder(const std::string& folder, const FolderFiles& files, bool force = false);

}  // namespace rollrig
#pragma GCC visibility pop
