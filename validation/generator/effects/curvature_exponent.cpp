/// The curvature of drum or roller counts otherwise than the standard says.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::curvature_exponent {

void make_straight(Making& of) {
  const double exponent = of.size;
  const double load_power = of.draw("load_power", uniform(0.0, 0.5));
  of.effect.act = [=](const double*, Instant& now) {
    const double load = std::max(1.0, now.load_N) / now.specimen->reference_load_N;
    const double excess = (exponent - 1.0) * std::pow(load, load_power);
    now.loss_factor *= 1.0 + excess * (now.curvature_factor - 1.0) / now.curvature_factor;
  };
}

/// K^n in place of K.
void make_power(Making& of) {
  const double exponent = of.size;
  of.effect.act = [=](const double*, Instant& now) {
    now.loss_factor *= std::pow(now.curvature_factor, exponent - 1.0);
  };
}

const EffectKind kind{
    "curvature_exponent",
    {"1", "exponent of the correction factor near 1, at the reference load", 1.0, -1.0, 3.0, normal(0.6, 1.4, 0.3, 1.7),
     false, 0.08},
    {{"straight", "what the curvature adds counts n-fold, K -> 1 + n (K - 1), the more the higher the load",
      make_straight},
     {"power", "the correction factor to the power n, at every load", make_power}},
    against_combined_law,
    off_reference_drum};

}  // namespace rollrig::generator::curvature_exponent
