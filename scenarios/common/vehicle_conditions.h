#pragma once
/// Test conditions that every scenario with a vehicle shares.

#include <optional>

#include "rigs/vehicle_layout.h"
#include "scenarios/run/settings.h"

namespace rollrig::scenarios {

struct VehicleConditions {
  int wheels = 4;
  Name wheel_of;
  double pressure_Pa = 0.0;
  std::optional<double> ambient_K;
  std::optional<double> surface_K;
  std::optional<double> initial_tire_K;
  Choice tire_state{"soaked", {"soaked", "warm"}};
  std::optional<double> rest_before_s;
  std::optional<double> set_A_N;
  std::optional<double> set_B_N_s_per_m;
  std::optional<double> set_C_N_s2_per_m2;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"wheels", between(1.0, 4.0),
                "4: the whole vehicle, however many wheels it has; 1: one wheel with its share, of the first axle "
                "unless wheel_of names another",
                4.0},
          p.wheels);
    visit(Field{"wheel_of", any_number(), "Axle of which one wheel is simulated; default: all wheels", {}, "quarter"},
          p.wheel_of);
    visit(Field{"pressure_kPa", between(50.0, 1000.0),
                "Gauge pressure of the soaked tires of axles that have none of their own (§3.2.3.4: 280 kPa)", 280.0},
          p.pressure_Pa);
    visit(Field{"ambient_degC", between(-60.0, 80.0), "Air at the tires; default: the rig's"}, p.ambient_K);
    visit(Field{"surface_temperature_degC", between(-60.0, 120.0), "Rollers or road; default: as the air"},
          p.surface_K);
    visit(Field{"initial_tire_temperature_degC", between(-60.0, 120.0), "Tires at the start; default: as the air"},
          p.initial_tire_K);
    visit(Field{"tire_state", any_number(),
                "warm: right after another run; effects that remember, such as flat_spot, start accordingly"},
          p.tire_state);
    visit(Field{"rest_before_min", between(0.0, 1e5), "Standstill before the run, after driving; default: soaked"},
          p.rest_before_s);
    visit(Field{"set_A_N", any_number(),
                "Force of the rollers at standstill, on the whole vehicle (3.20); default: 0, or with [road_load] its "
                "A less "
                "the tires' loss by their ISO coefficient; dyno_setting finds it"},
          p.set_A_N);
    visit(Field{"set_B_N_per_km_h", any_number(), "Its rise with speed; default: 0, or that of [road_load]"},
          p.set_B_N_s_per_m);
    visit(Field{"set_C_N_per_km_h2", any_number(),
                "Its rise with the square of speed; default: the vehicle's drag at 20 degC and 98.21 kPa, or that of "
                "[road_load]"},
          p.set_C_N_s2_per_m2);
  }

  /// Fills what rig and vehicle decide. Throws InputError when `wheels` is neither 1 nor 4, when settings are given
  /// that say nothing on this rig, when the wheels alone have more equivalent mass than all that turns, or when they
  /// weigh more than their axle bears.
  void complete(const RunSpec& spec);

  /// Force of the rollers on the whole vehicle where none is set.
  static models::RoadLoad<double> find_default_set_load(const RunSpec& spec);
  /// Index of the axle of the one wheel: the first unless the settings name another. Throws InputError where it is not
  /// there or stands still.
  static std::size_t find_axle(const RunSpec& spec);
  /// The vehicle as it is simulated.
  rigs::VehicleLayout make_layout(const RunSpec& spec) const;
};

}  // namespace rollrig::scenarios
