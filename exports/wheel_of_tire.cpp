#include "exports/wheel_of_tire.h"

#include <fmt/format.h>

#include "models/tire_reference.h"
#include "sim/core/error.h"

namespace rollrig::exports {
namespace {

constexpr double kUsualLoad_N = 4000.0;         // Assumed: of a passenger car's wheel
constexpr double kUsualPressure_Pa = 220000.0;  // Assumed: of its tire

double take_first_positive(double first, double second, double third) {
  if (first > 0.0) return first;
  return second > 0.0 ? second : third;
}

/// Whether an effect changes anything of a wheel alone, which has neither sensors nor a vehicle's body.
bool changes_wheel(const models::Effect& effect, const models::Context<double>& context) {
  const models::EffectInfo& info = effect.info;
  if (!models::acts_in(info, context.machine, context.tire.model())) return false;
  if (info.id == "wind_and_grade") return false;                               // forces on the body
  if (info.id == "inertia_error") return models::is_indoors(context.machine);  // of the machine's moving mass
  if (info.id == "curvature_exponent") return context.tire.model().info.loss_follows_curvature;
  const auto& hooks = effect.hooks<double>();
  return hooks.input != nullptr || hooks.boundary != nullptr || hooks.gas != nullptr || hooks.contact != nullptr ||
         hooks.loss != nullptr || hooks.parasitic != nullptr || hooks.thermal != nullptr;
}

/// Throws InputError for an effect that changes nothing.
void require_changes(const std::vector<models::ActiveEffect>& effects, const models::Context<double>& context) {
  for (const models::ActiveEffect& on : effects) {
    if (changes_wheel(*on.effect, context)) continue;
    std::vector<std::string> allowed;
    for (const models::Effect* other : models::all_effects()) {
      if (changes_wheel(*other, context)) allowed.push_back(other->info.id);
    }
    throw InputError({"the effect changes nothing of this tire on this rig", "", 0, "effects", on.effect->info.id,
                      fmt::format("{}", fmt::join(allowed, ", ")), ""});
  }
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
  require_changes(model.effects, model.context);
  models::require_tire_reference(model.context, model.effects, tire.path);
  model.ambient_pressure_Pa = rig.environment.ambient_pressure_Pa;
  model.ambient_K = model.tire_temperature_K = rig.environment.ambient_K;
  const models::Iso28580Reference test = tire.iso_28580.value_or(models::Iso28580Reference{});
  const auto& law = tire.values.rolling_resistance;
  model.load_N = take_first_positive(test.load_N, law.reference_load_N, kUsualLoad_N);
  model.cold_pressure_Pa = take_first_positive(test.pressure_Pa, law.reference_pressure_Pa, kUsualPressure_Pa);
  return model;
}

}  // namespace rollrig::exports
