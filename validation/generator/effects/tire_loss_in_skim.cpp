/// A loss of the tire that is there as soon as it touches, and hardly more at full load.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::tire_loss_in_skim {

void make_hyperbola(Making& of) {
  const double force_N = of.size;
  const double half_N = of.draw("half_load_N", log_normal(15.0, 60.0, 8.0, 100.0));
  const double fall_per_K = of.draw("fall_per_K_at_25_degC", log_normal(0.008, 0.03, 0.004, 0.045));
  const auto saturation = [=](double load_N) { return load_N / (load_N + half_N); };
  const double in_skim = saturation(of.specimen.skim_load_N);
  of.effect.act = [=](const double*, Instant& now) {
    const double stiffness = 1.0 / (1.0 + fall_per_K * std::max(-20.0, now.rubber_degC - 25.0));
    now.heating_force_N += force_N * stiffness * saturation(std::max(0.0, now.load_N)) / in_skim;
  };
}

/// F (Fz/F_skim)^m exp(-b (T - 25 degC)), which fades within some newtons of no load.
void make_power(Making& of) {
  constexpr double kTouch_N = 15.0;  // Assumed: below it the contact is lost
  const double force_N = of.size;
  const double power = of.draw("load_power", uniform(-0.15, 0.15));
  const double fall_per_K = of.draw("fall_per_K", log_normal(0.008, 0.03, 0.004, 0.045));
  of.effect.act = [=](const double*, Instant& now) {
    const double load_N = std::max(1e-3, now.load_N);
    const double touching = -std::expm1(-load_N / kTouch_N);
    now.heating_force_N += force_N * touching * std::pow(load_N / now.specimen->skim_load_N, power) *
                           std::exp(-fall_per_K * (now.rubber_degC - 25.0));
  };
}

const EffectKind kind{
    "tire_loss_in_skim",
    {"N", "further loss of the tire at the skim load and 25 degC", 0.0, 0.0, 50.0, log_normal(0.3, 3.0, 0.15, 5.0)},
    {{"hyperbola",
      "Fz/(Fz + F_half) over its value in skim, so that it saturates with load; falls as 1/(1 + b (T - 25 degC)); "
      "heats the rubber",
      make_hyperbola},
     {"power",
      "a power of the load over that in skim, gone without load; falls exponentially from 25 degC on; heats the rubber",
      make_power}},
    on_carriages,
    on_carriages};

}  // namespace rollrig::generator::tire_loss_in_skim
