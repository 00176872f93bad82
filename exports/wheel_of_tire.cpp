#include "exports/wheel_of_tire.h"

namespace rollrig::exports {
namespace {

constexpr double kUsualLoad_N = 4000.0;         // Assumed: of a passenger car's wheel
constexpr double kUsualPressure_Pa = 220000.0;  // Assumed: of its tire

double take_first_positive(double first, double second, double third) {
  if (first > 0.0) return first;
  return second > 0.0 ? second : third;
}

}  // namespace

fmu::WheelModel make_wheel_model(const models::TireFile& tire, const rigs::RigFile& rig,
                                 const std::vector<std::string>& effects) {
  fmu::WheelModel model;
  model.tire = tire.name;
  model.context = rigs::make_context(tire, rig, models::Baseline::kCombined);
  ConfigTable asked;
  for (const std::string& id : effects) asked.entries[id] = ConfigValue{ConfigTable{}, {}, ""};
  model.effects = models::read_effects(asked);
  model.ambient_pressure_Pa = rig.environment.ambient_pressure_Pa;
  model.ambient_K = model.tire_temperature_K = rig.environment.ambient_K;
  const models::Iso28580Reference test = tire.iso_28580.value_or(models::Iso28580Reference{});
  const auto& law = tire.values.rolling_resistance;
  model.load_N = take_first_positive(test.load_N, law.reference_load_N, kUsualLoad_N);
  model.cold_pressure_Pa = take_first_positive(test.pressure_Pa, law.reference_pressure_Pa, kUsualPressure_Pa);
  return model;
}

}  // namespace rollrig::exports
