/// The surface warms under the tire: skin and body, or one body that is cooled faster with speed.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::surface_warming {

void make_skin_and_body(Making& of) {
  const double rise_dK = of.size;
  const double reference_W = warm_heating_W(of.specimen);
  const double skin_s = of.draw_min("skin_min", uniform(2.0, 7.0));
  const double body_s = of.draw_min("body_min", log_normal(12.0, 45.0, 9.0, 60.0));
  const double skin_share = of.draw("skin_share", uniform(0.1, 0.4));
  of.effect.state_count = 2;
  of.effect.start = [=](const RunStart& start, double* state) {
    state[0] = start.left_after_rest(skin_s);
    state[1] = start.left_after_rest(body_s);
  };
  of.effect.act = [=](const double* state, Instant& now) {
    now.surface_rise_dK += rise_dK * (skin_share * state[0] + (1.0 - skin_share) * state[1]);
  };
  of.effect.rates = [=](const double* state, const Instant& now, double* rates) {
    const double heat = now.rolling_N * now.speed_m_s / reference_W;
    rates[0] = (heat - state[0]) / skin_s;
    rates[1] = (heat - state[1]) / body_s;
  };
}

/// One body, theta' = (q - (s + (1 - s) x^0.8) theta)/tau, x = v/(80 km/h).
void make_cooled_body(Making& of) {
  const double rise_dK = of.size;
  const double reference_W = warm_heating_W(of.specimen);
  const double time_s = of.draw_min("time_constant_min", log_normal(10.0, 40.0, 8.0, 55.0));
  const double still_share = of.draw("still_share", uniform(0.2, 0.7));
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* rise) { rise[0] = start.left_after_rest(time_s, still_share); };
  of.effect.act = [=](const double* rise, Instant& now) { now.surface_rise_dK += rise_dK * rise[0]; };
  of.effect.rates = [=](const double* rise, const Instant& now, double* rates) {
    const double heat = now.rolling_N * now.speed_m_s / reference_W;
    const double cooling = still_share + (1.0 - still_share) * std::pow(now.speed_m_s / kSpeed80_m_s, 0.8);
    rates[0] = (heat - cooling * rise[0]) / time_s;
  };
}

const EffectKind kind{
    "surface_warming",
    {"K", "rise after long running at 80 km/h and the reference load", 0.0, -30.0, 60.0,
     log_normal(2.0, 15.0, 1.3, 20.0)},
    {{"skin_and_body", "skin and body, each of first order, driven by the heat of the tire instead of speed and load",
      make_skin_and_body},
     {"cooled_body", "one body, driven by the heat of the tire, that the air cools faster with speed",
      make_cooled_body}}};

}  // namespace rollrig::generator::surface_warming
