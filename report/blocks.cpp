#include "report/blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>

#include "comparison/compared.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {

Json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

Json make_series(const std::string& name, const std::vector<double>& time_s, const std::vector<double>& values,
                 std::size_t most) {
  double size = 0.0;
  for (const double value : values) size = std::isfinite(value) ? std::max(size, std::abs(value)) : size;
  constexpr double kShown = 1e-6;  // of the largest value: less than the six digits that are written
  Json t = Json::array();
  Json y = Json::array();
  for (const std::size_t row : thin(time_s, values, most, kShown * size)) {
    t.push_back(std::round(1e3 * time_s[row]) / 1e3);
    y.push_back(rounded(values[row]));
  }
  return {{"name", name}, {"t", t}, {"y", y}};
}

Block make_tiles(const std::vector<Tile>& tiles) {
  Block block = {{"type", "tiles"}, {"tiles", Json::array()}};
  for (const Tile& tile : tiles) {
    Json json = {{"label", pretty_unit(tile.label)}, {"value", tile.value}};
    if (!tile.unit.empty()) json["unit"] = pretty_unit(tile.unit);
    if (!tile.note.empty()) json["note"] = pretty_unit(tile.note);
    if (!tile.tone.empty()) json["tone"] = tile.tone;
    if (!tile.from.empty()) json["from"] = tile.from;
    block["tiles"].push_back(std::move(json));
  }
  return block;
}

Block make_table(const Table& table) {
  Block block = {{"type", "lines"}, {"lines", Json::array()}};
  if (!table.columns.empty()) block = {{"type", "table"}, {"columns", Json::array()}, {"rows", Json::array()}};
  if (!table.title.empty()) block["caption"] = pretty_unit(table.title);
  for (const std::string& column : table.columns) block["columns"].push_back({{"label", pretty_unit(column)}});
  for (const std::vector<std::string>& row : table.rows) {
    if (table.columns.empty()) {
      block["lines"].push_back({{"label", pretty_unit(row[0])}, {"value", pretty_unit(row[1])}});
      continue;
    }
    Json cells = Json::array();
    for (const std::string& cell : row) cells.push_back(pretty_unit(cell));
    block["rows"].push_back(cells);
  }
  return block;
}

void ChartSeries::add(double at, double value) {
  x.push_back(rounded(at));
  y.push_back(rounded(value));
}

void ChartSeries::add(double at, double value, double from, double to) {
  add(at, value);
  low.push_back(rounded(from));
  high.push_back(rounded(to));
}

Json ChartSeries::finish(const std::string& name, const char* kind) const {
  Json series = {{"name", name}, {"kind", kind}, {"x", x}, {"y", y}};
  if (!low.empty()) series.update({{"low", low}, {"high", high}});
  return series;
}

Block make_curves(const Axis& x, const Axis& y, Json series, const std::string& caption) {
  const auto to_json = [](const Axis& axis) {
    Json json = {{"label", pretty_unit(axis.label)}, {"unit", pretty_unit(axis.unit)}};
    if (axis.from_zero) json["from_zero"] = true;
    return json;
  };
  Block block = {{"type", "curves"}, {"x", to_json(x)}, {"y", to_json(y)}, {"series", std::move(series)}};
  if (!caption.empty()) block["caption"] = caption;
  return block;
}

Block make_bars(const Axis& y, Json categories, Json series, const std::string& caption) {
  for (Json& category : categories) category = pretty_unit(category);
  Block block = {{"type", "bars"},
                 {"label", pretty_unit(y.label)},
                 {"unit", pretty_unit(y.unit)},
                 {"categories", std::move(categories)},
                 {"series", std::move(series)}};
  if (!caption.empty()) block["caption"] = caption;
  return block;
}

Section make_document(const Json& document, const std::string& folded) {
  return {"Everything as numbers", "", {{{"type", "pre"}, {"text", document.dump(2)}}}, folded};
}

Section make_section(const std::string& title, const std::vector<Table>& tables,
                     const std::vector<std::string>& warnings) {
  Section section{title};
  if (!warnings.empty()) section.blocks.push_back(make_warnings(warnings));
  for (const Table& table : tables) {
    if (!table.rows.empty()) section.blocks.push_back(make_table(table));
  }
  return section;
}

