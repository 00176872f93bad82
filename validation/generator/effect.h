#pragma once
/// What an effect is to the generator: one file in validation/generator/effects, one line in
/// validation/generator/effects.def.
/// Assumed: the spreads from which sizes and shapes are drawn, and every constant of a law that names no source.

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/generator/draws.h"
#include "validation/generator/specimen.h"

namespace rollrig::generator {

struct Wall;
struct RunRecord;

/// Where an effect may be found: a machine, and the law against which its sets are judged.
struct Ground {
  const Machine& machine;
  bool constant_rrc;
};

/// What effects ask of a ground. They never ask which kind of machine it is, so that a new kind has its effects.
using Where = bool (*)(const Ground& ground);
bool everywhere(const Ground& ground);
bool on_rigs(const Ground& ground);
bool on_carriages(const Ground& ground);
bool on_rollers(const Ground& ground);
bool on_vehicles(const Ground& ground);  // on the road, or one wheel on rollers
bool on_roads(const Ground& ground);
bool against_constant_law(const Ground& ground);
bool against_combined_law(const Ground& ground);
bool off_reference_drum(const Ground& ground);  // where curvature counts, against the combined law

/// As a message names them.
std::string list_grounds(Where where);

/// State of rig or vehicle at one instant; forces are those of one wheel. The first part is given, the second what
/// enter() may change beside load and air, the third what act() may change, the last what rates() may read.
struct Instant {
  double time_s = 0.0;
  double speed_m_s = 0.0;
  double load_N = 0.0;
  double ambient_degC = 0.0;  // air at the tire
  double rubber_degC = 0.0;   // mean of the wall
  double liner_degC = 0.0;
  double gas_degC = 0.0;
  double pressure_kPa = 0.0;  // gauge
  double gas_mol = 0.0;
  const Specimen* specimen = nullptr;
  double target_load_N = 0.0;  // where the load is to settle
  double acceleration_m_s2 = 0.0;
  double longitudinal_N = 0.0;  // wheel on surface, positive when it drives; not on a drum
  double brake_N = 0.0;         // of this wheel's friction brake
  double distance_m = 0.0;      // from the start of a trip on the road
  double curvature_factor = 1.0;

  double volume_factor = 1.0;  // of the cavity
  double volume_rate_per_s = 0.0;

  double loss_factor = 1.0;      // on the tire's rolling resistance
  double heating_force_N = 0.0;  // further force that heats the rubber
  double bearing_factor = 1.0;   // on c0 + c1 v
  double rig_force_N = 0.0;      // further force of the rig
  double liner_heat_W = 0.0;     // into the layer at the liner
  double gas_heat_W = 0.0;
  double leak_mol_s = 0.0;
  double tread_heat_W = 0.0;  // into the outermost layer
  double surface_rise_dK = 0.0;
  double air_speed_m_s = 0.0;  // that cools the tire
  double gas_link_factor = 1.0;
  double body_force_N = 0.0;  // on the whole vehicle
  double wind_m_s = 0.0;      // against the vehicle
  double drag_factor = 1.0;

  double bearing_N = 0.0;  // force of the bearings
  double rolling_N = 0.0;  // all that heats the rubber
};

/// How a run starts for the states of an effect.
struct RunStart {
  double initial_degC = 25.0;
  double ambient_degC = 25.0;
  double cold_pressure_kPa = 280.0;
  std::optional<double> rest_before_min;  // none: soaked; 0: right after another run
  std::size_t index = 0;                  // of the run in its campaign
  double first_load_N = 0.0;

  /// What the rest before the run leaves of something that decays as exp(-pace t/time_s); nothing where it was soaked.
  double left_after_rest(double time_s, double pace = 1.0) const;
  /// What of something comes back during the rest as 1 - exp(-t/time_s); all where it was soaked.
  double recovered_in_rest(double time_s) const;
};

/// Heat of a warm tire at 80 km/h and the reference load: what effects driven by heat are measured by.
double warm_heating_W(const Specimen& specimen);

using Shape = std::vector<std::pair<std::string, double>>;

/// One hidden cause with its shape: what it does where, nothing where its law does not say.
struct Effect {
  using Acting = std::function<void(const double* state, Instant&)>;

