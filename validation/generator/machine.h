#pragma once
/// What a case was measured on. A kind of machine is one file, validation/generator/machines/<word>.cpp, and one line
/// in validation/generator/machines.def.

#include <string>
#include <vector>

#include "validation/generator/campaign.h"
#include "validation/generator/recorder.h"
#include "validation/generator/sensors.h"

namespace rollrig::generator {

/// A column of what the machine was told, or reports.
struct GivenColumn {
  const char* name;
  std::vector<double> RunRecord::*values;
  const char* format;
};

/// Columns that several kinds have.
namespace columns {
inline constexpr GivenColumn kTime{"time_s", &RunRecord::time_s, "{:.0f}"};
inline constexpr GivenColumn kSpeed{"speed_km_h", &RunRecord::speed_km_h, "{:.9g}"};
inline constexpr GivenColumn kLoad{"load_N", &RunRecord::load_N, "{:.10g}"};
inline constexpr GivenColumn kAmbient{"ambient_degC", &RunRecord::ambient_degC, "{:.2f}"};
inline constexpr Channel kLiner{"liner_temperature_degC", "tire", {0.25, 0.05, 60.0, 0.1, 0.1}};
inline constexpr Channel kPressure{"cavity_pressure_kPa", "tire", {0.25, 0.10, 120.0, 0.05, 0.1}};
}  // namespace columns

/// What the measured force belongs to: a tire that a carriage presses on its surface, one wheel of a vehicle that is
/// tied down on rollers, or a whole vehicle on the road.
enum class Measured { kTire, kWheel, kVehicle };

/// A campaign of a kind in mixed validation sets.
struct MixedCampaign {
  const char* name;
  int runs;              // at most
  const char* run_kind;  // of all its runs; empty: as the laboratory has them
};

/// No member has a default, and a missing one is an error to the compiler: a kind that leaves an answer out does not
/// compile.
struct Machine {
  const char* word;       // in files and messages
  const char* file_name;  // of the file of rig or vehicle
  Measured force_of;
  bool is_near_reference_drum;  // its surface is curved about as the drum to which the tire's law refers
  bool has_constant_law;        // a set may be judged against a constant coefficient instead of the combined law
  bool has_knots;               // the speed has a knot each second, so that the integration goes in steps of its own
  std::vector<GivenColumn> given_columns;
  std::vector<Channel> channels;     // measured; the first is the force
  std::vector<MixedCampaign> mixed;  // empty: mixed sets do not have this kind

  /// Whether the files of a set give the number, with an uncertainty.
  bool (*gives)(const Specimen& specimen, Base which);
  std::string (*write_set_keys)(const Specimen& specimen);
  std::string (*write_file)(const Specimen& specimen);
  /// Draws what of the specimen is this machine's.
  void (*draw_own)(std::uint64_t seed, Specimen& specimen);
  Campaign (*draw_campaign)(const CampaignOrder& order, const Specimen& specimen);
  /// Loss on its surface over that on the drum to which the tire's law refers.
  double (*calc_curvature_factor)(const Specimen& specimen);
  /// Of the first channel, in its unit over N at the surface.
  double (*find_lever)(const Specimen& specimen);
  /// Inertia that the measured force has in it, as a mass at the surface. The load is on its way to `target_load_N`.
  double (*calc_moving_mass_kg)(const Specimen& specimen, double load_N, double target_load_N);

  /// The column of weights on the sensor of the force, by its unit.
  const char* hung_column() const {
    const std::string unit = "_Nm";
    const std::string force = channels.front().name;
    const bool is_torque =
        force.size() > unit.size() && force.compare(force.size() - unit.size(), unit.size(), unit) == 0;
    return is_torque ? "hung_torque_Nm" : "hung_force_N";
  }
  bool has_vehicle() const { return force_of == Measured::kVehicle; }
};

#define ROLLRIG_MACHINE(word)   \
  namespace word {              \
  extern const Machine machine; \
  }
#include "validation/generator/machines.def"
#undef ROLLRIG_MACHINE

/// All kinds, in the order of machines.def.
const std::vector<const Machine*>& all_machines();
std::vector<std::string> machine_words();
/// Throws InputError where there is none of that name.
const Machine& find_machine(const std::string& word, const char* key);

/// What the kinds with a rig file have in common.
namespace rig {
bool gives(const Specimen& specimen, Base which);
std::string write_set_keys(const Specimen& specimen);
/// The table of a drum or roller.
std::string write_drum(const char* table, const Specimen& specimen);
/// The file up to its environment; `body` is the table of what turns, `version` that of the format.
std::string write_file(const Specimen& specimen, int version, const std::string& body);
/// From the drum on which A holds, of 2 m, to that of the specimen, by the standards' correction.
double calc_drum_factor(const Specimen& specimen);
}  // namespace rig

/// What kinds share in which a carriage presses one tire on the surface: their runs, and the mass that turns.
namespace carriage {
/// A campaign of one of the laboratories in `kinds`, drawn by the seed of the order. The kinds of its runs are "warm-up
/// <km/h>", "speed steps", "load sweep", "transient skim" and "up and down".
Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen, const std::vector<CampaignKind>& kinds);
/// Machine::calc_moving_mass_kg: of the drum or belt, and of the wheel where it is not lifted.
double calc_moving_mass_kg(const Specimen& specimen, double load_N, double target_load_N);
}  // namespace carriage

/// From the drum on which A holds, of 2 m, to a flat surface.
double calc_flat_factor(const Specimen& specimen);
double find_unit_lever(const Specimen& specimen);

}  // namespace rollrig::generator
