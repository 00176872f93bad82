#include "measurements/logs/guess_units.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>

#include "sim/core/text_cursor.h"
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
  constexpr std::array<const char*, 6> kPressures{"bar", "kPa", "psi", "mbar", "hPa", "MPa"};
  static const std::vector<std::string> absolute{"(a)", "(abs)", "abs", "_abs", "a"};
  static const std::vector<std::string> gauge{"(g)", "(rel)", "rel", "_rel", "g", "(\u00FC)", "\u00FC"};
  for (const std::string pressure : kPressures) {
    if (!boost::algorithm::istarts_with(text, pressure)) continue;
    const auto is_rest = [rest = text.substr(pressure.size())](const std::string& reference) {
      return boost::algorithm::iequals(rest, reference);
    };
    const bool is_absolute = std::any_of(absolute.begin(), absolute.end(), is_rest);
    if (is_absolute || std::any_of(gauge.begin(), gauge.end(), is_rest)) text.resize(pressure.size());
    return is_absolute;
  }
  return false;
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

/// A heading as a name and what may be a unit.
struct SplitHeading {
  std::string name, unit;
  bool is_in_brackets = false;
};

std::string trim_right(std::string_view text) {
  return std::string(text.substr(0, text.find_last_not_of(kBlanks) + 1));  // of blanks alone: nothing
}

/// "name [unit]", "name (unit)"; the last bracket that opens, where no other one stands right before it.
void add_bracketed(const std::string& heading, char open, char close, std::vector<SplitHeading>& found) {
  if (heading.empty() || heading.back() != close) return;
  for (std::size_t at = heading.rfind(open); at != std::string::npos && at > 0; at = heading.rfind(open, at - 1)) {
    const std::string name = trim_right(std::string_view(heading).substr(0, at));
    if (name.empty()) return;
    if (open == '(' && name.back() == open) continue;
    found.push_back({name, boost::algorithm::trim_copy(heading.substr(at + 1, heading.size() - at - 2)), open == '['});
    return;
  }
}

/// "name in unit", "name / unit", "name unit", "name/unit".
void add_words(const std::string& heading, std::vector<SplitHeading>& found) {
  const std::size_t last = heading.find_last_of(kBlanks) + 1;  // first character of the last word
  const std::string unit = heading.substr(last);
  const std::string name = trim_right(std::string_view(heading).substr(0, last));
  if (!name.empty() && !unit.empty()) {
    for (const std::string link : {"in", "/"}) {
      const std::size_t before = name.size() - std::min(name.size(), link.size());
      const std::string shorter = trim_right(std::string_view(name).substr(0, before));
      if (name.compare(before, std::string::npos, link) == 0 && !shorter.empty() && shorter.size() < before) {
        found.push_back({shorter, unit});
      }
    }
    found.push_back({name, unit});
  }
  std::size_t slash = heading.find('/', last);
  if (slash == last) slash = heading.find('/', last + 1);  // nothing but a blank stands before the first one
  if (slash != std::string::npos && slash + 1 < heading.size()) {
    found.push_back({heading.substr(0, slash), heading.substr(slash + 1)});
  }
}

/// The ways to split a heading, the likeliest first.
std::vector<SplitHeading> list_splits(const std::string& heading) {
  std::vector<SplitHeading> found;
  add_bracketed(heading, '[', ']', found);
  add_bracketed(heading, '(', ')', found);
  add_words(heading, found);
  return found;
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
  constexpr std::size_t kLongest = 40;  // Assumed: characters; the longest spelling has fewer
  if (text.size() > kLongest) return std::nullopt;
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
  if (const auto parts = split_at_underscore(heading)) return *parts;
  for (const SplitHeading& split : list_splits(heading)) {
    const std::optional<GuessedUnit> unit = find_unit(split.unit);
    if (unit.has_value()) return {split.name, unit, ""};
    if (split.is_in_brackets) return {split.name, std::nullopt, split.unit};
  }
  return {heading, std::nullopt, ""};
}

}  // namespace rollrig::measurements
