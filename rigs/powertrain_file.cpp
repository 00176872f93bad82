#include "rigs/powertrain_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include <boost/algorithm/string/join.hpp>

#include "rigs/toml_group.h"

namespace rollrig::rigs {
namespace {

/// Throws InputError where the values of an axis of a map do not rise.
void require_rising(const TableReader& reader, const char* key, const std::vector<double>& values) {
  const auto falls = std::adjacent_find(values.begin(), values.end(), [](double a, double b) { return b <= a; });
  if (values.size() >= 2 && falls == values.end()) return;
  const Unit unit = unit_of_key(key);
  throw reader.problem(key,
                       values.size() < 2 ? fmt::format("'{}' has {} values", key, values.size())
                                         : fmt::format("'{}' does not rise: {:g} is followed by {:g}", key,
                                                       unit.from_si(*falls), unit.from_si(*(falls + 1))),
                       "two values or more, each above the one before it");
}

/// A row of the map's efficiencies.
std::vector<double> read_efficiencies(const TableReader& reader, const ConfigValue& row, std::size_t columns) {
  const ConfigArray* values = row.as_array();
  if (values == nullptr || values->size() != columns) {
    throw reader.problem("efficiency", "a row of the efficiencies does not have a value for each of powers_kW",
                         fmt::format("rows of {} numbers, [0.85, 0.9, ...]", columns));
  }
  constexpr double kLeast = 0.05;
  std::vector<double> efficiencies;
  for (const ConfigValue& value : *values) {
    const double* number = std::get_if<double>(&value.data);
    if (number == nullptr || !(*number >= kLeast && *number <= 1.0)) {
      throw reader.problem("efficiency", fmt::format("an efficiency of the map is {}", value.text),
                           "numbers >= 0.05 and <= 1");
    }
    efficiencies.push_back(*number);
  }
  return efficiencies;
}

models::PowertrainMap read_powertrain_map(const ConfigTable& table) {
  TableReader reader(table, "[powertrain.map]");
  models::PowertrainMap map;
  map.speeds_m_s = reader.numbers_or({"speeds_km_h", between(0.0, 500.0), "Speed of the vehicle"}, {});
  map.powers_W = reader.numbers_or({"powers_kW", between(-1e5, 1e5), "Power at the hubs; recuperated: negative"}, {});
  require_rising(reader, "speeds_km_h", map.speeds_m_s);
  require_rising(reader, "powers_kW", map.powers_W);
  reader.accept("efficiency");
  const ConfigValue* rows = table.find("efficiency");
  const ConfigArray* list = rows != nullptr ? rows->as_array() : nullptr;
  if (list == nullptr || list->size() != map.speeds_m_s.size()) {
    throw reader.problem("efficiency", "'efficiency' does not have a row for each of speeds_km_h",
                         fmt::format("{} rows of {} numbers", map.speeds_m_s.size(), map.powers_W.size()));
  }
  for (const ConfigValue& row : *list) map.efficiency.push_back(read_efficiencies(reader, row, map.powers_W.size()));
  reader.finish();
  return map;
}

/// The map as TOML.
std::string write_powertrain_map(const models::PowertrainMap& map) {
  const auto list = [](const std::vector<double>& values, const char* key) {
    const Unit unit = unit_of_key(key);
    std::vector<std::string> texts;
    for (const double value : values) texts.push_back(fmt::format("{:.10g}", unit.from_si(value)));
    return "[" + boost::algorithm::join(texts, ", ") + "]";
  };
  std::string text = fmt::format("\n[powertrain.map]\nspeeds_km_h = {}\npowers_kW = {}\nefficiency = [\n",
                                 list(map.speeds_m_s, "speeds_km_h"), list(map.powers_W, "powers_kW"));
  for (const std::vector<double>& row : map.efficiency) text += "  " + list(row, "efficiency") + ",\n";
  return text + "]\n";
}

}  // namespace

void read_powertrain(TableReader& reader, VehiclePowertrain& powertrain) {
  read_fields(reader, powertrain);
  const ConfigTable* map = reader.table("map");
  if (map != nullptr) {
    for (const char* key : {"efficiency", "regeneration_efficiency"}) {
      if (!reader.has(key)) continue;
      throw reader.problem(key, fmt::format("'{}' stands beside [powertrain.map], which has the efficiencies", key),
                           "one of them");
    }
    powertrain.map = read_powertrain_map(*map);
  }
  reader.finish();
}

std::optional<VehicleBattery> read_battery(TableReader& file) {
  const ConfigTable* table = file.table("battery");
  if (table == nullptr) return std::nullopt;
  TableReader reader(*table, "[battery]");
  VehicleBattery battery;
  read_fields(reader, battery);
  if (battery.recharge_J > 0.0 && reader.has("charging_efficiency")) {
    throw reader.problem("charging_efficiency", "'recharge_energy_kWh' is given as well, and decides", "one of them");
  }
  if (battery.recharge_J > 0.0 && battery.recharge_J < battery.usable_J) {
    throw reader.problem("recharge_energy_kWh", "the charge takes less energy than the battery gives",
                         fmt::format("at least the usable energy, {:g}", battery.usable_J / 3.6e6));
  }
  reader.finish();
  return battery;
}

std::string write_powertrain(const VehiclePowertrain& powertrain) {
  if (!powertrain.map.has_value()) return write_group("powertrain", powertrain);
  std::string text = "\n[powertrain]\n";
  VehiclePowertrain::visit(powertrain, [&text](const Field& field, const double& value) {
    const std::string key = field.key;
    if (key == "efficiency" || key == "regeneration_efficiency") return;
    text += fmt::format("{} = {:.10g}\n", key, unit_of_key(key).from_si(value));
  });
  return text + write_powertrain_map(*powertrain.map);
}

}  // namespace rollrig::rigs
