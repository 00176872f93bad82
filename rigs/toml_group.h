#pragma once
/// Tables of rig and vehicle files as TOML text.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "sim/core/schema.h"

namespace rollrig::rigs {

/// Lines "key = value", and "key_sd = value" where an uncertainty is given.
template <class Group>
std::string write_fields(const Group& group, const Group* uncertainties = nullptr) {
  std::vector<double> sd;
  if (uncertainties != nullptr) {
    Group::visit(*uncertainties, [&sd](const Field&, const double& value) { sd.push_back(value); });
  }
  std::string text;
  std::size_t i = 0;
  Group::visit(group, [&](const Field& field, const double& value) {
    const Unit unit = unit_of_key(field.key);
    text += fmt::format("{} = {:.10g}\n", field.key, unit.from_si(value));
    if (i < sd.size() && sd[i] > 0.0) text += fmt::format("{}_sd = {:.10g}\n", field.key, sd[i] / unit.factor);
    ++i;
  });
  return text;
}

/// The same under the header of a table.
template <class Group>
std::string write_group(const char* name, const Group& group, const Group* uncertainties = nullptr) {
  return fmt::format("\n[{}]\n", name) + write_fields(group, uncertainties);
}

}  // namespace rollrig::rigs
