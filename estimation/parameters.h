#pragma once
/// Parameters of a context by name, in any scalar: what a fit moves.

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "models/ports.h"

namespace rollrig::estimation {

/// A number that a fit may move.
struct FreeParameter {
  std::string
      key;  // "tire.rolling_resistance.A0_N", "parasitic.c0_N", "vehicle.mass_kg", "tire.load_map.0.B0_per_degC"
  double start_SI = 0.0;
  double prior_sd_SI = 0.0;  // 0: no prior; else normal around start_SI
  double lower_SI = -std::numeric_limits<double>::infinity();
};

/// The member of a context that a key names. Throws std::invalid_argument for an unknown key.
template <class S>
S& find_parameter(models::Context<S>& context, const std::string& key) {
  S* found = nullptr;
  const auto match = [&](const std::string& candidate, S& member) {
    if (candidate == key) found = &member;
  };
  models::TireParameters<S>::visit_all(context.tire, [&](const char* table, const Field& field, S& member) {
    match(std::string("tire.") + table + "." + field.key, member);
  });
  models::ParasiticParameters<S>::visit(
      context.parasitic, [&](const Field& field, S& member) { match(std::string("parasitic.") + field.key, member); });
  models::VehicleBody<S>::visit(
      context.vehicle, [&](const Field& field, S& member) { match(std::string("vehicle.") + field.key, member); });
  for (std::size_t i = 0; i < context.tire.load_map.size(); ++i) {
    models::LoadMapEntry<S>::visit(context.tire.load_map[i], [&](const Field& field, S& member) {
      match("tire.load_map." + std::to_string(i) + "." + field.key, member);
    });
  }
  if (found == nullptr) throw std::invalid_argument("no parameter '" + key + "'");
  return *found;
}

}  // namespace rollrig::estimation
