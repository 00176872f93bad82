#pragma once
/// Parameters of a context by name, in any scalar: what a fit moves.

#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "models/ports.h"

namespace rollrig::estimation {

/// A number that a fit may move.
struct FreeParameter {
  /// As JSON output names it: "tire.rolling_resistance.A0_N", "parasitic.c0_N", "vehicle.mass_kg",
  /// "tire.load_map.0.B0_per_degC", "tire.thermal.z_W_per_K" (Field::output_key).
  std::string key;
  double start_SI = 0.0;
  double prior_sd_SI = 0.0;  // 0: no prior; else normal around start_SI
  double lower_SI = -std::numeric_limits<double>::infinity();
  double upper_SI = std::numeric_limits<double>::infinity();
  std::map<std::string, double> prior_correlations{};  // with other parameters that have a prior, by key
};

/// Calls visit(table, field, member) for every number of a context that a fit may move; of the tire's tables the name
/// is "tire.<table>".
template <class S, class Visit>
void visit_parameters(models::Context<S>& context, Visit&& visit) {
  const auto in_table = [&visit](const std::string& table) {
    return [&visit, table](const Field& field, S& member) { visit(table, field, member); };
  };
  models::TireParameters<S>::visit_all(context.tire, [&](const std::string& table, const Field& field, S& member) {
    visit("tire." + table, field, member);
  });
  models::ParasiticParameters<S>::visit(context.parasitic, in_table("parasitic"));
  models::VehicleBody<S>::visit(context.vehicle, in_table("vehicle"));
}

/// The member of a context that a key names. Throws std::invalid_argument for an unknown key.
template <class S>
S& find_parameter(models::Context<S>& context, const std::string& key) {
  S* found = nullptr;
  visit_parameters(context, [&](const std::string& table, const Field& field, S& member) {
    // As key == table + "." + output_key, without making a string each time.
    const std::size_t dot = table.size();
    const bool is_named = key.size() > dot && key[dot] == '.' && key.compare(0, dot, table) == 0 &&
                          key.compare(dot + 1, std::string::npos, field.output_key()) == 0;
    if (is_named) found = &member;
  });
  if (found == nullptr) throw std::invalid_argument("no parameter '" + key + "'");
  return *found;
}

/// The key as a person knows it: as files of the newest format have it, without "tire.".
inline std::string find_file_key(const std::string& key) {
  std::string found = key;
  models::Context<double> any;
  visit_parameters(any, [&](const std::string& table, const Field& field, double&) {
    if (key == table + "." + field.output_key()) found = table + "." + field.key;
  });
  return found.rfind("tire.", 0) == 0 ? found.substr(5) : found;
}

}  // namespace rollrig::estimation
