/// Drag of a wheel at an angle to its way: a side force that saturates with load.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class ToeCamberDrag : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double side = load * (1.0 + saturation_) / (1.0 + saturation_ * load);
    const double drag_N = force_N_ * side * std::exp(-fall_per_K_ * (now.rubber_degC - 30.0));
    now.heating_force_N += heat_share_ * drag_N;
    now.rig_force_N += (1.0 - heat_share_) * drag_N;
  }

 private:
  double force_N_ = size_;
  double heat_share_ = note("heat_share", draws_.uniform(0.3, 0.9));
  double saturation_ = note("saturation", draws_.uniform(0.1, 0.8));
  double fall_per_K_ = note("fall_per_K", draws_.uniform(0.0, 0.003));
};

/// Cornering stiffness that rises with the load up to x_0 and falls beyond, sin(2 atan(x/x_0)).
class ArctangentStiffness : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double drag_N = force_N_ * stiffness(load) / stiffness(1.0);
    now.heating_force_N += heat_share_ * drag_N;
    now.rig_force_N += (1.0 - heat_share_) * drag_N;
  }

 private:
  double stiffness(double load) const { return std::sin(2.0 * std::atan(load / peak_)); }

  double force_N_ = size_;
  double heat_share_ = note("heat_share", draws_.uniform(0.3, 0.9));
  double peak_ = note("peak_over_reference_load", draws_.uniform(1.2, 2.5));
};

}  // namespace

const EffectKind kind_toe_camber_drag{
    "toe_camber_drag",
    {"N", "drag at the reference load and 30 degC, of one wheel", 0.0, 0.0, 50.0, log_normal(2.0, 12.0, 1.2, 18.0)},
    {{"saturating",
      "side force x (1 + s)/(1 + s x) of the load ratio x, softer in warm rubber; a share heats the rubber",
      make_law<ToeCamberDrag>},
     {"arctangent",
      "cornering stiffness of the load as sin(2 atan(x/x_0)), whatever the temperature; a share heats the rubber",
      make_law<ArctangentStiffness>}},
    kEveryGround,
    kEveryGround};

}  // namespace rollrig::generator
