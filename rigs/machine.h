#pragma once
/// Kinds of machines: what files, measurement sets and messages need to know of each. A kind is one file,
/// rigs/machines/<word>.cpp, and one line in machines.def. See docs/add_a_rig.md.

#include <string>
#include <vector>

#include "models/effect.h"
#include "models/machine_traits.h"
#include "models/sensor.h"

namespace rollrig::rigs {

/// Temperatures that a set may hold, in degC. Assumed: wider than any tire or test cell.
constexpr Range kSetTemperatureRange = between(-80.0, 250.0);

/// Columns of the runs that are measured on a machine.
struct RunColumns {
  std::vector<Field> given;           // required in every row
  std::vector<Field> optional_given;  // required in every row where the column is there
  std::vector<Field> measured;        // may be absent, and empty in a row

  std::vector<Field> all_given() const;
  /// The given ones first.
  std::vector<Field> all() const;
};

/// Columns that several kinds have.
namespace columns {
inline constexpr Field kSurfaceSpeed{"speed_km_h", between(0.0, 400.0), "surface speed"};
inline constexpr Field kLoad{"load_N", between(0.0, 200000.0), "load as the rig reports it"};
inline constexpr Field kAmbient{"ambient_degC", kSetTemperatureRange, "air at the tire"};
inline constexpr Field kLinerTemperature{"liner_temperature_degC", kSetTemperatureRange,
                                         "temperature of the inner liner"};
inline constexpr Field kCavityPressure{"cavity_pressure_kPa", between(-100.0, 3000.0), "gauge pressure"};
/// Beyond the format's list: where the gas temperature was measured, H can be fitted (3.16).
inline constexpr Field kGasTemperature{"gas_temperature_degC", kSetTemperatureRange,
                                       "temperature of the inflation gas"};
}  // namespace columns

/// No member has a default, so that a kind which leaves an answer out does not compile.
struct MachineKind {
  const char* word;         // in files and messages
  const char* former_word;  // in files of format /1, which stay readable; empty where that knows no such kind
  models::MachineTraits traits;
  RunColumns columns;
  models::SensorSet default_sensors;  // where a set gives none; empty where it has to
  const char* follow_scenario;        // that carries out such a run as a file gives it
};

/// All kinds, in the order of machines.def.
const std::vector<const MachineKind*>& machine_kinds();
std::vector<std::string> machine_words();
/// By its word or its former one; nullptr where there is none.
const MachineKind* find_machine_kind_if_any(const std::string& word);
/// The same, of a word that is known. Throws std::invalid_argument.
const MachineKind& find_machine_kind(const std::string& word);

/// Whether a column is the force channel of some kind.
bool is_force(const std::string& heading);
/// Headings of the measured columns of a kind.
std::vector<std::string> measured_channels(const MachineKind& kind);
/// Those of all kinds.
std::vector<std::string> all_measured_channels();

/// Words of the machines that have a trait.
std::vector<std::string> list_machines(bool (*has_trait)(const models::MachineTraits&));
/// Headings of the columns in which an effect shows, and which it leaves as they are, on any machine.
std::vector<std::string> list_visible(const models::EffectInfo& effect);
std::vector<std::string> list_clean(const models::EffectInfo& effect);

}  // namespace rollrig::rigs
