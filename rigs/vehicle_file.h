#pragma once
/// assets/vehicles/<name>.toml ("rollrig-vehicle/1"): reading, with every rule of formats.md.

#include <optional>
#include <string>

#include "models/vehicle/road_load.h"
#include "models/vehicle/vehicle_body.h"
#include "sim/core/schema.h"

namespace rollrig::rigs {

using VehicleBody = models::VehicleBody<double>;

struct VehicleGeometry {
  double wheelbase_m = 0.0;
  double centre_of_gravity_height_m = 0.0;
  double front_load_share = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"wheelbase_m", positive(), "Between the axles. Assumed: 2.9 m", 2.9}, p.wheelbase_m);
    visit(Field{"centre_of_gravity_height_m", positive(), "Above the road. Assumed: 0.6 m", 0.6},
          p.centre_of_gravity_height_m);
    visit(Field{"front_load_share", between(0.05, 0.95), "Share of the weight on the front axle. Assumed: 0.5", 0.5},
          p.front_load_share);
  }
};

/// Of one wheel.
struct VehicleSuspension {
  double stiffness_N_per_m = 0.0;
  double damping_N_s_per_m = 0.0;
  double unsprung_mass_kg = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"stiffness_N_per_m", positive(), "Wheel rate. Assumed: 35 kN/m", 35000.0}, p.stiffness_N_per_m);
    visit(Field{"damping_N_s_per_m", positive(), "Damper, at the wheel. Assumed: 4 kN s/m", 4000.0},
          p.damping_N_s_per_m);
    visit(Field{"unsprung_mass_kg", positive(), "Upright and brake, without the wheel. Assumed: 25 kg", 25.0},
          p.unsprung_mass_kg);
  }
};

enum class DrivenAxle { kFront, kRear, kAll };

struct VehiclePowertrain {
  double efficiency = 0.0;
  double regeneration_limit_m_s2 = 0.0;
  double regeneration_fade_m_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"efficiency", between(0.05, 1.0), "Battery to wheels, and back, constant. Assumed: 0.85", 0.85},
          p.efficiency);
    visit(Field{"regeneration_limit_m_s2", non_negative(),
                "Deceleration up to which the driven axle brakes by its motor. Assumed: 1.5 m/s2", 1.5},
          p.regeneration_limit_m_s2);
    visit(Field{"regeneration_fade_km_h", positive(), "Speed below which it fades to nothing. Assumed: 10 km/h", 10.0},
          p.regeneration_fade_m_s);
  }
};

struct VehicleBrakes {
  double front_share = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(
        Field{"front_share", between(0.0, 1.0), "Share of the friction brakes on the front axle. Assumed: 0.65", 0.65},
        p.front_share);
  }
};

struct VehicleFile {
  std::string path;
  std::string content;  // as read, for the manifest's hash
  std::string name;
  VehicleBody body;
  VehicleBody uncertainties;  // 0 where none was given
  int tires = 4;
  VehicleGeometry geometry;
  VehicleSuspension suspension;
  VehiclePowertrain powertrain;
  DrivenAxle driven_axle = DrivenAxle::kRear;
  VehicleBrakes brakes;
  /// Road load given directly, instead of drag and tires (§3.4.3, (3.20)).
  std::optional<models::RoadLoad<double>> road_load;
};

/// Reads a vehicle from parsed TOML. Throws InputError.
VehicleFile read_vehicle(const ConfigTable& config);

/// The file as TOML.
std::string write_vehicle(const VehicleFile& vehicle);

/// "front", "rear" or "all".
const char* name_of(DrivenAxle axle);

}  // namespace rollrig::rigs
