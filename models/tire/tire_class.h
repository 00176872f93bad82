#pragma once
/// The class of a tire (C1, C2, C3), its service description, and what the test of ISO 28580 asks for by them.

#include <optional>
#include <string>
#include <vector>

#include "sim/core/schema.h"

namespace rollrig::models {

/// Of UN Regulation No. 117, paragraph 2.4: C1 passenger cars; C2 commercial vehicles, load index up to 121 and speed
/// symbol N or higher; C3 the other tires of commercial vehicles.
enum class TireClass { kC1, kC2, kC3 };

const char* name_of(TireClass tire_class);
const std::vector<std::string>& list_tire_classes();
/// Nothing where there is no class of this name.
std::optional<TireClass> find_class_named(const std::string& name);

constexpr int kLowestLoadIndex = 60;
constexpr int kHighestLoadIndex = 179;
constexpr int kHighestLightIndex = 121;  // a higher one is of class C3

/// Load in kg that a tire of this index may carry, single mounting; nothing for an index out of the table.
/// Source    UN Regulation No. 54, Annex 4; half kilograms are rounded down, as there
std::optional<double> find_load_of_index_kg(int load_index);

/// Highest speed of a speed symbol [km/h]; nothing for an unknown symbol.
/// Source    J 100, K 110, M 130, R 170, S 180, T 190, H 210: product sheets of EPREL, the EU's register of labels. The
///           others are of UN Regulations No. 30 and No. 54, second-hand: not read
std::optional<double> find_symbol_speed_km_h(const std::string& symbol);
/// All symbols, from the slowest.
const std::vector<std::string>& list_speed_symbols();

/// [service_description] of a tire file: what the sidewall says of its use.
struct ServiceDescription {
  TireClass tire_class = TireClass::kC1;
  int load_index = 0;        // single mounting
  std::string speed_symbol;  // empty where not said
  bool is_reinforced = false;
  bool is_severe_snow = false;                     // marked with the three-peak mountain with snowflake
  std::optional<double> maximum_load_pressure_Pa;  // gauge, cold, at the load of the index; on the sidewall of C2, C3

  double load_capacity_N() const;
  bool is_heavy() const { return load_index > kHighestLightIndex; }
};

/// What is wrong with a number of the description.
struct ClassMistake {
  const char* key;
  std::string what;
  std::string allowed;
};
/// The first contradiction between class and numbers; nothing where there is none.
std::optional<ClassMistake> find_class_mistake(const ServiceDescription& service);

/// A question about a class that the load index hardly goes with, though no number forbids it: C1 above index 121, or
/// C3 up to index 121 where the speed symbol is not known. Nothing where the index is not known.
/// Source    UN Regulation No. 117, paragraph 2.4: C3 up to index 121 has a speed symbol up to M
/// Checked   tests/models/tire_class_test.cpp
std::optional<std::string> doubt_class_by_index(const ServiceDescription& service);

/// Reads the table. Throws InputError: an unknown class or symbol, an index without a load, and numbers that no tire of
/// the class has: C2 above index 121 or below speed symbol N, C3 up to index 121 from symbol N, C3 without a symbol,
/// C2 or C3 that is reinforced.
ServiceDescription read_service_description(const ConfigTable& table);

/// What the test asks for by class.
/// Source    ISO 28580:2018, clauses 6.2 (speed), 6.3 (load), 6.4 (pressure), 7.2 (soak), 7.4 (warm-up), and UN
///           Regulation No. 117, Annex 6, 3.2 to 4.3. Of these, only the titles of the clauses were read. The figures
///           are second-hand; for class C1 load, pressure, speed, soak and warm-up are those of Kolekar and Narasimhan
///           (2024), §3.2.1 and §3.2.3.1. Read: K_t of UN Regulation No. 117, Annex 6, 6.2
struct IsoTestOfClass {
  double load_N = 0.0;                // 80 % of the load of the index for C1, 85 % for C2 and C3
  std::optional<double> pressure_Pa;  // C1: 210 kPa, reinforced 250 kPa; C2, C3: that of the maximum load, where known
  double speed_m_s = 0.0;             // 80 km/h; C3 above index 121 with symbol J or lower: 60 km/h
  double soak_s = 0.0;                // C1 3 h, C2 and C3 6 h
  double warm_up_s = 0.0;             // C1 30 min; up to index 121 50 min; above 150 min, 180 min with rims of 22.5 in
  double ambient_coefficient_per_K = 0.0;  // K_t: C1 0.008; C2 and C3 up to index 121 0.010; above 0.006
  double highest_skim_load_N = 0.0;        // C1 and C2 200 N, C3 500 N. UN R117, Annex 6; second-hand
};
IsoTestOfClass find_iso_test(const ServiceDescription& service, double rim_diameter_m);

/// Share of the load of the index that the test asks for.
double find_iso_load_share(TireClass tire_class);

}  // namespace rollrig::models
