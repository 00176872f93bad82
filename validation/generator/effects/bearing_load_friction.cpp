/// Friction of the spindle's bearings under load: a sliding and a rolling part, or Palmgren's moment.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::bearing_load_friction {

constexpr double kReference_N = 5400.0;

void make_sliding_and_rolling(Making& of) {
  const double force_N = of.size;
  const double rolling_share = of.draw("rolling_share", uniform(0.0, 0.5));
  const double boundary = of.draw("boundary_friction", uniform(0.0, 0.3));
  of.effect.act = [=](const double*, Instant& now) {
    const double load = std::max(0.0, now.load_N) / kReference_N;
    const double sliding = load * (1.0 + boundary * std::exp(-now.speed_m_s / 4.0));
    const double rolling = std::pow(load, 4.0 / 3.0);
    now.rig_force_N += force_N * ((1.0 - rolling_share) * sliding + rolling_share * rolling);
  };
}

/// Moment f1 P d of Palmgren and Harris, f1 with P^y: y 0 for cylindrical rollers, 0.55 for deep-groove balls.
void make_palmgren(Making& of) {
  const double force_N = of.size;
  const double power = of.note("load_power", 1.0 + of.draws.uniform(0.0, 0.55));
  of.effect.act = [=](const double*, Instant& now) {
    now.rig_force_N += force_N * std::pow(std::max(0.0, now.load_N) / kReference_N, power);
  };
}

const EffectKind kind{
    "bearing_load_friction",
    {"N", "friction at 5.4 kN and at speed", 0.0, 0.0, 50.0, log_normal(0.3, 3.0, 0.15, 5.0)},
    {{"sliding_and_rolling",
      "sliding part in proportion to the load, higher at creep, and rolling part with load^(4/3), as in bearing "
      "makers' friction models",
      make_sliding_and_rolling},
     {"palmgren",
      "Palmgren's moment under load, P^(1 + y), y 0 to 0.55 from roller to ball bearings, whatever the speed",
      make_palmgren}}};

}  // namespace rollrig::generator::bearing_load_friction
