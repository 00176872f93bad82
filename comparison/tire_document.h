#pragma once
/// Numbers of files as JSON, in the units of their keys.

#include "models/tire/tire_file.h"
#include "sim/core/json.h"

namespace rollrig::comparison {

/// Numbers of a table with a visit().
template <class Parameters>
Json make_number_document(const Parameters& parameters) {
  Json json = Json::object();
  Parameters::visit(parameters, [&json](const Field& field, const double& value) {
    json[field.key] = unit_of_key(field.key).from_si(value);
  });
  return json;
}

/// Name, designation, model and all numbers of a tire.
Json make_tire_document(const models::TireFile& tire);

}  // namespace rollrig::comparison
