/// Air that the turning tire and its wheel drag along and pump.
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator::windage {

void make_disc_and_pump(Making& of) {
  const double force_N = of.size;
  const double pumped_share = of.draw("pumped_share", uniform(0.1, 0.9));
  of.effect.act = [=](const double*, Instant& now) {
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double density = 298.15 / (now.ambient_degC + kZeroCelsius_K);
    const double rubbed = std::pow(density, 0.8) * std::pow(x, 1.8);
    now.rig_force_N += force_N * ((1.0 - pumped_share) * rubbed + pumped_share * density * x * x * (0.8 + 0.2 * x));
  };
}

/// F (v/v80)^n.
void make_power(Making& of) {
  const double force_N = of.size;
  const double power = of.draw("speed_power", uniform(1.8, 2.2));
  of.effect.act = [=](const double*, Instant& now) {
    now.rig_force_N += force_N * std::pow(now.speed_m_s / kSpeed80_m_s, power);
  };
}

const EffectKind kind{
    "windage",
    {"N", "force at 80 km/h, of one wheel", 0.0, 0.0, 50.0, log_normal(0.3, 3.0, 0.15, 5.0)},
    {{"disc_and_pump",
      "friction of a turning disc in turbulent air, v^(9/5), and air pumped by spokes and lugs, between v^2 and v^3, "
      "both with the density of the air; no heat",
      make_disc_and_pump},
     {"power", "a power of the speed, 1.8 to 2.2, in air of one density; no heat", make_power}}};

}  // namespace rollrig::generator::windage