std::vector<std::string> name_numbers(const std::vector<std::string>& keys) {
  std::map<std::string, int> uses;
  for (const std::string& key : keys) ++uses[plain_name(last_part(key))];
  std::vector<std::string> names;
  for (const std::string& key : keys) {
    const std::string name = plain_name(last_part(key));
    const std::size_t dot = key.rfind('.');
    const bool needs_table = uses[name] > 1 && dot != std::string::npos;
    names.push_back(needs_table ? plain_name(last_part(key.substr(0, dot))) + ": " + name : name);
  }
  return names;
}

std::string name_set(const std::string& name) {
  const std::string of_scenario = comparison::label_place(name);
  return of_scenario == name ? name : "a set: " + of_scenario;
}

Table make_estimate_table(const std::string& title, const std::vector<ParameterEstimate>& estimates) {
  Table table{title, {"parameter", "value", "sd", "from", "to", "unit"}, {}};
  for (const ParameterEstimate& at : estimates) {
    const auto number = [](double value) { return fmt::format("{:.5g}", value); };
    const bool is_free = at.sd > 0.0;
    const char* on_limit = at.on_limit == RangeLimit::kNone ? "" : " (on the limit of its range)";
    table.rows.push_back({at.name + on_limit, number(at.value), is_free ? fmt::format("{:.3g}", at.sd) : "on its bound",
                          is_free ? number(at.low_95) : "", is_free ? number(at.high_95) : "", at.unit});
  }
  return table;
}

Block make_warnings(const std::vector<std::string>& warnings) { return {{"type", "warnings"}, {"items", warnings}}; }

Block make_equations(const std::string& of) { return {{"type", "equations"}, {"of", of}}; }

Block make_paragraph(const std::string& text) { return {{"type", "text"}, {"paragraphs", Json::array({text})}}; }

Block make_lead(const std::string& tone, const std::string& text, const std::string& more) {
  Block block = {{"type", "lead"}, {"tone", tone}, {"text", pretty_unit(text)}};
  if (!more.empty()) block["more"] = pretty_unit(more);
  return block;
}

void put_first(std::vector<Block> blocks, Section& section) {
  section.blocks.insert(section.blocks.begin(), std::make_move_iterator(blocks.begin()),
                        std::make_move_iterator(blocks.end()));
}

std::string pretty_unit(std::string symbol) {
  for (std::size_t at = symbol.find("degC"); at != std::string::npos; at = symbol.find("degC", at + 1)) {
    const std::size_t first = symbol.find_last_of(' ', at) + 1;  // of no space: 0
    const bool is_of_key = symbol.substr(first, symbol.find(' ', at) - first).find('_') != std::string::npos;
    if (!is_of_key) symbol.replace(at, 4, "°C");
  }
  for (const auto& [plain, pretty] : {std::pair("(km/h)2", "(km/h)²"),
                                      {"m/s2", "m/s²"},
                                      {"kg m2", "kg m²"},
                                      {"s2/m2", "s²/m²"},
                                      {"/mph2", "/mph²"},
                                      {"(km/h)^2", "(km/h)²"},
                                      {"kPa^-alpha", "kPa⁻ᵅ"},
                                      {"N^-beta", "N⁻ᵝ"}}) {
    boost::algorithm::replace_all(symbol, plain, pretty);
  }
  return symbol;
}

std::string capitalized(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string show_with_sd(double value, double sd) {
  constexpr int kMost = 12;
  const int decimals = sd > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(sd))), 0, kMost) : 3;
  return fmt::format("{0:.{2}f} +- {1:.{2}f}", value, sd, decimals);
}

std::vector<double> in_unit_of(const std::string& key, std::vector<double> values_SI) {
  const Unit unit = unit_of_key(key);
  for (double& value : values_SI) value = unit.from_si(value);
  return values_SI;
}

std::string shown_unit(const std::string& key) { return pretty_unit(unit_of_key(key).symbol); }

}  // namespace rollrig::report
