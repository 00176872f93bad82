#include <algorithm>

#include "models/tire/tire_model.h"

namespace rollrig::models {

// Named one by one, since the linker drops objects of a static library that nothing refers to.
#define ROLLRIG_TIRE_MODEL(id) const TireModel& tire_model_##id();
#include "models/tire/tire_models.def"
#undef ROLLRIG_TIRE_MODEL

const std::vector<const TireModel*>& all_tire_models() {
  static const std::vector<const TireModel*> models{
#define ROLLRIG_TIRE_MODEL(id) &tire_model_##id(),
#include "models/tire/tire_models.def"
#undef ROLLRIG_TIRE_MODEL
  };
  return models;
}

const TireModel& default_tire_model() { return *all_tire_models().front(); }
const std::string& id_of(const TireModel& model) { return model.info.id; }
const std::vector<TireModelParameter>& own_parameters_of(const TireModel& model) { return model.info.parameters; }

bool TireModelInfo::uses(const std::string& table) const {
  const std::string name = table.rfind("load_map", 0) == 0 ? "rolling_resistance" : table;
  return name == id || std::find(tables.begin(), tables.end(), name) != tables.end();
}

}  // namespace rollrig::models
