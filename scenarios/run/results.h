#pragma once
/// Results of a scenario: declared once by a visit(), and from that in JSON, on the terminal, on the page, in the
/// reference and in the columns of a sweep.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/columns.h"
#include "sim/core/json.h"
#include "sim/core/units.h"

namespace rollrig::scenarios {

/// A line of the table that a person reads after a run.
struct ResultLine {
  std::string label;
  std::string value;
  std::string key = {};  // of the result that it shows, where it is a single one
};

/// A quantity of `result`, for the reference page and `rollrig describe`.
struct ResultInfo {
  std::string key;
  std::string doc;
};

/// Which of the two tables of a list of records shows a column.
enum class Column { kFirst, kSecond, kBoth };

/// Declaration of one result. Its unit is read off the key's suffix; the value that goes with it is SI. A key with a
/// dot is of an object in JSON: "tire_file.rrc_N_per_kN". Sweeps draw no such result unless asked for it.
struct Result {
  const char* key;
  const char* label;   // before its value, or over its column, where the unit follows; "": in no line of its own
  const char* digits;  // as fmt writes them: ".2f", or "+.1f" with the sign; "" for what is no measure
  const char* doc;
  Column column = Column::kFirst;
  bool left_out = false;  // of JSON, where it has no value; otherwise it is null

  constexpr Result or_left_out() const { return {key, label, digits, doc, column, true}; }
};

/// Declaration of a list of records, each of which has a visit() of its own.
struct ResultList {
  const char* key;
  const char* title;  // of its table
  const char* doc;
  const char* second_title = "";
  bool left_out = false;  // of JSON, where it is empty
};

/// Results declared before it on one line, in place of a line each: "{load_N}, {speed_km_h}" reads "5400 N, 80.0 km/h".
/// A unit stands after the last of those that share it side by side. No line where one of them has no value.
struct JointLine {
  std::string label;
  std::string text;
};

/// What the run says at a glance, of results declared before it: `text` as of a JointLine, its unit apart where there
/// is but one. Of a list, "{cycles.first.rrc_N_per_kN}" is of its first record, "last" of its last. None where a value
/// of `text` is missing; a note that lacks one is left out alone.
struct Headline {
  std::string label;  // likewise with {keys}, as the note
  std::string text;
  std::string note = {};
};

/// What the run found, in one sentence of results declared before it, with their units: "RRc is {rrc_N_per_kN}." Of
/// several, the first counts of which no value is missing.
struct Summary {
  std::string text;
};

/// A headline as a page shows it.
struct ShownHeadline {
  std::string label;
  std::string value;
  std::string unit;
  std::string note;
  std::vector<std::string> keys;  // of `result`, in the order of the value's numbers: "cycles/0/rrc_N_per_kN"
};

/// Text for a person alone, beside the results: an input, or a comparison with one. In a record it is a column. None
/// where it is empty.
struct Remark {
  const char* label;
};

/// A number in the unit of `key`, with the unit.
std::string show_number(const char* key, const char* digits, double value_SI);

/// What the visit() of a scenario's results, or of a record of them, declares, in all its forms.
class ResultSheet {
 public:
  Json json = Json::object();  // `result` of result.json
  std::vector<ResultLine> lines;
  std::vector<Table> tables;      // of what was measured at several points
  std::vector<ResultInfo> infos;  // a record's result as "cycles[].load_N"
  std::vector<ShownHeadline> headlines;
  std::string summary;  // empty where no sentence is declared or each lacks a value
  /// Keys whose value alone is a headline, in their order, with its label where that has no keys; also of results
  /// without a value.
  std::vector<std::pair<std::string, std::string>> headline_keys;

  /// The sheet of a struct with a visit(ResultSheet&).
  template <class Results>
  static ResultSheet of(const Results& results) {
    ResultSheet sheet;
    results.visit(sheet);
    return sheet;
  }

  /// The lines, then the tables.
  std::vector<Table> list_tables() const;

  void operator()(const Result& result, double value_SI);
  void operator()(const Result& result, const std::optional<double>& value_SI);
  void operator()(const Result& result, int value) { add(result, value, std::to_string(value)); }
  void operator()(const Result& result, bool value) { add(result, value, value ? "yes" : "no"); }
  void operator()(const Result& result, const std::string& value) { add(result, value, value); }
  void operator()(const Result& result, const std::optional<std::string>& value) {
    add(result, value.has_value() ? Json(*value) : Json(), value.value_or(""));
  }
  void operator()(const Remark& remark, const std::string& text);
  void operator()(const JointLine& line);
  void operator()(const Headline& headline);
  void operator()(const Summary& sentence);
  template <class Record>
  void operator()(const ResultList& list, const std::vector<Record>& records) {
    add(list, of(Record{}), list_sheets(records), records.size());
  }
  /// With a record of all records together: the last row of the tables, and in JSON an object beside the list, such as
  /// "sections_total". Numbers of it that are NaN have no value; JSON leaves them out.
  template <class Record>
  void operator()(const ResultList& list, const std::vector<Record>& records, const std::optional<Record>& total) {
    const ResultSheet declared = of(Record{});
    declare_total(list, declared);
    std::vector<ResultSheet> sheets = list_sheets(records);
    if (total.has_value()) {
      sheets.push_back(of(*total));
      add_total(list, sheets.back());
    }
    add(list, declared, sheets, records.size());
  }

 private:
  struct Shown {
    std::string text;  // empty where there is no value
    std::string unit;
    std::string place;  // in `json`
  };
  /// A text with the values of its {keys}.
  struct Filled {
    std::string text;
    std::string unit;  // of a last value that ends the text, where it is asked for apart
    std::vector<const Shown*> used;
    std::vector<std::string> keys;
    bool is_whole = true;
  };
  using Row = std::vector<std::string>;

  void add(const Result& result, const Json& value, const std::string& text);
  template <class Record>
  static std::vector<ResultSheet> list_sheets(const std::vector<Record>& records) {
    std::vector<ResultSheet> sheets;
    for (const Record& record : records) sheets.push_back(of(record));
    return sheets;
  }
  /// Of `sheets`, the first `records` are records, and what follows is a row of the tables alone.
  void add(const ResultList& list, const ResultSheet& declared, const std::vector<ResultSheet>& sheets,
           std::size_t records);
  void declare_total(const ResultList& list, const ResultSheet& declared);
  void add_total(const ResultList& list, const ResultSheet& total);
  void show_record(const std::string& list, const char* which, std::size_t place, const ResultSheet& record);
  Filled fill(const std::string& text, bool with_last_unit) const;

  std::map<std::string, Shown> shown_;   // by key
  std::array<Row, 2> headings_, cells_;  // of a record, as its tables show it
};

}  // namespace rollrig::scenarios
