#pragma once
/// What is known of a tire, a rig, a vehicle or a set of logs for which files are to be written.

#include <array>
#include <map>
#include <optional>
#include <string>

#pragma GCC visibility push(default)
namespace rollrig {

/// What a user says beside the logs. Errors name a member as the option of the command line: columns as "--column".
struct GuessOptions {
  std::string folder;                          // of the logs, or the path of one log
  std::string tire, rig, vehicle, sensors;     // names of assets, or paths
  std::string name;                            // of the set; empty: that of the folder
  std::map<std::string, std::string> columns;  // heading of the log by column of the set, or by "time"
  std::map<std::string, std::string> units;    // unit by column of the set, or by "time"
  std::map<std::string, double> values;        // constant by column of the set, in the unit of that column
  std::string date_order;                      // "ymd", "dmy", "mdy"
  std::optional<double> cold_pressure_kPa;     // of all runs
  std::map<std::string, double> rests_min;     // by id of the run
};

/// A tire of which little more is known than its label.
struct NewTireOptions {
  std::string name;                       // empty: made from size and load index
  std::string size;                       // "205/55R16"; a load index may follow
  std::string load_index;                 // "91"; of "156/150" the first
  std::string tire_class;                 // "C1", "C2", "C3"; empty: by size and load index
  bool is_reinforced = false;             // extra load; sets the pressure of the test
  double rrc_N_per_kN = 0.0;              // of ISO 28580, at 25 degC on the 2 m drum; 0: by the property file
  std::string tir;                        // path of a tire property file (.tir) whose coefficients give the RRc
  std::optional<double> rrc_sd_N_per_kN;  // its standard uncertainty; absent: 0.15
  std::optional<double> pressure_kPa;     // of the test, gauge; absent: by class
  std::string speed_symbol;               // "V"; empty: that of the size, where it has one
};

/// A rig like one of the assets. What is absent is as there.
struct NewRigOptions {
  std::string name;
  std::string kind = "drum";  // "drum", "flat_belt", "dyno"
  std::optional<double> diameter_m, inertia_kg_m2, moving_mass_kg, skim_load_N, ambient_degC;
  std::optional<double> bearing_loss_N;  // at 80 km/h, at the surface of drum, roller or belt
};

/// A vehicle of which mass and drag or road load are known.
struct NewVehicleOptions {
  std::string name;
  double mass_kg = 0.0;
  std::optional<double> drag_area_m2, rotating_mass_kg, wheelbase_m, front_load_share;
  std::optional<std::array<double, 3>> road_load;  // A, B, C in N, N/(km/h), N/(km/h)^2
  std::string driven_axle = "rear";                // "front", "rear", "all"
};

}  // namespace rollrig
#pragma GCC visibility pop
