/// The air of the cell warms by what tire and rig give off: with walls that follow late, or with a draught.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::cell_air_warming {

void make_air_and_walls(Making& of) {
  const double rise_dK = of.size;
  const double reference_W = warm_heating_W(of.specimen);
  const double air_s = of.draw_min("air_min", log_normal(12.0, 40.0, 8.0, 60.0));
  const double walls_s = air_s * of.draws.uniform(2.5, 5.0);
  of.note("walls_min", walls_s / 60.0);
  const double walls_share = of.draw("walls_share", uniform(0.2, 0.6));
  of.effect.state_count = 2;
  of.effect.start = [=](const RunStart& start, double* state) {
    state[0] = start.left_after_rest(air_s);
    state[1] = start.left_after_rest(walls_s);
  };
  of.effect.enter = [=](const double* state, Instant& now) {
    now.ambient_degC += rise_dK * ((1.0 - walls_share) * state[0] + walls_share * state[1]);
  };
  of.effect.rates = [=](const double* state, const Instant& now, double* rates) {
    const double heat = now.rolling_N * now.speed_m_s / reference_W;
    rates[0] = (heat - state[0]) / air_s;
    rates[1] = (heat - state[1]) / walls_s;
  };
}

/// A cell that its own draught cools, in proportion to the root of the rise: theta' = (q - theta^(3/2))/tau.
void make_ventilated(Making& of) {
  const double rise_dK = of.size;
  const double reference_W = warm_heating_W(of.specimen);
  // So that air_min is the time constant about the steady rise.
  const double time_s = 1.5 * 60.0 * of.draw("air_min", log_normal(20.0, 80.0, 12.0, 120.0));
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* rise) {
    if (!start.rest_before_min.has_value()) return;
    // theta' = -theta^(3/2)/tau from 1 on.
    rise[0] = std::pow(1.0 + 0.5 * 60.0 * *start.rest_before_min / time_s, -2.0);
  };
  of.effect.enter = [=](const double* rise, Instant& now) { now.ambient_degC += rise_dK * rise[0]; };
  of.effect.rates = [=](const double* rise, const Instant& now, double* rates) {
    const double heat = now.rolling_N * now.speed_m_s / reference_W;
    rates[0] = (heat - rise[0] * std::sqrt(std::abs(rise[0]))) / time_s;
  };
}

const EffectKind kind{
    "cell_air_warming",
    {"K", "rise after long running at 80 km/h and the reference load", 0.0, -20.0, 20.0,
     log_normal(1.0, 6.0, 0.7, 8.0)},
    {{"air_and_walls",
      "air and walls, each of first order, driven by the heat of the tire; rests cool them; the record shows neither",
      make_air_and_walls},
     {"ventilated",
      "one volume of air by the heat of the tire, with draught in proportion to the root of the rise: steady rise with "
      "heat^(2/3); rests cool it",
      make_ventilated}}};

}  // namespace rollrig::generator::cell_air_warming
