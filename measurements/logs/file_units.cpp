#include "measurements/logs/file_units.h"

#include <cmath>
#include <map>

#include <fmt/format.h>
#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/replace.hpp>

namespace rollrig::measurements {
namespace {

bool is_same(const Unit& a, const Unit& b) {
  constexpr double kSame = 1e-9;
  return a.dimension == b.dimension && std::abs(a.factor - b.factor) <= kSame * std::abs(b.factor) &&
         std::abs(a.offset_SI - b.offset_SI) <= kSame * std::abs(b.offset_SI);
}

}  // namespace

std::optional<Unit> find_logged_unit(const std::string& text) {
  static const std::map<std::string, std::string> kSpellings{{"\u00b0C", "degC"},
                                                             {"\xb0"
                                                              "C",
                                                              "degC"},
                                                             {"C", "degC"},
                                                             {"kph", "km_h"},
                                                             {"kmh", "km_h"},
                                                             {"sec", "s"},
                                                             {"N*m", "Nm"},
                                                             {"N-m", "Nm"},
                                                             {"N.m", "Nm"},
                                                             {"%", "percent"}};
  std::string name = boost::algorithm::erase_all_copy(text, " ");
  if (const auto spelling = kSpellings.find(name); spelling != kSpellings.end()) name = spelling->second;
  boost::algorithm::replace_all(name, "/", "_");
  const Unit unit = unit_of_key("value_" + name);
  return unit.symbol.empty() ? std::nullopt : std::optional(unit);
}

void require_units(const LogForm& form, const tables::LogTable& table) {
  for (const LogColumn& column : form.columns) {
    if (table.not_read.count(column.column) > 0) {
      throw InputError({fmt::format("'{}' is an array, a text, or has a conversion that is not linear", column.column),
                        table.rows.path(), 0, column.column, "", "a channel of numbers", ""});
    }
    const auto said = table.units.find(column.column);
    if (said == table.units.end() || column.factor != 1.0 || column.offset != 0.0) continue;
    const std::optional<Unit> unit = find_logged_unit(said->second);
    if (!unit.has_value() || is_same(*unit, column.unit)) continue;
    throw InputError({fmt::format("'{}' is in {} by the file, and in {} by the mapping", column.column, said->second,
                                  column.unit.symbol),
                      table.rows.path(), 0, column.column, said->second,
                      fmt::format("the unit in [{}.columns], or factor and offset there", form.name), ""});
  }
}

}  // namespace rollrig::measurements
