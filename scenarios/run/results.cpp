#include "scenarios/run/results.h"

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <set>

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

std::string make_total_key(const ResultList& list) { return std::string(list.key) + "_total"; }

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
  const std::string place = boost::algorithm::replace_all_copy(std::string(result.key), ".", "/");
  if (!(result.left_out && value.is_null())) json[Json::json_pointer("/" + place)] = value;
  shown_[result.key] = {text, unit, place};
  if (!text.empty()) lines.push_back({result.label, join(text, unit), result.key});
  for (const Column column : {Column::kFirst, Column::kSecond}) {
    if (result.column != column && result.column != Column::kBoth) continue;
    const std::size_t at = column == Column::kFirst ? 0 : 1;
    headings_[at].push_back(join(result.label, unit));
    cells_[at].push_back(value.is_null() ? "-" : text);
  }
}

ResultSheet::Filled ResultSheet::fill(const std::string& text, bool with_last_unit) const {
  static const std::set<std::string> kBeside{", ", " / ", " +- ", " to ", " and ", " of "};  // a unit serves both
  const auto key_at = [&text](std::size_t open) { return text.substr(open + 1, text.find('}', open) - open - 1); };
  Filled filled{text.substr(0, text.find('{')), {}, {}, {}};
  for (std::size_t open = text.find('{'); open != std::string::npos;) {
    const std::string key = key_at(open);
    const Shown& shown = shown_.at(key);
    const std::size_t after = open + key.size() + 2;
    open = text.find('{', after);
    const bool is_beside = open != std::string::npos && kBeside.count(text.substr(after, open - after)) > 0;
    const bool is_shared = is_beside && shown_.at(key_at(open)).unit == shown.unit;
    const bool is_last = after == text.size() && !with_last_unit;
    filled.text +=
        (is_shared || is_last ? shown.text : join(shown.text, shown.unit)) + text.substr(after, open - after);
    if (is_last) filled.unit = shown.unit;
    filled.is_whole = filled.is_whole && !shown.text.empty();
    filled.used.push_back(&shown);
    filled.keys.push_back(key);
  }
  return filled;
}

void ResultSheet::operator()(const JointLine& line) {
  const Filled filled = fill(line.text, true);
  lines.erase(std::remove_if(lines.begin(), lines.end(),
                             [&filled](const ResultLine& own) {
                               return std::find(filled.keys.begin(), filled.keys.end(), own.key) != filled.keys.end();
                             }),
              lines.end());
  if (filled.is_whole) lines.push_back({line.label, filled.text});
}

void ResultSheet::operator()(const Headline& headline) {
  const Filled label = fill(headline.label, true);
  const Filled value = fill(headline.text, false);
  const Filled note = fill(headline.note, true);
  if (!value.keys.empty() && label.keys.empty()) headline_keys.emplace_back(value.keys.front(), headline.label);
  if (!value.is_whole) return;
  ShownHeadline shown{label.text, value.text, value.unit, note.is_whole ? note.text : "", {}};
  for (const Shown* one : value.used) shown.keys.push_back(one->place);
  headlines.push_back(std::move(shown));
}

void ResultSheet::operator()(const Summary& sentence) {
  if (!summary.empty()) return;
  const Filled filled = fill(sentence.text, true);
  if (filled.is_whole) summary = filled.text;
}

void ResultSheet::add(const ResultList& list, const ResultSheet& declared, const std::vector<ResultSheet>& sheets,
                      std::size_t records) {
  infos.push_back({list.key, list.doc});
  for (const ResultInfo& info : declared.infos) infos.push_back({fmt::format("{}[].{}", list.key, info.key), info.doc});
  if (!(list.left_out && sheets.empty())) json[list.key] = Json::array();
  for (std::size_t i = 0; i < records; ++i) json[list.key].push_back(sheets[i].json);
  show_record(list.key, "first", 0, records > 0 ? sheets.front() : declared);
  show_record(list.key, "last", records > 0 ? records - 1 : 0, records > 0 ? sheets[records - 1] : declared);
  for (const std::size_t at : {0U, 1U}) {
    if (sheets.empty() || declared.headings_[at].empty()) continue;
    Table table{at == 0 ? list.title : list.second_title, declared.headings_[at], {}};
    for (const ResultSheet& sheet : sheets) table.rows.push_back(sheet.cells_[at]);
    tables.push_back(std::move(table));
  }
}

void ResultSheet::declare_total(const ResultList& list, const ResultSheet& declared) {
  infos.push_back(
      {make_total_key(list), fmt::format("all of {} together; a number that has no sum is left out", list.key)});
  for (const ResultInfo& info : declared.infos) {
    infos.push_back({fmt::format("{}.{}", make_total_key(list), info.key), info.doc});
  }
}

void ResultSheet::add_total(const ResultList& list, const ResultSheet& total) {
  Json& record = json[make_total_key(list)] = Json::object();
  for (const auto& [key, value] : total.json.items()) {
    if (!value.is_number() || std::isfinite(value.get<double>())) record[key] = value;
  }
}

void ResultSheet::show_record(const std::string& list, const char* which, std::size_t place,
                              const ResultSheet& record) {
  const bool is_there = json.contains(list) && !json[list].empty();
  for (const auto& [key, shown] : record.shown_) {
    shown_[fmt::format("{}.{}.{}", list, which, key)] = {is_there ? shown.text : "", shown.unit,
                                                         fmt::format("{}/{}/{}", list, place, shown.place)};
  }
}

}  // namespace rollrig::scenarios
