/// Drag of a wheel at an angle to its way: a side force that saturates with load.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::toe_camber_drag {

void make_saturating(Making& of) {
  const double force_N = of.size;
  const double heat_share = of.draw("heat_share", uniform(0.3, 0.9));
  const double saturation = of.draw("saturation", uniform(0.1, 0.8));
  const double fall_per_K = of.draw("fall_per_K", uniform(0.0, 0.003));
  of.effect.act = [=](const double*, Instant& now) {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double side = load * (1.0 + saturation) / (1.0 + saturation * load);
    const double drag_N = force_N * side * std::exp(-fall_per_K * (now.rubber_degC - 30.0));
    now.heating_force_N += heat_share * drag_N;
    now.rig_force_N += (1.0 - heat_share) * drag_N;
  };
}

/// Cornering stiffness that rises with the load up to x_0 and falls beyond, sin(2 atan(x/x_0)).
void make_arctangent(Making& of) {
  const double force_N = of.size;
  const double heat_share = of.draw("heat_share", uniform(0.3, 0.9));
  const double peak = of.draw("peak_over_reference_load", uniform(1.2, 2.5));
  const auto stiffness = [=](double load) { return std::sin(2.0 * std::atan(load / peak)); };
  of.effect.act = [=](const double*, Instant& now) {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double drag_N = force_N * stiffness(load) / stiffness(1.0);
    now.heating_force_N += heat_share * drag_N;
    now.rig_force_N += (1.0 - heat_share) * drag_N;
  };
}

const EffectKind kind{
    "toe_camber_drag",
    {"N", "drag at the reference load and 30 degC, of one wheel", 0.0, 0.0, 50.0, log_normal(2.0, 12.0, 1.2, 18.0)},
    {{"saturating",
      "side force x (1 + s)/(1 + s x) of the load ratio x, softer in warm rubber; a share heats the rubber",
      make_saturating},
     {"arctangent",
      "cornering stiffness of the load as sin(2 atan(x/x_0)), whatever the temperature; a share heats the rubber",
      make_arctangent}},
    everywhere,
    everywhere};

}  // namespace rollrig::generator::toe_camber_drag
