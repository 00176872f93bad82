#include "scenarios/common/vehicle_conditions.h"

#include <fmt/format.h>

#include "models/vehicle/vehicle.h"
#include "models/wheel/rolling_wheel.h"
#include "scenarios/common/iso_coefficient.h"
#include "scenarios/common/least_damping.h"
#include "scenarios/common/recorded_inputs.h"

namespace rollrig::scenarios {
namespace {

/// Where the wheels' own inertia is above what the vehicle says of all that turns, one of the two is wrong; likewise
/// where they weigh more than they bear.
void check_wheels(const RunSpec& spec) {
  const rigs::VehicleFile& vehicle = *spec.vehicle;
  double wheels_kg = 0.0;
  for (const rigs::VehicleAxle& axle : vehicle.axles) {
    const models::TireParameters<double>& tire = rigs::tire_of(axle, spec.tire).values;
    rigs::name_wheels(vehicle, axle);  // throws where the rigs have no place for them
    const double load_N = axle.load_share * vehicle.body.mass_kg * kStandardGravity_m_s2 / axle.wheels;
    wheels_kg += axle.wheels * models::calc_spin_mass_kg(tire, calc_loaded_radius_m(tire, load_N));
    const double unsprung_N = rigs::calc_unsprung_N(axle.suspension, tire);
    if (load_N > unsprung_N) continue;
    throw InputError({fmt::format("a wheel of axle '{}' weighs {:.0f} N with its unsprung parts and bears {:.0f} N",
                                  axle.name, unsprung_N, load_N),
                      vehicle.path, 0, "load_share", fmt::format("{}", axle.load_share),
                      "a larger share, or a smaller unsprung_mass_kg", ""});
  }
  if (vehicle.body.rotating_mass_kg >= wheels_kg) return;
  throw InputError(
      {fmt::format("the {} wheels alone have an equivalent mass of {:.1f} kg", vehicle.count_wheels(), wheels_kg),
       vehicle.path, 0, "rotating_mass_kg", fmt::format("{}", vehicle.body.rotating_mass_kg),
       fmt::format("at least {:.1f} kg, or a smaller spin_inertia_kg_m2 of the tire", wheels_kg), ""});
}

/// See require_damping(): for each wheel, its part of the sprung mass on its suspension.
void check_damping(const RunSpec& spec) {
  if (spec.fidelity != Fidelity::kMultibody) return;
  const rigs::VehicleFile& vehicle = *spec.vehicle;
  for (const rigs::VehicleAxle& axle : vehicle.axles) {
    const double load_N = axle.load_share * vehicle.body.mass_kg * kStandardGravity_m_s2 / axle.wheels;
    const double unsprung_N = rigs::calc_unsprung_N(axle.suspension, rigs::tire_of(axle, spec.tire).values);
    require_damping({fmt::format("the suspension of axle '{}'", axle.name), "the vehicle would bounce", vehicle.path,
                     axle.suspension.damping_N_s_per_m, axle.suspension.stiffness_N_per_m,
                     (load_N - unsprung_N) / kStandardGravity_m_s2});
  }
}

/// A setting that changes nothing here is a mistake.
void check_settings_say_something(const RunSpec& spec) {
  if (is_on_road(spec.rig.kind->traits)) {
    for (const char* key : {"set_A_N", "set_B_N_per_km_h", "set_C_N_per_km_h2"}) {
      if (spec.settings.find(key) == nullptr) continue;
      throw InputError(
          setting_problem(spec, key, "a road has no rollers whose force could be set", "a rig of kind \"dyno\""));
    }
  }
}

}  // namespace

void VehicleConditions::complete(const RunSpec& spec) {
  check_settings_say_something(spec);
  check_rest(spec, tire_state.value == "warm", rest_before_s);
  if (wheels != 1 && wheels != 4) {
    throw InputError(setting_problem(spec, "wheels", "a vehicle is simulated whole or by one wheel", "4 or 1"));
  }
  if (!wheel_of.value.empty() && wheels == 4 && spec.settings.find("wheels") != nullptr) {
    throw InputError(
        setting_problem(spec, "wheels", "one wheel of an axle is asked for as well", "wheel_of or wheels = 4"));
  }
  if (!wheel_of.value.empty()) wheels = 1;
  if (wheels == 1) wheel_of.value = spec.vehicle->axles[find_axle(spec)].name;
  check_wheels(spec);
  check_damping(spec);
  if (!ambient_K.has_value()) ambient_K = spec.rig.environment.ambient_K;
  if (!initial_tire_K.has_value()) initial_tire_K = ambient_K;
  const models::RoadLoad<double> by_default = find_default_set_load(spec);
  if (!set_A_N.has_value()) set_A_N = by_default.A_N;
  if (!set_B_N_s_per_m.has_value()) set_B_N_s_per_m = by_default.B_N_s_per_m;
  if (!set_C_N_s2_per_m2.has_value()) set_C_N_s2_per_m2 = by_default.C_N_s2_per_m2;
}

std::size_t VehicleConditions::find_axle(const RunSpec& spec) {
  const std::vector<rigs::VehicleAxle>& axles = spec.vehicle->axles;
  const char* key = spec.settings.find("quarter") != nullptr ? "quarter" : "wheel_of";
  const ConfigValue* given = spec.settings.find(key);
  const std::string name = given != nullptr ? std::get<std::string>(given->data) : axles.front().name;
  std::vector<std::string> rolling;
  for (std::size_t i = 0; i < axles.size(); ++i) {
    if (!rigs::rolls(axles[i], spec.rig)) continue;
    if (axles[i].name == name) return i;
    rolling.push_back(axles[i].name);
  }
  throw InputError(setting_problem(
      spec, key, fmt::format("no axle '{}' of vehicle '{}' rolls on rig '{}'", name, spec.vehicle->name, spec.rig.name),
      fmt::format("{}", fmt::join(rolling, ", "))));
}

models::RoadLoad<double> VehicleConditions::find_default_set_load(const RunSpec& spec) {
  constexpr double kReference_K = kZeroCelsius_K + 20.0;  // 40 CFR 1066.305
  constexpr double kReference_Pa = 98.21e3;               // likewise
  if (spec.vehicle->road_load.has_value()) {
    models::RoadLoad<double> load = *spec.vehicle->road_load;
    double rrc = 0.0;
    for (const rigs::VehicleAxle& axle : spec.vehicle->axles) {
      const models::TireFile& tire = rigs::tire_of(axle, spec.tire);
      rrc += axle.load_share * calc_true_iso_rrc(tire, spec.baseline).value_or(0.0);
    }
    load.A_N -= rrc * spec.vehicle->body.mass_kg * kStandardGravity_m_s2;
    return load;
  }
  const double density_kg_per_m3 = models::calc_air_density_kg_per_m3(kReference_Pa, kReference_K);
  return {0.0, 0.0, models::calc_drag_N(density_kg_per_m3, spec.vehicle->body.drag_area_m2, 1.0, 0.0)};
}

rigs::VehicleLayout VehicleConditions::make_layout(const RunSpec& spec) const {
  const models::RoadLoad<double> set_load{*set_A_N, *set_B_N_s_per_m, *set_C_N_s2_per_m2};
  if (wheels == 4) return rigs::make_whole_vehicle(*spec.vehicle, spec.rig, *ambient_K, set_load);
  return rigs::make_one_wheel(*spec.vehicle, spec.rig, *ambient_K, set_load, find_axle(spec));
}

}  // namespace rollrig::scenarios
