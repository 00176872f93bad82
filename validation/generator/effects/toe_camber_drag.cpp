/// Drag of a wheel at an angle to its way: a side force that saturates with load.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace blind {
namespace {

class ToeCamberDrag : public Effect {
 public:
  ToeCamberDrag(double force_N, Draws& draws) : force_N_(force_N) {
    heat_share_ = draws.uniform(0.3, 0.9);
    saturation_ = draws.uniform(0.1, 0.8);
    fall_per_K_ = draws.uniform(0.0, 0.003);
    shape = {{"heat_share", heat_share_}, {"saturation", saturation_}, {"fall_per_K", fall_per_K_}};
  }

  void act(const double*, Instant& now) const override {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double side = load * (1.0 + saturation_) / (1.0 + saturation_ * load);
    const double drag_N = force_N_ * side * std::exp(-fall_per_K_ * (now.rubber_degC - 30.0));
    now.heating_force_N += heat_share_ * drag_N;
    now.rig_force_N += (1.0 - heat_share_) * drag_N;
  }

 private:
  double force_N_;
  double heat_share_ = 0.5;
  double saturation_ = 0.0;
  double fall_per_K_ = 0.0;
};

/// Cornering stiffness that rises with the load up to x_0 and falls beyond, sin(2 atan(x/x_0)).
class ArctangentStiffness : public Effect {
 public:
  ArctangentStiffness(double force_N, Draws& draws) : force_N_(force_N) {
    heat_share_ = draws.uniform(0.3, 0.9);
    peak_ = draws.uniform(1.2, 2.5);
    shape = {{"heat_share", heat_share_}, {"peak_over_reference_load", peak_}};
  }

  void act(const double*, Instant& now) const override {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double drag_N = force_N_ * stiffness(load) / stiffness(1.0);
    now.heating_force_N += heat_share_ * drag_N;
    now.rig_force_N += (1.0 - heat_share_) * drag_N;
  }

 private:
  double stiffness(double load) const { return std::sin(2.0 * std::atan(load / peak_)); }

  double force_N_;
  double heat_share_ = 0.5;
  double peak_ = 2.0;
};

}  // namespace

extern const EffectKind kind_toe_camber_drag;
const EffectKind kind_toe_camber_drag{
    "toe_camber_drag",
    "N",
    "drag at the reference load and 30 degC, of one wheel",
    0.0,
    0.0,
    50.0,
    log_normal(2.0, 12.0, 1.2, 18.0),
    false,
    0.0,
    {{"saturating",
      "side force x (1 + s)/(1 + s x) of the load ratio x, softer in warm rubber; a share heats the rubber",
      make_law<ToeCamberDrag>},
     {"arctangent",
      "cornering stiffness of the load as sin(2 atan(x/x_0)), whatever the temperature; a share heats the rubber",
      make_law<ArctangentStiffness>}},
    kEveryGround,
    kEveryGround};

}  // namespace blind
