/// Loss over pressure by a + b p + c/p, or by a power of the tire's stiffness, instead of a power of the pressure.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::pressure_exponent {

void make_regression(Making& of) {
  const double excess = of.size - of.specimen.pressure_exponent;
  const double line = of.draw("share_of_the_line", uniform(0.0, 0.6));
  of.effect.act = [=](const double*, Instant& now) {
    const double p = now.pressure_kPa / now.specimen->reference_pressure_kPa;
    now.loss_factor *= 1.0 + excess * (line * (1.0 - p) + (1.0 - line) * (1.0 / p - 1.0));
  };
}

/// Loss with a power of s + (1 - s) p/p_ref, the tire's vertical stiffness over that at the reference pressure.
void make_stiffness(Making& of) {
  // Assumed: share of the stiffness without pressure
  const double carcass = of.draw("carcass_share", uniform(0.1, 0.4));
  const double power = (of.size - of.specimen.pressure_exponent) / (1.0 - carcass);
  of.effect.act = [=](const double*, Instant& now) {
    const double p = now.pressure_kPa / now.specimen->reference_pressure_kPa;
    now.loss_factor *= std::pow(carcass + (1.0 - carcass) * p, -power);
  };
}

const EffectKind kind{
    "pressure_exponent",
    {"1", "exponent of the loss over pressure at the reference pressure", 0.4, 0.0, 2.0, normal(0.25, 0.55, 0.1, 0.7),
     false, 0.02},
    {{"regression",
      "what goes beyond the nominal exponent is a + b p + c/p, with the slope of the exponent at the reference "
      "pressure",
      make_regression},
     {"stiffness",
      "a power of the tire's vertical stiffness, a carcass share beside one in proportion to the pressure, with the "
      "slope of the exponent at the reference pressure",
      make_stiffness}}};

}  // namespace rollrig::generator::pressure_exponent
