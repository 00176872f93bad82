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

namespace rollrig::measurements {
namespace {

constexpr double kPound_N = 4.4482216152605;  // 0.45359237 kg at standard gravity
constexpr double kPerFahrenheit = 5.0 / 9.0;

struct UnitSpelling {
  const char* text;  // without blanks and signs of multiplication
  const char* suffix;
  double factor = 1.0;
  double offset = 0.0;
};

/// The first spelling of a unit is the one of messages. Revolutions per minute have no suffix.
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
      {"mph", "km_h", 1.609344},
      {"mi/h", "km_h", 1.609344},
      {"1/min", ""},
      {"rpm", ""},
      {"U/min", ""},
      {"min-1", ""},
      {"N", "N"},
      {"kN", "kN"},
      {"daN", "N", 10.0},
      {"kgf", "N", kStandardGravity_m_s2},
      {"kg", "N", kStandardGravity_m_s2},
      {"kp", "N", kStandardGravity_m_s2},
      {"lbf", "N", kPound_N},
      {"lb", "N", kPound_N},
      {"lbs", "N", kPound_N},
      {"degC", "degC"},
      {"C", "degC"},
      {"Celsius", "degC"},
      {"GradC", "degC"},
      {"K", "K"},
      {"degF", "degC", kPerFahrenheit, -32.0 * kPerFahrenheit},
      {"F", "degC", kPerFahrenheit, -32.0 * kPerFahrenheit},
      {"Fahrenheit", "degC", kPerFahrenheit, -32.0 * kPerFahrenheit},
      {"Nm", "Nm"},
      {"kNm", "Nm", 1e3},
      {"lbfft", "Nm", 0.3048 * kPound_N},
      {"ftlbf", "Nm", 0.3048 * kPound_N},
      {"ftlb", "Nm", 0.3048 * kPound_N},
      {"lbft", "Nm", 0.3048 * kPound_N},
      {"kPa", "kPa"},
      {"bar", "bar"},
      {"mbar", "mbar"},
      {"hPa", "mbar"},
      {"MPa", "kPa", 1e3},
      {"Pa", "Pa"},
      {"psi", "kPa", 6.894757293168},
      {"m", "m"},
      {"km", "km"},
      {"ft", "m", 0.3048},
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
    GuessedUnit unit{spelling.suffix, spelling.factor, spelling.offset, text};
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
    const GuessedUnit unit{spelling.suffix, spelling.factor, spelling.offset, spelling.text};
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
