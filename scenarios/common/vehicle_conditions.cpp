#include "scenarios/common/vehicle_conditions.h"

#include "models/vehicle/vehicle.h"
#include "models/wheel/rolling_wheel.h"
#include "scenarios/common/recorded_inputs.h"

namespace rollrig::scenarios {
namespace {

/// Where the wheels' own inertia is above what the vehicle says of all that turns, one of the two is wrong.
void check_rotating_mass(const RunSpec& spec) {
  const double weight_N = spec.vehicle->body.mass_kg * kStandardGravity_m_s2;
  double wheels_kg = 0.0;
  for (const double share : {spec.vehicle->geometry.front_load_share, 1.0 - spec.vehicle->geometry.front_load_share}) {
    const double loaded_radius_m = calc_loaded_radius_m(spec.tire.values, 0.5 * share * weight_N);
    wheels_kg += 2.0 * models::calc_spin_mass_kg(spec.tire.values, loaded_radius_m);
  }
  if (spec.vehicle->body.rotating_mass_kg >= wheels_kg) return;
  throw InputError({fmt::format("the four wheels of tire '{}' alone have an equivalent mass of {:.1f} kg",
                                spec.tire.name, wheels_kg),
                    spec.vehicle->path, 0, "rotating_mass_kg", fmt::format("{}", spec.vehicle->body.rotating_mass_kg),
                    fmt::format("at least {:.1f} kg, or a smaller spin_inertia_kg_m2 of the tire", wheels_kg), ""});
}

/// A file may describe a vehicle with any number of tires; the rigs here have a place for four.
void check_tires(const RunSpec& spec) {
  if (spec.vehicle->tires == 4) return;
  throw InputError(
      {fmt::format("vehicle '{}' has {} tires, the rigs take four", spec.vehicle->name, spec.vehicle->tires),
       spec.vehicle->path, 0, "tires", fmt::format("{}", spec.vehicle->tires), "4", ""});
}

/// A setting that changes nothing here is a mistake.
void check_settings_say_something(const RunSpec& spec, int wheels) {
  if (is_on_road(spec.rig.kind->traits)) {
    for (const char* key : {"set_A_N", "set_B_N_per_km_h", "set_C_N_per_km_h2"}) {
      if (spec.settings.find(key) == nullptr) continue;
      throw InputError(
          setting_problem(spec, key, "a road has no rollers whose force could be set", "a rig of kind \"dyno\""));
    }
  }
  if (wheels == 4 && spec.settings.find("quarter") != nullptr) {
    throw InputError(setting_problem(spec, "quarter", "the whole vehicle is simulated", "wheels = 1 beside it"));
  }
}

}  // namespace

void VehicleConditions::complete(const RunSpec& spec) {
  check_settings_say_something(spec, wheels);
  check_rest(spec, tire_state.value == "warm", rest_before_s);
  if (wheels != 1 && wheels != 4) {
    throw InputError(setting_problem(spec, "wheels", "a vehicle is simulated whole or as a quarter", "4 or 1"));
  }
  if (wheels == 1 && !rigs::rolls(*spec.vehicle, spec.rig, quarter.value == "front")) {
    throw InputError(setting_problem(spec, "quarter",
                                     fmt::format("rig '{}' has rollers under the driven wheels alone", spec.rig.name),
                                     fmt::format("\"{}\"", rigs::name_of(spec.vehicle->driven_axle))));
  }
  check_tires(spec);
  check_rotating_mass(spec);
  if (!ambient_K.has_value()) ambient_K = spec.rig.environment.ambient_K;
  if (!initial_tire_K.has_value()) initial_tire_K = ambient_K;
  const models::RoadLoad<double> by_default = find_default_set_load(spec);
  if (!set_A_N.has_value()) set_A_N = by_default.A_N;
  if (!set_B_N_s_per_m.has_value()) set_B_N_s_per_m = by_default.B_N_s_per_m;
  if (!set_C_N_s2_per_m2.has_value()) set_C_N_s2_per_m2 = by_default.C_N_s2_per_m2;
}

models::RoadLoad<double> VehicleConditions::find_default_set_load(const RunSpec& spec) {
  constexpr double kReference_K = kZeroCelsius_K + 20.0;  // 40 CFR 1066.305
  constexpr double kReference_Pa = 98.21e3;               // likewise
  if (spec.vehicle->road_load.has_value()) {
    models::RoadLoad<double> load = *spec.vehicle->road_load;
    if (spec.tire.iso_28580.has_value()) {
      load.A_N -= spec.tire.iso_28580->rrc * spec.vehicle->body.mass_kg * kStandardGravity_m_s2;
    }
    return load;
  }
  const double density_kg_per_m3 = models::calc_air_density_kg_per_m3(kReference_Pa, kReference_K);
  return {0.0, 0.0, models::calc_drag_N(density_kg_per_m3, spec.vehicle->body.drag_area_m2, 1.0, 0.0)};
}

rigs::VehicleLayout VehicleConditions::make_layout(const RunSpec& spec) const {
  const models::RoadLoad<double> set_load{*set_A_N, *set_B_N_s_per_m, *set_C_N_s2_per_m2};
  if (wheels == 4) return rigs::make_four_wheels(*spec.vehicle, spec.rig, *ambient_K, set_load);
  const auto wheel = quarter.value == "front" ? rigs::QuarterWheel::kFront : rigs::QuarterWheel::kRear;
  return rigs::make_quarter(*spec.vehicle, spec.rig, *ambient_K, set_load, wheel);
}

}  // namespace rollrig::scenarios
