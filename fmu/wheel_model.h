#pragma once
/// What a warm wheel is made of: the numbers of its tire, of the surface under it, of effects, and how it starts.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "models/corner.h"

namespace rollrig::fmu {

constexpr double kHighestSpeed_m_s = 150.0;  // Assumed: beyond every rig and road
constexpr double kShortestStep_s = 1e-4;     // of the integrator

struct WheelModel {
  std::string tire;  // its name
  models::Context<double> context;
  std::vector<models::ActiveEffect> effects;
  double ambient_pressure_Pa = kStandardAtmosphere_Pa;  // absolute
  double tire_temperature_K = 0.0;                      // at the start, of all its nodes
  double cold_pressure_Pa = 0.0;                        // gauge, at that temperature
  double load_N = 0.0;                                  // start value of the input
  double ambient_K = 0.0;                               // start value of both temperature inputs
  double longest_step_s = 1.0;  // of the integrator. Assumed: as of a vehicle's drive whose speed changes

  /// Whether the number of that name changes anything of the wheel: the law of the tire or an effect uses it.
  bool uses(std::string_view name) const;

  /// Calls visit(name, field, member) for each number that the wheel uses.
  template <class Self, class Visit>
  static void visit_used(Self& m, Visit&& visit_one) {
    visit(m, [&](const std::string& name, const Field& field, auto& member) {
      if (m.uses(name)) visit_one(name, field, member);
    });
  }

  /// Calls visit(name, field, member) for every number, in SI units. Tables and keys are those of files:
  /// "thermal.heat_capacity_J_per_K", "effects.bearing_warmup.fall_per_K".
  template <class Self, class Visit>
  static void visit(Self& m, Visit&& visit) {
    const auto in_table = [&visit](const std::string& table) {
      return [&visit, table](const Field& field, auto& member) { visit(table + "." + field.key, field, member); };
    };
    models::TireParameters<double>::visit_all(m.context.tire, [&](const std::string& table, const Field& field,
                                                                  auto& member) { in_table(table)(field, member); });
    models::ParasiticParameters<double>::visit(m.context.parasitic, in_table("parasitic"));
    const auto of_rig = in_table("rig");
    of_rig(Field{"surface_curvature_per_m", between(0.0, 100.0), "1/R of drum or roller; 0 of a plane"},
           m.context.surface_curvature_per_m);
    of_rig(Field{"machine_radius_m", non_negative(),
                 "Radius of the drum or roller: torque at its axis divided by the force at its surface"},
           m.context.machine_radius_m);
    of_rig(Field{"moving_mass_kg", non_negative(), "Inertia of drum, belt or roller as mass at its surface"},
           m.context.machine_mass_kg);
    of_rig(Field{"skim_load_N", non_negative(), "Load of the skim test"}, m.context.skim_load_N);
    of_rig(Field{"ambient_pressure_kPa", between(50.0, 110.0), "Absolute pressure of the air"}, m.ambient_pressure_Pa);
    const auto of_start = in_table("start");
    of_start(Field{"tire_temperature_degC", between(-80.0, 250.0), "Temperature of the tire at the start"},
             m.tire_temperature_K);
    of_start(Field{"cold_pressure_kPa", between(1.0, 10000.0), "Gauge pressure at that temperature"},
             m.cold_pressure_Pa);
    in_table("steps")(
        Field{"longest_s", between(kShortestStep_s, 10.0), "Longest step of the integrator in co-simulation"},
        m.longest_step_s);
    for (auto& on : m.effects) {
      const auto& declared = on.effect->info.parameters;
      for (std::size_t i = 0; i < declared.size(); ++i) {
        in_table("effects." + on.effect->info.id)(Field{declared[i].key, declared[i].range, declared[i].doc},
                                                  on.parameters[i]);
      }
    }
  }
};

/// FNV-1a: tells bytes that were cut or changed by accident, and models that differ.
std::uint64_t calc_checksum(const char* bytes, std::size_t size);

/// As text, which read_wheel_model() reads to the same numbers, bit by bit.
std::string write_wheel_model(const WheelModel& model);
/// Throws RunFailure where the text is none of write_wheel_model() of this version.
WheelModel read_wheel_model(std::string_view text);

}  // namespace rollrig::fmu