  Shape shape;  // everything drawn beside the size
  std::size_t state_count = 0;
  std::function<void(Wall&)> lay_out = [](Wall&) {};
  /// What the machine really is, where its file says otherwise.
  std::function<void(Specimen&)> rebuild = [](Specimen&) {};
  std::function<void(const RunStart&, double* state)> start = [](const RunStart&, double*) {};
  /// The speed that there is where a speed is recorded.
  std::function<double(double recorded_m_s)> true_speed_m_s = [](double recorded_m_s) { return recorded_m_s; };
  /// What really acts where load and air are recorded, and the cavity; before everything else.
  Acting enter = [](const double*, Instant&) {};
  Acting act = [](const double*, Instant&) {};
  /// Of its states; they are 0 before.
  std::function<void(const double* state, const Instant&, double* rates)> rates = [](const double*, const Instant&,
                                                                                     double*) {};
  /// What instruments and clocks do to the channels of a run.
  std::function<void(RunRecord&)> trace = [](RunRecord&) {};
};
using Effects = std::vector<Effect>;

/// An effect in the making. A law draws its shape in one order: validation sets that are published are made again.
struct Making {
  double size;
  Draws& draws;
  const Specimen& specimen;
  Effect effect = {};

  /// Adds to the shape.
  double note(const char* name, double value) {
    effect.shape.emplace_back(name, value);
    return value;
  }
  double draw(const char* name, const Spread& spread) { return note(name, draws.from(spread)); }
  /// A time drawn in minutes, in s.
  double draw_min(const char* name, const Spread& spread) {
    const double time_s = 60.0 * draws.from(spread);
    note(name, time_s / 60.0);
    return time_s;
  }
};

/// One functional form of an effect. In all forms of an effect the size means the same.
struct Form {
  const char* name;
  const char* law;
  void (*make)(Making& of);
};

/// Sizes of an effect.
struct EffectSize {
  const char* unit;
  const char* meaning;
  double neutral;  // at which it does nothing
  double lowest;   // that may be asked for
  double highest;
  Spread drawn;
  bool either_sign = false;  // drawn positive, then given a sign
  double gap = 0.0;          // drawn nearer to the neutral one than this: drawn again, for it would be no effect
};

/// Effects outside of the catalog come in lists. An order draws from one list alone, so that a new list leaves
/// validation sets of earlier seeds as they are; a list that was drawn from stays as it is.
/// The last one has effects that only a second machine shows: on one alone they look like the tire's.
enum class OutsideList { kFirst, kSecond, kBetweenMachines };
constexpr std::array<const char*, 3> kOutsideListNames{"first", "second", "between_machines"};

/// An effect before its size is known.
struct EffectKind {
  const char* id;
  EffectSize size;
  std::vector<Form> forms;                         // drawn evenly
  Where acts = on_rigs;                            // where it can be made
  Where drawn = on_rigs;                           // where validation sets have it: the others hardly change with it
  bool outside = false;                            // of the catalog
  OutsideList outside_list = OutsideList::kFirst;  // of one outside
};

#define ROLLRIG_EFFECT(id)      \
  namespace id {                \
  extern const EffectKind kind; \
  }
#include "validation/generator/effects.def"
#undef ROLLRIG_EFFECT

const std::vector<const EffectKind*>& effect_kinds();
const EffectKind* find_effect_kind(const std::string& id);
Effect make_effect(const Form& form, double size, Draws& draws, const Specimen& specimen);
/// None where the effect has no form of that name.
const Form* find_form(const EffectKind& kind, const std::string& name);
double draw_size(const EffectKind& kind, Draws& draws);

/// Thirds of the sizes that are drawn, by how far they are from doing nothing.
enum class SizeClass { kSmall, kMiddle, kLarge };
constexpr std::array<const char*, 3> kSizeClassNames{"small", "middle", "large"};
/// A size of one class: sizes of the three classes in equal numbers are as those of draw_size().
double draw_size(const EffectKind& kind, SizeClass wanted, Draws& draws);
/// The middle of a class.
double typical_size(const EffectKind& kind, SizeClass wanted);

}  // namespace rollrig::generator
