#include "models/tire/tire_class.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "models/tire/conversion_laws.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::models {
namespace {

constexpr int kDecade = 80;  // indices over which the load rises tenfold

/// Loads of the indices 60 to 139 in kg. Those of 140 to 219 are ten times as large, and these are rounded down.
constexpr std::array<double, kDecade> kLoads_kg{
    250.0,  257.5,  265.0,  272.5,  280.0,  290.0,  300.0,  307.5,  315.0,  325.0,  335.0,  345.0,  355.0,  365.0,
    375.0,  387.5,  400.0,  412.5,  425.0,  437.5,  450.0,  462.5,  475.0,  487.5,  500.0,  515.0,  530.0,  545.0,
    560.0,  580.0,  600.0,  615.0,  630.0,  650.0,  670.0,  690.0,  710.0,  730.0,  750.0,  775.0,  800.0,  825.0,
    850.0,  875.0,  900.0,  925.0,  950.0,  975.0,  1000.0, 1030.0, 1060.0, 1090.0, 1120.0, 1150.0, 1180.0, 1215.0,
    1250.0, 1285.0, 1320.0, 1360.0, 1400.0, 1450.0, 1500.0, 1550.0, 1600.0, 1650.0, 1700.0, 1750.0, 1800.0, 1850.0,
    1900.0, 1950.0, 2000.0, 2060.0, 2120.0, 2180.0, 2240.0, 2300.0, 2360.0, 2430.0};

const std::vector<std::pair<std::string, double>>& symbol_speeds_km_h() {
  static const std::vector<std::pair<std::string, double>> all{
      {"B", 50.0},  {"C", 60.0},  {"D", 65.0},  {"E", 70.0},  {"F", 80.0},  {"G", 90.0},  {"J", 100.0},
      {"K", 110.0}, {"L", 120.0}, {"M", 130.0}, {"N", 140.0}, {"P", 150.0}, {"Q", 160.0}, {"R", 170.0},
      {"S", 180.0}, {"T", 190.0}, {"U", 200.0}, {"H", 210.0}, {"V", 240.0}, {"W", 270.0}, {"Y", 300.0}};
  return all;
}

constexpr double kSymbolN_km_h = 140.0;
constexpr double kSymbolJ_km_h = 100.0;

/// The symbol, in capitals. Throws InputError where it is unknown.
std::string read_symbol(TableReader& reader) {
  std::string symbol = reader.text_or("speed_symbol", "");
  if (symbol.empty()) return symbol;
  std::transform(symbol.begin(), symbol.end(), symbol.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (find_symbol_speed_km_h(symbol).has_value()) return symbol;
  throw reader.problem("speed_symbol", fmt::format("'{}' is not a speed symbol", symbol),
                       fmt::format("one of {}", fmt::join(list_speed_symbols(), " ")));
}

}  // namespace

const char* name_of(TireClass tire_class) {
  return tire_class == TireClass::kC1 ? "C1" : (tire_class == TireClass::kC2 ? "C2" : "C3");
}

const std::vector<std::string>& list_tire_classes() {
  static const std::vector<std::string> names{"C1", "C2", "C3"};
  return names;
}

std::optional<TireClass> find_class_named(const std::string& name) {
  for (const TireClass one : {TireClass::kC1, TireClass::kC2, TireClass::kC3}) {
    if (name == name_of(one)) return one;
  }
  return std::nullopt;
}

std::optional<double> find_load_of_index_kg(int load_index) {
  if (load_index < kLowestLoadIndex || load_index > kHighestLoadIndex) return std::nullopt;
  const int place = load_index - kLowestLoadIndex;
  return place < kDecade ? std::floor(kLoads_kg[static_cast<std::size_t>(place)])
                         : 10.0 * kLoads_kg[static_cast<std::size_t>(place - kDecade)];
}

std::optional<double> find_symbol_speed_km_h(const std::string& symbol) {
  for (const auto& [name, speed_km_h] : symbol_speeds_km_h()) {
    if (name == symbol) return speed_km_h;
  }
  return std::nullopt;
}

const std::vector<std::string>& list_speed_symbols() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, speed_km_h] : symbol_speeds_km_h()) all.push_back(name);
    return all;
  }();
  return names;
}

double ServiceDescription::load_capacity_N() const {
  return find_load_of_index_kg(load_index).value_or(0.0) * kStandardGravity_m_s2;
}

