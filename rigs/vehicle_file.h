#pragma once
/// assets/vehicles/<name>.toml ("rollrig-vehicle/2", or "/1" of two axles): reading, with every rule of formats.md.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "models/tire/tire_file.h"
#include "models/vehicle/powertrain_map.h"
#include "models/vehicle/road_load.h"
#include "sim/core/schema.h"

namespace rollrig::rigs {

using VehicleBody = models::VehicleBody<double>;

/// Of one wheel.
struct VehicleSuspension {
  double stiffness_N_per_m = 0.0;
  double damping_N_s_per_m = 0.0;
  double unsprung_mass_kg = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"stiffness_N_per_m", between(100.0, 100000000.0), "Wheel rate. Assumed: 35 kN/m", 35000.0},
          p.stiffness_N_per_m);
    visit(Field{"damping_N_s_per_m", positive(), "Damper, at the wheel. Assumed: 4 kN s/m", 4000.0},
          p.damping_N_s_per_m);
    visit(
        Field{"unsprung_mass_kg", between(0.1, 100000.0), "Upright and brake, without the wheel. Assumed: 25 kg", 25.0},
        p.unsprung_mass_kg);
  }
};

struct VehiclePowertrain {
  double efficiency = 0.0;
  double regeneration_efficiency = 0.0;  // 0: as efficiency
  double regeneration_limit_m_s2 = 0.0;
  double regeneration_fade_m_s = 0.0;
  double auxiliary_power_W = 0.0;
  std::optional<models::PowertrainMap> map;  // in place of both efficiencies

  double calc_regeneration_efficiency() const {
    return regeneration_efficiency > 0.0 ? regeneration_efficiency : efficiency;
  }

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"efficiency", between(0.05, 1.0), "Battery to wheels, and back, constant. Assumed: 0.85", 0.85},
          p.efficiency);
    visit(Field{"regeneration_efficiency", between(0.0, 1.0), "Wheels to battery; 0: as efficiency", 0.0},
          p.regeneration_efficiency);
    visit(Field{"regeneration_limit_m_s2", non_negative(),
                "Deceleration up to which the driven axles brake by their motor. Assumed: 1.5 m/s2", 1.5},
          p.regeneration_limit_m_s2);
    visit(Field{"regeneration_fade_km_h", between(0.001, 500.0),
                "Speed below which it fades to nothing. Assumed: 10 km/h", 10.0},
          p.regeneration_fade_m_s);
    visit(Field{"auxiliary_power_W", between(0.0, 1e6), "What else the battery feeds while the vehicle is on", 0.0},
          p.auxiliary_power_W);
  }
};

/// Energy of a full battery, and what a full charge takes from the mains.
struct VehicleBattery {
  double usable_J = 0.0;
  double recharge_J = 0.0;  // 0: by charging_efficiency
  double charging_efficiency = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"usable_energy_kWh", between(0.001, 1e6),
                "Usable battery energy: direct current from full to empty (SAE J1634: UBE)"},
          p.usable_J);
    visit(Field{"recharge_energy_kWh", non_negative(),
                "Alternating current for a full charge after that; 0: by charging_efficiency", 0.0},
          p.recharge_J);
    visit(Field{"charging_efficiency", between(0.05, 1.0),
                "Usable energy over recharge energy, where that is not given. Assumed: 0.9", 0.9},
          p.charging_efficiency);
  }

  bool is_recharge_measured() const { return recharge_J > 0.0; }
  double calc_recharge_J() const { return recharge_J > 0.0 ? recharge_J : usable_J / charging_efficiency; }
};

