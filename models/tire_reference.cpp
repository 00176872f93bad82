#include "models/tire_reference.h"

#include <fmt/format.h>

#include <set>

#include "sim/core/error.h"

namespace rollrig::models {

bool uses_tire_reference(const Effect& effect) {
  static const std::set<std::string> ids{"cavity_volume", "cell_air_warming",  "load_cross_talk",  "load_exponent",
                                         "load_record",   "pressure_exponent", "pressure_record",  "rubber_memory",
                                         "standing_wave", "surface_warming",   "tire_temperature", "toe_camber_drag"};
  return ids.count(effect.info.id) > 0;
}

void require_tire_reference(const Context<double>& context, const std::vector<ActiveEffect>& effects,
                            const std::string& tire_path) {
  if (context.tire.rolling_resistance.reference_load_N > 0.0) return;
  for (const ActiveEffect& on : effects) {
    const EffectInfo& info = on.effect->info;
    if (!uses_tire_reference(*on.effect) || !acts_in(info, context.machine, context.tire.model())) continue;
    throw InputError({fmt::format("the effect {} needs the table [rolling_resistance] of the tire", info.id), tire_path,
                      0, "effects", info.id, "a tire file with reference_load_N and reference_pressure_kPa", ""});
  }
}

}  // namespace rollrig::models
