#include "measurements/logs/guess_units.h"

#include <algorithm>
#include <array>
#include <regex>

#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>

#include "sim/core/unit_names.h"

namespace rollrig::measurements {
namespace {

struct UnitSpelling {
  const char* text;       // without blanks and signs of multiplication
  const char* suffix;     // of a mapping, in this unit or another one of its dimension
  const char* name = "";  // of parse_unit(), where the unit is not that of the suffix
};

/// The first spelling of a unit is the one of messages. Revolutions per minute have no suffix. The list is short, since
/// a letter of a heading is rarely a unit, although many letters are units.
const std::vector<UnitSpelling>& unit_spellings() {
  static const std::vector<UnitSpelling> all{
      {"km/h", "km_h"},
      {"km_h", "km_h"},
      {"kmh", "km_h"},
      {"kph", "km_h"},
      {"km/std", "km_h"},
      {"m/s", "m_s"},
      {"m_s", "m_s"},
      {"mps", "m_s"},
      {"mph", "km_h", "mph"},
      {"mi/h", "km_h", "mph"},
      {"1/min", ""},
      {"rpm", ""},
      {"U/min", ""},
      {"min-1", ""},
      {"N", "N"},
      {"kN", "kN"},
      {"daN", "N", "daN"},
      {"kgf", "N", "kgf"},
      {"kg", "N", "kgf"},
      {"kp", "N", "kgf"},
      {"lbf", "N", "lbf"},
      {"lb", "N", "lbf"},
      {"lbs", "N", "lbf"},
      {"degC", "degC"},
      {"C", "degC"},
      {"Celsius", "degC"},
      {"GradC", "degC"},
      {"K", "K"},
      {"degF", "degC", "degF"},
      {"F", "degC", "degF"},
      {"Fahrenheit", "degC", "degF"},
      {"Nm", "Nm"},
      {"kNm", "Nm", "kN m"},
      {"lbfft", "Nm", "lbf ft"},
      {"ftlbf", "Nm", "lbf ft"},
      {"ftlb", "Nm", "lbf ft"},
      {"lbft", "Nm", "lbf ft"},
      {"kPa", "kPa"},
      {"bar", "bar"},
      {"mbar", "mbar"},
      {"hPa", "mbar"},
      {"MPa", "kPa", "MPa"},
      {"Pa", "Pa"},
      {"psi", "kPa", "psi"},
      {"m", "m"},
      {"km", "km"},
      {"ft", "m", "ft"},
      {"s", "s"},
      {"sec", "s"},
      {"sek", "s"},
      {"seconds", "s"},
      {"Sekunden", "s"},
      {"ms", "ms"},
      {"min", "min"},
      {"h", "h"},
  };
  return all;
}

GuessedUnit make_unit(const UnitSpelling& spelling, const std::string& written) {
  GuessedUnit unit{spelling.suffix, 1.0, 0.0, written};
  if (*spelling.name == '\0') return unit;
  const Unit of_suffix = unit_of_key("value_" + unit.suffix);
  const Unit named = parse_unit(spelling.name, of_suffix);
  unit.factor = named.factor / of_suffix.factor;
  unit.offset = (named.offset_SI - of_suffix.offset_SI) / of_suffix.factor;
  return unit;
}

/// "N·m" and "N m" are "Nm"; "°C" is "degC".
std::string normalize_unit(std::string text) {
  for (const char* sign : {"\u00B7", "\u22C5", "*", " ", "^"}) boost::algorithm::erase_all(text, sign);
  boost::algorithm::replace_all(text, "\u00B0", "deg");
  boost::algorithm::replace_all(text, "\u00BA", "deg");
  boost::algorithm::replace_all(text, "\u207B\u00B9", "-1");
  return text;
}

/// Takes "(a)", "abs", "(g)" and their like off the unit of a pressure. Returns whether it was absolute.
bool take_off_reference(std::string& text) {
  static const std::regex absolute("^(bar|kPa|psi|mbar|hPa|MPa)(\\(a\\)|\\(abs\\)|_?abs|a)$", std::regex::icase);
  static const std::regex gauge("^(bar|kPa|psi|mbar|hPa|MPa)(\\(g\\)|\\(rel\\)|_?rel|g|\\(\u00FC\\)|\u00FC)$",
                                std::regex::icase);
  std::smatch match;
  const bool is_absolute = std::regex_match(text, match, absolute);
  if (is_absolute || std::regex_match(text, match, gauge)) text = match[1].str();
  return is_absolute;
}

/// "p_bar" and its like. One letter that may be an index of the name, as in T_m, is none.
std::optional<HeadingParts> split_at_underscore(const std::string& heading) {
  for (std::size_t at = heading.find('_'); at != std::string::npos && at > 0; at = heading.find('_', at + 1)) {
    const std::string last = heading.substr(at + 1);
    const std::optional<GuessedUnit> unit = find_unit(last);
    const bool may_be_index = last == "m" || last == "C" || last == "F" || last == "h";
    if (unit.has_value() && !may_be_index) return HeadingParts{heading.substr(0, at), unit, ""};
  }
  return std::nullopt;
}

}  // namespace

bool GuessedUnit::is_of(const Quantity& quantity) const {
  const Unit wanted = quantity.file_unit();
  if (is_rpm()) return wanted.symbol == "km/h";
  return unit_of_key("value_" + suffix).dimension == wanted.dimension;
}

double GuessedUnit::convert(double number, const Quantity& quantity) const {
  return quantity.file_unit().from_si(unit_of_key("value_" + suffix).to_si(number * factor + offset));
}

std::optional<GuessedUnit> find_unit(const std::string& text) {
  std::string plain = normalize_unit(text);
  const bool is_absolute = take_off_reference(plain);
  const auto make = [&](const UnitSpelling& spelling) {
    GuessedUnit unit = make_unit(spelling, text);
    if (is_absolute) unit.offset -= kStandardAtmosphere_Pa / unit_of_key("value_" + unit.suffix).factor;
    return unit;
  };
  for (const UnitSpelling& spelling : unit_spellings()) {
    if (plain == spelling.text) return make(spelling);
  }
  for (const UnitSpelling& spelling : unit_spellings()) {
    if (plain.size() > 1 && boost::algorithm::iequals(plain, spelling.text)) return make(spelling);
  }
  return std::nullopt;
}

std::vector<GuessedUnit> list_units(const Quantity& quantity) {
  std::vector<GuessedUnit> units;
  for (const UnitSpelling& spelling : unit_spellings()) {
    const GuessedUnit unit = make_unit(spelling, spelling.text);
    const auto is_same = [&unit](const GuessedUnit& known) {
      return known.suffix == unit.suffix && known.factor == unit.factor;
    };
    if (!unit.is_rpm() && unit.is_of(quantity) && std::none_of(units.begin(), units.end(), is_same)) {
      units.push_back(unit);
    }
  }
  return units;
}

HeadingParts split_heading(const std::string& heading, const std::string& unit_cell) {
  const std::string cell = boost::algorithm::trim_copy_if(unit_cell, boost::algorithm::is_any_of("[]() "));
  if (!cell.empty() && cell != "-") {
    const std::optional<GuessedUnit> unit = find_unit(cell);
    return {heading, unit, unit.has_value() ? "" : cell};
  }
  static const std::array<std::regex, 6> kForms{std::regex("^(.*\\S)\\s*\\[\\s*(.*?)\\s*\\]$"),
                                                std::regex("^(.*[^\\s(])\\s*\\(\\s*(.*?)\\s*\\)$"),
                                                std::regex("^(.*\\S)\\s+in\\s+(\\S+)$"),
                                                std::regex("^(.*\\S)\\s+/\\s+(\\S+)$"),
                                                std::regex("^(.*\\S)\\s+(\\S+)$"),
                                                std::regex("^(.*?\\S)/(\\S+)$")};
  if (const auto parts = split_at_underscore(heading)) return *parts;
  std::smatch match;
  for (const std::regex& form : kForms) {
    if (!std::regex_match(heading, match, form)) continue;
    const std::optional<GuessedUnit> unit = find_unit(match[2]);
    if (unit.has_value()) return {match[1], unit, ""};
    if (&form == &kForms.front()) return {match[1], std::nullopt, match[2]};
  }
  return {heading, std::nullopt, ""};
}

}  // namespace rollrig::measurements
