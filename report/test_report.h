#pragma once
/// A test report on paper: the fields that a standard asks for, results, uncertainty, files, and room for signatures.
///
/// It is a page of HTML without a script, for A4. Each number of a result is taken from the JSON of the same result,
/// and the page says from which place of it (data-json, a JSON pointer).

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig::report {

/// A cell or a value, and the place of its number in the JSON; empty for what is no number of it.
struct ReportCell {
  std::string text;
  std::string place = {};
};

/// A field of a form. One that the program cannot know is a blank line, which says that it is to be filled in by hand.
struct ReportField {
  std::string label;
  std::vector<ReportCell> values;  // with " / " between them; none: to be filled in by hand
  std::string note = {};
};

/// Fields below each other.
struct ReportForm {
  std::vector<ReportField> fields;
};

/// A table; columns of numbers stand to the right.
struct ReportTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<ReportCell>> rows;
  std::size_t totals = 0;  // so many of the last rows are set off from the others
};

/// A paragraph.
struct ReportText {
  std::string text;
};

struct ReportSection {
  std::string title;
  std::vector<std::variant<ReportForm, ReportTable, ReportText>> parts;
};

/// A file that went into the result.
struct ReportFile {
  std::string role;  // "tire"
  std::string path;
  std::string sha256;
};

struct TestReport {
  std::string title;     // "Test report: rolling resistance of a tire"
  std::string standard;  // what the fields follow, with clauses
  std::string subject;   // a line: the tire, the vehicle
  bool is_simulated = true;
  std::vector<std::string> warnings;
  std::vector<ReportSection> sections;
  std::vector<ReportFile> files;
  std::vector<ReportField> origin;  // settings that make the result again: seed, fidelity
};

/// Values of a report from the JSON of the result.
class ReportValues {
 public:
  /// `json` must outlive this.
  explicit ReportValues(const Json& json) : json_(json) {}

  /// Whether there is a value at a JSON pointer such as "/result/rrc_N_per_kN".
  bool has(const std::string& place) const;
  /// The number there in digits as fmt writes them (".3f"), with the unit of its key; a text as it is. Empty where
  /// there is none.
  ReportCell value(const std::string& place, const char* digits = ".6g") const;
  /// The same without the unit.
  ReportCell number(const std::string& place, const char* digits = ".6g") const;
  /// A field of one value. Without a value there the field is a dash, and not to be filled in.
  ReportField field(const std::string& label, const std::string& place, const char* digits = ".6g") const;
  const Json& json() const { return json_; }

 private:
  const Json* find(const std::string& place) const;

  const Json& json_;
};

/// A field with a text.
ReportField make_field(const std::string& label, const std::string& text);
/// A field to be filled in by hand.
ReportField make_blank(const std::string& label);
/// A table of texts.
ReportTable make_report_table(const Table& table);
/// The entries of a list in the JSON, a row each; `columns` are keys with their headings.
ReportTable make_json_table(const ReportValues& values, const std::string& title, const std::string& place,
                            const std::vector<std::pair<const char*, const char*>>& columns, const char* digits);

/// Sections of budgets and Monte Carlo, as make_uncertainty_json() of estimation/uncertainty writes them at
/// "/uncertainty". None where the JSON has none.
std::vector<ReportSection> make_uncertainty_sections(const ReportValues& values);

/// The page. `date` is that of the report, "2026-11-28".
/// Checked  tests/report/test_report_test.cpp, tests/report/check_report.mjs
std::string make_report_html(const TestReport& report, const std::string& date);

/// Today in UTC; by the environment variable SOURCE_DATE_EPOCH where it is set, so that a report can be made again to
/// the bit. Throws InputError where that is not a number of seconds.
std::string find_report_date();

/// Text as it may stand in HTML, in an element or an attribute: no markup comes of it, and control characters and
/// changes of direction are shown.
std::string escape_html(const std::string& text);

}  // namespace rollrig::report