/// An axle with its wheels. Shares are of all axles of the vehicle and sum to 1.
struct VehicleAxle {
  std::string name;
  double position_m = 0.0;
  double load_share = 0.0;
  double drive_share = 0.0;
  double brake_share = 0.0;
  int wheels = 2;
  double pressure_Pa = 0.0;  // 0: that of the run
  VehicleSuspension suspension;
  std::optional<models::TireFile> tire;  // where it is not that of the run

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"position_m", non_negative(), "Behind the first axle, which is at 0"}, p.position_m);
    visit(Field{"load_share", Range{0.0, 1.0, true, false}, "Share of the weight at standstill"}, p.load_share);
    visit(Field{"drive_share", between(0.0, 1.0), "Share of the motor's force; 0: not driven", 0.0}, p.drive_share);
    visit(Field{"brake_share", between(0.0, 1.0), "Share of the friction brakes' force"}, p.brake_share);
    visit(Field{"wheels", between(1.0, 20.0), "1, 2, or 4: dual tires, each a wheel; in sets of the road any number",
                2.0},
          p.wheels);
    visit(Field{"pressure_kPa", non_negative(), "Of its soaked tires, gauge; 0: as the run says", 0.0}, p.pressure_Pa);
  }
};

struct VehicleFile {
  std::string path;
  std::string content;  // as read, for the manifest's hash
  std::string name;
  VehicleBody body;
  VehicleBody uncertainties;  // 0 where none was given
  double center_of_gravity_height_m = 0.0;
  std::vector<VehicleAxle> axles;  // from the front
  bool names_tires = false;        // in files beside this one
  VehiclePowertrain powertrain;
  std::optional<VehicleBattery> battery;
  /// Road load given directly, instead of drag and tires (§3.4.3, (3.20)).
  std::optional<models::RoadLoad<double>> road_load;

  int count_wheels() const;
  /// An axle's place forwards of the center of gravity, which the axles' loads decide.
  double calc_x_m(const VehicleAxle& axle) const;
};

/// Height of the center of gravity, in both formats.
inline Field make_center_height_field() {
  return {"center_of_gravity_height_m", between(0.001, 20.0), "Above the road. Assumed: 0.6 m", 0.6,
          "centre_of_gravity_height_m"};
}

/// Tables of format /1, of a vehicle with a front and a rear axle.
struct TwoAxleGeometry {
  double wheelbase_m = 0.0;
  double center_of_gravity_height_m = 0.0;
  double front_load_share = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"wheelbase_m", between(0.1, 100.0), "Between the axles. Assumed: 2.9 m", 2.9}, p.wheelbase_m);
    visit(make_center_height_field(), p.center_of_gravity_height_m);
    visit(Field{"front_load_share", between(0.05, 0.95),
                "Share of the weight on the front axle. Assumed: 0.5, or with an odd number of tires its share of them",
                0.5},
          p.front_load_share);
  }
};

struct TwoAxleBrakes {
  double front_share = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(
        Field{"front_share", between(0.0, 1.0), "Share of the friction brakes on the front axle. Assumed: 0.65", 0.65},
        p.front_share);
  }
};

/// Reads a vehicle from parsed TOML. Throws InputError.
VehicleFile read_vehicle(const ConfigTable& config);

/// The file as TOML of format /2; a tire's file is named, not written.
std::string write_vehicle(const VehicleFile& vehicle);

/// The files of a set that has the vehicle: vehicle.toml, which is `content` (may be empty) if that names no tires, and
/// tire_<axle>.toml of axles with a tire of their own.
std::map<std::string, std::string> write_vehicle_files(VehicleFile vehicle, const std::string& content);

/// Axles that name this tire no longer have a tire of their own.
void share_tire(const models::TireFile& tire, VehicleFile& vehicle);

/// Tires of a vehicle that are alike: those of all axles with the same tire, pressure, and load of a wheel.
struct TireGroup {
  const VehicleAxle* axle = nullptr;  // the first of these axles
  double pressure_Pa = 0.0;           // soaked, gauge
  double load_share = 0.0;            // of the weight, for all these tires together
  double count = 0.0;
};

/// All tires of a vehicle, in the order of the axles. `pressure_Pa`: of axles without one of their own. Assumed: loads
/// that differ by 0.01 % or less are equal, because shares in files are rounded.
std::vector<TireGroup> group_tires(const VehicleFile& vehicle, double pressure_Pa);

/// The tire of an axle's wheels.
inline const models::TireFile& tire_of(const VehicleAxle& axle, const models::TireFile& of_run) {
  return axle.tire.has_value() ? *axle.tire : of_run;
}

/// Names of the driven axles, or "all".
std::string list_driven_axles(const VehicleFile& vehicle);

}  // namespace rollrig::rigs
