/// Loss over load as a mixture of two powers, or with a coefficient that is a straight line of the load.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::load_exponent {

void make_two_powers(Making& of) {
  const double excess = of.size - 1.0;
  const double spread = of.draw("spread_over_excess", uniform(0.2, 0.8));
  of.effect.act = [=](const double*, Instant& now) {
    const double load = std::max(1.0, now.load_N) / now.specimen->reference_load_N;
    const double apart = spread * excess;
    now.loss_factor *= 0.5 * (std::pow(load, excess + apart) + std::pow(load, excess - apart));
  };
}

/// Coefficient that is a straight line of the load, with the slope that the power b - 1 has at the reference load.
void make_straight(Making& of) {
  const double excess = of.size - 1.0;
  of.effect.act = [=](const double*, Instant& now) {
    constexpr double kLeast = 0.1;  // out of reach of the sizes that are drawn
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    now.loss_factor *= std::max(kLeast, 1.0 + excess * (load - 1.0));
  };
}

const EffectKind kind{
    "load_exponent",
    {"1", "exponent of the loss over load at the reference load", 1.0, 0.3, 2.0, normal(0.85, 1.15, 0.7, 1.3), false,
     0.02},
    {{"two_powers",
      "mean of two powers of the load, b + d and b - d, so that the exponent moves with load and is b at the reference",
      make_two_powers},
     {"straight",
      "the coefficient is a straight line of the load, 1 + (b - 1)(x - 1), as in the regression of SAE J1269",
      make_straight}}};

}  // namespace rollrig::generator::load_exponent
