#include "sim/core/unit_names.h"

#include <udunits2.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>

#include "sim/core/text.h"
#include "sim/core/text_cursor.h"

namespace rollrig {
namespace {

constexpr std::size_t kLongestUnit = 100;  // Assumed: characters of a name, more of which UDUNITS does not get

/// A dimension that has a name, and units that logs have it in.
struct NamedDimension {
  Dimension dimension;
  const char* name;
  std::vector<std::string> units;
};

const std::vector<NamedDimension>& named_dimensions() {
  static const std::vector<NamedDimension> named{
      {dimension::kForce, "force", {"N", "kgf", "lbf", "kN", "daN", "kip"}},
      {{1, 2, -2, 0}, "torque or energy", {"N m", "kN m", "lbf ft", "lbf in", "kgf m", "J", "kJ", "kWh"}},
      {dimension::kPressure, "pressure", {"kPa", "Pa", "hPa", "MPa", "bar", "mbar", "psi", "mmHg", "atm"}},
      {dimension::kTemperature, "temperature", {"degC", "K", "degF", "°C", "°F"}},
      {dimension::kSpeed, "speed", {"km_h", "m_s", "km/h", "m/s", "mph", "ft/s", "knots"}},
      {dimension::kLength, "length", {"m", "mm", "cm", "km", "ft", "in", "mile"}},
      {dimension::kTime, "time", {"s", "ms", "min", "h"}},
      {dimension::kMass, "mass", {"kg", "g", "t", "lb"}},
      {dimension::kPower, "power", {"W", "kW", "hp"}},
      {dimension::kNone, "number without a dimension", {"1", "percent", "%", "rad", "deg"}},
      {{0, 0, -1, 0}, "frequency", {"Hz", "1/min"}}};
  return named;
}

/// What people write and UDUNITS reads as something else, or not at all.
std::string find_udunits_name(const std::string& text, const Dimension& wanted) {
  static const std::map<std::string, std::string> names{
      {"mph", "mile/hour"},   {"kph", "km/hour"},     {"kmh", "km/hour"},     {"kmph", "km/hour"},
      {"kp", "kgf"},          {"lbs", "lb"},          {"lbft", "lbf.ft"},     {"lb-ft", "lbf.ft"},
      {"lb ft", "lbf.ft"},    {"lbf-ft", "lbf.ft"},   {"ftlb", "lbf.ft"},     {"ft-lb", "lbf.ft"},
      {"ft lb", "lbf.ft"},    {"ft-lbf", "lbf.ft"},   {"lbf-in", "lbf.inch"}, {"lb-in", "lbf.inch"},
      {"lbf in", "lbf.inch"}, {"in-lbf", "lbf.inch"}, {"in", "inch"}};
  if (wanted == dimension::kTemperature && (text == "C" || text == "F")) return "deg" + text;
  const auto at = names.find(text);
  return at == names.end() ? text : at->second;
}

using UnitOf = std::unique_ptr<ut_unit, decltype(&ut_free)>;

/// The database of units. It is used by one thread at a time.
class Database {
 public:
  static Database& get() {
    static Database database;
    return database;
  }

  UnitOf parse(const std::string& text) const {
    return {system_ == nullptr ? nullptr : ut_parse(system_, text.c_str(), UT_UTF8), &ut_free};
  }
  UnitOf parse(const Dimension& dimension) const {
    std::string text;
    for (const auto& [symbol, exponent] : {std::pair{"kg", dimension.kg}, std::pair{"m", dimension.m},
                                           std::pair{"s", dimension.s}, std::pair{"K", dimension.K}}) {
      if (exponent != 0) text += fmt::format("{}{}{}", text.empty() ? "" : ".", symbol, exponent);
    }
    return parse(text.empty() ? "1" : text);
  }
  std::mutex& mutex() { return mutex_; }

 private:
  Database() {
    ut_set_error_message_handler(&ut_ignore);
    system_ = ut_read_xml(nullptr);
  }

