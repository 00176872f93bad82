/// The loss follows the temperature of a tire with four layers, where a constant coefficient is reckoned with.
#include <algorithm>
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator::tire_temperature {

void make_power(Making& of) {
  const double fall_per_K = of.size;
  const double reference_degC = of.draw("reference_degC", uniform(28.0, 42.0));
  const double power = of.draw("power", uniform(3.0, 8.0));
  of.effect.act = [=](const double*, Instant& now) {
    const double softer = std::max(0.2, 1.0 + fall_per_K * (now.rubber_degC - reference_degC) / power);
    now.loss_factor *= std::pow(softer, -power);
  };
}

/// Arrhenius' law with the fall of the size at the temperature where the coefficient holds.
void make_arrhenius(Making& of) {
  const double reference_K = of.draw("reference_degC", uniform(28.0, 42.0)) + kZeroCelsius_K;
  const double activation_K = of.size * reference_K * reference_K;
  of.effect.act = [=](const double*, Instant& now) {
    now.loss_factor *= std::exp(activation_K * (1.0 / (now.rubber_degC + kZeroCelsius_K) - 1.0 / reference_K));
  };
}

const EffectKind kind{
    "tire_temperature",
    {"1/K", "relative fall of the loss per K at the temperature where the coefficient holds", 0.0, 0.0, 0.1,
     log_normal(0.008, 0.03, 0.006, 0.035)},
    {{"power",
      "power of a linear function of the temperature instead of an exponential; heated by the loss, cooled by air and "
      "road with the speed",
      make_power},
     {"arrhenius",
      "Arrhenius' law exp(E/R (1/T - 1/T_0)) instead of an exponential; heated by the loss, cooled by air and road "
      "with the speed",
      make_arrhenius}},
    against_constant_law,
    against_constant_law};

}  // namespace rollrig::generator::tire_temperature
