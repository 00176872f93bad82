#include "comparison/tire_document.h"

namespace rollrig::comparison {

Json make_tire_document(const models::TireFile& tire) {
  Json json = {{"name", tire.name}, {"designation", tire.designation}, {"model", id_of(tire.values.model())}};
  models::TireParameters<double>::visit_all(tire.values,
                                            [&json](const std::string& table, const Field& field, const double& value) {
                                              json[table][field.key] = unit_of_key(field.key).from_si(value);
                                            });
  return json;
}

}  // namespace rollrig::comparison
