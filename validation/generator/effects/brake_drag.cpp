/// Pads that keep rubbing after braking, until the disc has pushed them back or has cooled.

#include "validation/generator/effect.h"

namespace rollrig::generator::brake_drag {

void make_worn_off(Making& of) {
  const double force_N = of.size;
  const double push_back_m = 1e3 * of.draws.from(log_normal(0.4, 4.0, 0.3, 6.0));
  of.note("push_back_km", 1e-3 * push_back_m);
  const double set_s = of.draw("set_time_s", uniform(2.0, 6.0));
  const double half_N = of.draw("half_force_N", log_normal(50.0, 300.0, 30.0, 400.0));
  of.effect.state_count = 1;
  of.effect.act = [=](const double* rubbing, Instant& now) { now.rig_force_N += force_N * rubbing[0]; };
  of.effect.rates = [=](const double* rubbing, const Instant& now, double* rates) {
    const double squared = now.brake_N * now.brake_N;
    const double pressed = squared / (squared + half_N * half_N);
    rates[0] = (1.0 - rubbing[0]) * pressed / set_s - rubbing[0] * now.speed_m_s / push_back_m;
  };
}

/// A disc that swells by the energy of brakings and shrinks as it cools: r' = (1 - r) P/E - r/tau.
void make_hot_disc(Making& of) {
  const double force_N = of.size;
  // Assumed: a braking from 50 km/h is 30 to 70 kJ a wheel
  const double full_J = of.draw("full_J", log_normal(4e3, 15e3, 3e3, 20e3));
  const double cooling_s = of.draw("cooling_s", log_normal(40.0, 300.0, 30.0, 450.0));
  of.effect.state_count = 1;
  of.effect.act = [=](const double* rubbing, Instant& now) { now.rig_force_N += force_N * rubbing[0]; };
  of.effect.rates = [=](const double* rubbing, const Instant& now, double* rates) {
    rates[0] = (1.0 - rubbing[0]) * now.brake_N * now.speed_m_s / full_J - rubbing[0] / cooling_s;
  };
}

const EffectKind kind{
    "brake_drag",
    {"N", "drag of one wheel right after strong braking", 0.0, 0.0, 100.0, log_normal(2.0, 12.0, 1.2, 18.0)},
    {{"worn_off", "set by brakings with the square of their force, worn off over distance instead of time",
      make_worn_off},
     {"hot_disc", "pads rub as long as the disc is hot: set by the energy of brakings, gone with time", make_hot_disc}},
    on_vehicles,
    on_vehicles};

}  // namespace rollrig::generator::brake_drag
