#pragma once
/// What an effect is to the generator: one file in blind/effects, one line in blind/effects.def.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "blind/draws.h"
#include "blind/specimen.h"

namespace blind {

struct Wall;
struct RunRecord;

/// State of the rig at one instant; the second half is what effects may change.
struct Instant {
  double time_s = 0.0;
  double speed_m_s = 0.0;
  double load_N = 0.0;
  double ambient_degC = 0.0;
  double rubber_degC = 0.0;  // mean of the wall
  double liner_degC = 0.0;
  double gas_degC = 0.0;
  double pressure_kPa = 0.0;  // gauge
  double gas_mol = 0.0;
  const Specimen* specimen = nullptr;

  double loss_factor = 1.0;      // on the tire's rolling resistance
  double heating_force_N = 0.0;  // further force that heats the rubber
  double bearing_factor = 1.0;   // on c0 + c1 v
  double rig_force_N = 0.0;      // further force of the rig
  double liner_heat_W = 0.0;     // into the layer at the liner
  double gas_heat_W = 0.0;
  double leak_mol_s = 0.0;

  double bearing_N = 0.0;  // result: force of the bearings, to be read in rates()
};

/// How a run starts for the states of an effect.
struct RunStart {
  double initial_degC = 25.0;
  double ambient_degC = 25.0;
  double cold_pressure_kPa = 280.0;
  std::optional<double> rest_before_min;  // none: soaked
};

using Shape = std::vector<std::pair<std::string, double>>;

/// One hidden cause with its size and shape.
class Effect {
 public:
  virtual ~Effect() = default;
  virtual void lay_out(Wall&) const {}
  virtual std::size_t state_count() const { return 0; }
  virtual void start(const RunStart&, double* /*state*/) const {}
  virtual void act(const double* /*state*/, Instant&) const {}
  virtual void rates(const double* /*state*/, const Instant&, double* /*rates*/) const {}
  /// What instruments and clocks do to the channels of a run.
  virtual void trace(RunRecord&) const {}

  Shape shape;  // everything drawn beside the size
};

/// An effect before its size is known.
struct EffectKind {
  const char* id;
  const char* unit;     // of the size
  const char* meaning;  // of the size
  double neutral;       // size at which it does nothing
  double lowest;        // sizes that may be asked for
  double highest;
  Spread size;
  bool either_sign;  // the size is drawn positive, then given a sign
  double gap;        // sizes nearer to the neutral one than this are drawn again: they would be no effect
  const char* law;
  std::unique_ptr<Effect> (*make)(double size, Draws& shape, const Specimen& specimen);
};

const std::vector<const EffectKind*>& effect_kinds();
const EffectKind* find_effect_kind(const std::string& id);
double draw_size(const EffectKind& kind, Draws& draws);

}  // namespace blind