std::optional<ClassMistake> find_class_mistake(const ServiceDescription& service) {
  const TireClass tire_class = service.tire_class;
  const auto speed_km_h = find_symbol_speed_km_h(service.speed_symbol);
  if (tire_class != TireClass::kC1 && service.is_reinforced) {
    return ClassMistake{"reinforced",
                        fmt::format("a tire of class {} is not marked as reinforced", name_of(tire_class)),
                        "reinforced = false, or class \"C1\""};
  }
  if (tire_class == TireClass::kC2 && service.is_heavy()) {
    return ClassMistake{"load_index",
                        fmt::format("a tire with load index {} is of class C3, not C2", service.load_index),
                        fmt::format("{} to {} for class C2, or class \"C3\"", kLowestLoadIndex, kHighestLightIndex)};
  }
  if (tire_class == TireClass::kC2 && speed_km_h.has_value() && *speed_km_h < kSymbolN_km_h) {
    return ClassMistake{
        "speed_symbol",
        fmt::format("a tire of commercial vehicles with speed symbol {} is of class C3, not C2", service.speed_symbol),
        "N or a higher symbol for class C2, or class \"C3\""};
  }
  if (tire_class != TireClass::kC3) return std::nullopt;
  if (!speed_km_h.has_value()) {
    return ClassMistake{"speed_symbol",
                        "missing key: the speed of the test of a tire of class C3 follows from its speed symbol",
                        fmt::format("one of {}", fmt::join(list_speed_symbols(), " "))};
  }
  if (service.is_heavy() || *speed_km_h < kSymbolN_km_h) return std::nullopt;
  return ClassMistake{"class",
                      fmt::format("a tire with load index {} and speed symbol {} is of class C1 or C2, not C3",
                                  service.load_index, service.speed_symbol),
                      "class \"C1\" of passenger cars, class \"C2\" of commercial vehicles, a load index from 122, or "
                      "a speed symbol up to M"};
}

std::optional<std::string> doubt_class_by_index(const ServiceDescription& service) {
  if (service.load_index == 0) return std::nullopt;
  if (service.tire_class == TireClass::kC1 && service.is_heavy()) {
    return fmt::format("class C1: a tire with load index {} is of class C3, unless it is of a passenger car",
                       service.load_index);
  }
  if (service.tire_class != TireClass::kC3 || service.is_heavy() || !service.speed_symbol.empty()) return std::nullopt;
  return fmt::format(
      "class C3: a tire with load index {} is of class C1 or C2, unless its speed symbol is M or a lower one. Class C3 "
      "begins at load index {}: give the speed symbol",
      service.load_index, kHighestLightIndex + 1);
}

ServiceDescription read_service_description(const ConfigTable& table) {
  TableReader reader(table, "[service_description]");
  ServiceDescription service;
  service.tire_class = *find_class_named(reader.text("class", list_tire_classes()));
  service.load_index = reader.count(
      {"load_index", between(static_cast<double>(kLowestLoadIndex), static_cast<double>(kHighestLoadIndex)), ""});
  service.speed_symbol = read_symbol(reader);
  service.is_reinforced = reader.flag_or("reinforced", false);
  service.is_severe_snow = reader.flag_or("severe_snow", false);
  service.maximum_load_pressure_Pa = reader.number_or_none({"maximum_load_pressure_kPa", between(100.0, 1200.0), ""});
  reader.finish();
  if (const auto mistake = find_class_mistake(service)) {
    throw reader.problem(mistake->key, mistake->what, mistake->allowed);
  }
  return service;
}

double find_iso_load_share(TireClass tire_class) { return tire_class == TireClass::kC1 ? 0.80 : 0.85; }

IsoTestOfClass find_iso_test(const ServiceDescription& service, double rim_diameter_m) {
  constexpr double kMinute_s = 60.0;
  constexpr double kHour_s = 3600.0;
  constexpr double kLargeRim_m = 0.571;  // 22.5 inches
  const bool is_car = service.tire_class == TireClass::kC1;
  const bool is_heavy = service.tire_class == TireClass::kC3 && service.is_heavy();
  IsoTestOfClass test;
  test.load_N = find_iso_load_share(service.tire_class) * service.load_capacity_N();
  test.pressure_Pa = service.maximum_load_pressure_Pa;
  if (is_car) test.pressure_Pa = service.is_reinforced ? 250e3 : 210e3;
  const double symbol_km_h = find_symbol_speed_km_h(service.speed_symbol).value_or(kSymbolN_km_h);
  test.speed_m_s = (is_heavy && symbol_km_h <= kSymbolJ_km_h ? 60.0 : 80.0) / kKmhPerMs;
  test.soak_s = (is_car ? 3.0 : 6.0) * kHour_s;
  test.warm_up_s = (is_car ? 30.0 : 50.0) * kMinute_s;
  if (is_heavy) test.warm_up_s = (rim_diameter_m > kLargeRim_m ? 180.0 : 150.0) * kMinute_s;
  test.ambient_coefficient_per_K = kAmbientCoefficient_per_K;
  if (!is_car) test.ambient_coefficient_per_K = is_heavy ? 0.006 : 0.010;
  test.highest_skim_load_N = service.tire_class == TireClass::kC3 ? 500.0 : 200.0;
  return test;
}

}  // namespace rollrig::models
