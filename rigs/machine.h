#pragma once
/// Kinds of machines: what files, measurement sets and messages need to know of each. A kind is one file,
/// rigs/machines/<word>.cpp, and one line in machines.def. See docs/add_a_rig.md.

#include <string>
#include <vector>

#include "models/effect.h"
#include "models/tire_channels.h"

namespace rollrig::rigs {

struct RigFile;

/// A column of a run's file.
struct Column {
  Quantity quantity;
  Range range;  // of its numbers, in the unit of the file
  const char* doc;
};

/// Columns of the runs that are measured on a machine.
struct RunColumns {
  std::vector<Column> given;           // required in every row
  std::vector<Column> optional_given;  // required in every row where the column is there
  std::vector<Column> measured;        // may be absent, and empty in a row

  std::vector<Column> all_given() const;
  /// The given ones first.
  std::vector<Column> all() const;
};

/// Columns that several kinds have.
namespace columns {
using models::kTemperatureRange;
inline constexpr Column kSurfaceSpeed{models::quantities::kSpeed, between(0.0, 400.0), "surface speed"};
inline constexpr Column kLoad{models::quantities::kLoad, between(0.0, 200000.0), "load as the rig reports it"};
inline constexpr Column kAmbient{models::quantities::kAmbient, kTemperatureRange, "air at the tire"};
/// Of a sensor in models::kTireChannels, and that sensor as it usually is.
Column measure(const Quantity& tire_channel);
models::SensorSet::value_type make_usual_sensor(const Quantity& tire_channel);
/// A scale under the wheel, and a counter of turns. Assumed: 10 N offset, 2 N drift, 5 N noise; 0.036 km/h of either.
inline constexpr models::SensorParameters kUsualScale{10.0, 2.0, 60.0, 5.0, 0.0};
inline constexpr models::SensorParameters kUsualCounter{0.01, 0.0, 60.0, 0.01, 0.0};
}  // namespace columns

/// No member has a default, and a missing one is an error to the compiler: a kind that leaves an answer out does not
/// compile.
struct MachineKind {
  const char* word;         // in files and messages
  const char* former_word;  // in files of format /1, which stay readable; empty where that knows no such kind
  const char* set_word;  // in measurement sets, where `word` is read as well: a dyno's set is of one wheel on a roller
  models::MachineTraits traits;
  RunColumns columns;
  models::SensorSet default_sensors;  // where a set gives none; empty where it has to
  const char* follow_scenario;        // that carries out such a run as a file gives it
  RigFile (*make_rig)();              // of sets and scenarios that name a vehicle and no rig; nullptr: they name one
  const char* usual_rig;              // asset of a plan that names the kind alone; empty where a vehicle is named
  const char* usual_sensors;          // likewise its preset of sensors

  /// Whether sets and scenarios name a rig.
  bool names_rig() const { return make_rig == nullptr; }
};

/// All kinds, in the order of machines.def.
const std::vector<const MachineKind*>& machine_kinds();
std::vector<std::string> machine_words();
std::vector<std::string> set_words();
/// By any of its words; nullptr where there is none.
const MachineKind* find_machine_kind_if_any(const std::string& word);
/// The same, of a word that is known. Throws std::invalid_argument.
const MachineKind& find_machine_kind(const std::string& word);
/// The kind with a trait whose sets and scenarios name no rig. Throws std::invalid_argument.
const MachineKind& find_kind_without_rig(bool (*has_trait)(const models::MachineTraits&));

/// Whether a column is the force channel of some kind.
bool is_force(const Quantity& column);
/// The measured columns of a kind.
std::vector<Quantity> measured_channels(const MachineKind& kind);
/// Those of all kinds.
std::vector<Quantity> all_measured_channels();

/// Words of the machines that have a trait.
std::vector<std::string> list_machines(bool (*has_trait)(const models::MachineTraits&));
/// Headings of the columns in which an effect shows, and which it leaves as they are, on any machine.
std::vector<std::string> list_visible(const models::EffectInfo& effect);
std::vector<std::string> list_clean(const models::EffectInfo& effect);

}  // namespace rollrig::rigs