  ut_system* system_ = nullptr;
  std::mutex mutex_;
};

/// Factor and offset to SI units; none where the two are no straight line of each other.
std::optional<Unit> find_conversion(ut_unit* from, const Unit& wanted, const std::string& symbol) {
  const UnitOf si = Database::get().parse(wanted.dimension);
  if (si == nullptr || ut_are_convertible(from, si.get()) == 0) return std::nullopt;
  const std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(from, si.get()), &cv_free);
  if (converter == nullptr) return std::nullopt;
  const auto convert = [&converter](double value) { return cv_convert_double(converter.get(), value); };
  const double offset = convert(0.0);
  const double factor = convert(1.0) - offset;
  const bool is_line = std::abs(convert(2.0) - offset - 2.0 * factor) <= 1e-9 * std::abs(factor);
  if (!is_line || !(std::abs(factor) > 0.0)) return std::nullopt;
  return Unit{symbol, wanted.dimension, factor, offset};
}

std::string describe_unit(const ut_unit* unit) {
  for (const NamedDimension& named : named_dimensions()) {
    const UnitOf si = Database::get().parse(named.dimension);
    if (si != nullptr && ut_are_convertible(unit, si.get()) != 0) return describe_dimension(named.dimension);
  }
  std::array<char, 128> text{};
  const int length = ut_format(unit, text.data(), text.size(), UT_ASCII | UT_DEFINITION);
  return length > 0 ? fmt::format("quantity in {}", text.data()) : "quantity of another kind";
}

/// "psi" of "psia" and "bar" of "bar (g)"; empty where a text does not say from where a pressure counts.
std::string take_off_zero(const std::string& text) {
  using boost::algorithm::iends_with;
  std::string shorter = text;
  if (!shorter.empty() && shorter.back() == ')') shorter.pop_back();
  for (const std::string reference : {"gauge", "abs.", "abs", "g", "a"}) {
    if (!iends_with(shorter, reference)) continue;
    shorter.resize(shorter.size() - reference.size());
    if (!shorter.empty() && shorter.back() == '(') shorter.pop_back();
    return boost::algorithm::trim_right_copy(shorter);
  }
  return {};
}

/// "psia", "bar(g)": a pressure and from where it counts.
void refuse_pressure_with_zero(const std::string& text) {
  const std::string without_reference = take_off_zero(text);
  if (without_reference.empty()) return;
  const UnitOf base = Database::get().parse(without_reference);
  const UnitOf pressure = Database::get().parse(dimension::kPressure);
  if (base == nullptr || pressure == nullptr || ut_are_convertible(base.get(), pressure.get()) == 0) return;
  throw std::invalid_argument(
      fmt::format("'{}' says of a pressure whether it is gauge or absolute, which a unit does not: unit = \"{}\", and "
                  "for absolute pressure offset = minus the pressure of the air in that unit",
                  text, without_reference));
}

/// A usual name that differs in its case alone.
std::string find_by_case(const std::string& text, const Dimension& dimension) {
  for (const std::string& name : list_unit_names(dimension)) {
    if (boost::algorithm::iequals(name, text)) return name;
  }
  return text;
}

}  // namespace

bool is_known_unit(const std::string& text) {
  const std::string name = boost::algorithm::trim_copy(text);
  if (name.empty() || name.size() > kLongestUnit) return false;
  if (!unit_of_key("value_" + name).symbol.empty()) return true;
  const std::lock_guard<std::mutex> lock(Database::get().mutex());
  return Database::get().parse(find_udunits_name(name, dimension::kTemperature)) != nullptr;
}

std::vector<std::string> list_unit_names(const Dimension& dimension) {
  for (const NamedDimension& named : named_dimensions()) {
    if (named.dimension == dimension) return named.units;
  }
  return {};
}

std::string describe_dimension(const Dimension& dimension) {
  for (const NamedDimension& named : named_dimensions()) {
    if (named.dimension != dimension) continue;
    return dimension.is_dimensionless() ? named.name : fmt::format("{} ({})", named.name, dimension.to_string());
  }
  return fmt::format("quantity in {}", dimension.to_string());
}

Unit parse_unit(const std::string& given, const Unit& wanted) {
  const std::string text = boost::algorithm::trim_copy(given);
  if (text.size() > kLongestUnit) throw std::invalid_argument(fmt::format("'{}' is no unit", shorten(text, 60)));
  const auto of_suffix = [&wanted](const std::string& name) -> std::optional<Unit> {
    Unit unit = unit_of_key("value_" + name);
    if (unit.symbol.empty() || unit.dimension != wanted.dimension) return std::nullopt;
    return unit;
  };
  if (const std::optional<Unit> unit = of_suffix(text)) return *unit;
  const std::lock_guard<std::mutex> lock(Database::get().mutex());
  UnitOf parsed = Database::get().parse(find_udunits_name(text, wanted.dimension));
  if (parsed == nullptr) {
    const std::string name = find_by_case(text, wanted.dimension);
    if (const std::optional<Unit> unit = of_suffix(name)) return *unit;
    parsed = Database::get().parse(find_udunits_name(name, wanted.dimension));
  }
  const std::optional<Unit> unit = parsed == nullptr ? std::nullopt : find_conversion(parsed.get(), wanted, text);
  if (unit.has_value()) return *unit;
  refuse_pressure_with_zero(text);
  if (parsed == nullptr) throw std::invalid_argument(fmt::format("'{}' is no unit that is known", text));
  throw std::invalid_argument(fmt::format("'{}' is a unit of {}, not of {}", text, describe_unit(parsed.get()),
                                          describe_dimension(wanted.dimension)));
}

}  // namespace rollrig
