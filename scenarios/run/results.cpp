#include "scenarios/run/results.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace rollrig::scenarios {
namespace {

/// A value in the unit of its key. The reciprocal of a unit such as 1/100 is a whole number, and exact as the unit
/// itself is not.
double to_file_unit(const Unit& unit, double value_SI) {
  const double per_SI = 1.0 / unit.factor;
  return per_SI == std::floor(per_SI) ? (value_SI - unit.offset_SI) * per_SI : unit.from_si(value_SI);
}

std::string show(const char* digits, double value) {
  return std::isnan(value) ? "" : fmt::format(fmt::runtime(fmt::format("{{:{}}}", digits)), value);
}

/// With a blank between, where there are both.
std::string join(const std::string& text, const std::string& unit) {
  return text + (text.empty() || unit.empty() ? "" : " ") + unit;
}

}  // namespace

std::string show_number(const char* key, const char* digits, double value_SI) {
  const Unit unit = unit_of_key(key);
  return join(show(digits, to_file_unit(unit, value_SI)), unit.symbol);
}

std::vector<Table> ResultSheet::list_tables() const {
  std::vector<Table> all{{"", {}, {}}};
  for (const ResultLine& line : lines) all.front().rows.push_back({line.label, line.value});
  all.insert(all.end(), tables.begin(), tables.end());
  return all;
}

void ResultSheet::operator()(const Result& result, double value_SI) {
  const double value = to_file_unit(unit_of_key(result.key), value_SI);
  add(result, value, show(result.digits, value));
}

void ResultSheet::operator()(const Result& result, const std::optional<double>& value_SI) {
  value_SI.has_value() ? (*this)(result, *value_SI) : add(result, Json(), "");
}

void ResultSheet::operator()(const Remark& remark, const std::string& text) {
  if (!text.empty()) lines.push_back({remark.label, text});
  headings_[0].emplace_back(remark.label);
  cells_[0].push_back(text);
}

void ResultSheet::add(const Result& result, const Json& value, const std::string& text) {
  const std::string unit = unit_of_key(result.key).symbol;
  infos.push_back({result.key, result.doc});
  if (!(result.left_out && value.is_null())) json[result.key] = value;
  shown_[result.key] = {text, unit};
  if (!text.empty()) lines.push_back({result.label, join(text, unit), result.key});
  for (const Column column : {Column::kFirst, Column::kSecond}) {
    if (result.column != column && result.column != Column::kBoth) continue;
    const std::size_t at = column == Column::kFirst ? 0 : 1;
    headings_[at].push_back(join(result.label, unit));
    cells_[at].push_back(value.is_null() ? "-" : text);
  }
}

void ResultSheet::operator()(const JointLine& line) {
  const auto key_at = [&line](std::size_t open) {
    return line.text.substr(open + 1, line.text.find('}', open) - open - 1);
  };
  std::string text = line.text.substr(0, line.text.find('{'));
  bool is_whole = true;
  for (std::size_t open = line.text.find('{'); open != std::string::npos;) {
    const std::string key = key_at(open);
    const Shown& shown = shown_.at(key);
    const std::size_t after = open + key.size() + 2;
    open = line.text.find('{', after);
    const bool is_shared = open != std::string::npos && shown_.at(key_at(open)).unit == shown.unit;
    text += (is_shared ? shown.text : join(shown.text, shown.unit)) + line.text.substr(after, open - after);
    is_whole = is_whole && !shown.text.empty();
    lines.erase(std::remove_if(lines.begin(), lines.end(), [&key](const ResultLine& own) { return own.key == key; }),
                lines.end());
  }
  if (is_whole) lines.push_back({line.label, text});
}

void ResultSheet::add(const ResultList& list, const ResultSheet& declared, const std::vector<ResultSheet>& sheets,
                      bool has_total) {
  infos.push_back({list.key, list.doc});
  for (const ResultInfo& info : declared.infos) infos.push_back({fmt::format("{}[].{}", list.key, info.key), info.doc});
  if (!(list.left_out && sheets.empty())) json[list.key] = Json::array();
  for (std::size_t i = 0; i + (has_total ? 1 : 0) < sheets.size(); ++i) json[list.key].push_back(sheets[i].json);
  for (const std::size_t at : {0U, 1U}) {
    if (sheets.empty() || declared.headings_[at].empty()) continue;
    Table table{at == 0 ? list.title : list.second_title, declared.headings_[at], {}};
    for (const ResultSheet& sheet : sheets) table.rows.push_back(sheet.cells_[at]);
    tables.push_back(std::move(table));
  }
}

}  // namespace rollrig::scenarios
