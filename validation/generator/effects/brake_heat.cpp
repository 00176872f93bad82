/// Heat of the brakes goes to bead and gas: through a disc that the air cools and a rim, or as a share, late.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::brake_heat {

/// Heat to bead and gas from the last store on the way, which empties within `delay_s`.
void heat_tire(double stored_J, double delay_s, double gas_share, Instant& now) {
  const double to_tire_W = stored_J / delay_s;
  now.liner_heat_W += (1.0 - gas_share) * to_tire_W;
  now.gas_heat_W += gas_share * to_tire_W;
}

double air_W_per_K(double speed_m_s) { return 4.0 + 14.0 * std::pow(speed_m_s / kSpeed80_m_s, 0.7); }

void make_disc_and_rim(Making& of) {
  constexpr double kTown_m_s = 40.0 / 3.6;
  const double disc_J_per_K = of.draw("disc_J_per_K", uniform(3000.0, 6000.0));
  const double lead_W_per_K = of.draw("disc_to_rim_W_per_K", uniform(6.0, 14.0));
  const double rim_s = 60.0 * of.draw("rim_min", log_normal(3.0, 30.0, 2.5, 30.0));
  const double gas_share = of.draw("gas_share", uniform(0.1, 0.5));
  const double passed = 0.01 * of.size * (lead_W_per_K + air_W_per_K(kTown_m_s)) / lead_W_per_K;
  of.effect.state_count = 2;
  of.effect.act = [=](const double* state, Instant& now) { heat_tire(state[1], rim_s, gas_share, now); };
  of.effect.rates = [=](const double* state, const Instant& now, double* rates) {
    const double led_W = lead_W_per_K * state[0];
    rates[0] = (now.brake_N * now.speed_m_s - led_W - air_W_per_K(now.speed_m_s) * state[0]) / disc_J_per_K;
    rates[1] = passed * led_W - state[1] / rim_s;
  };
}

/// A share of the brake's power, delayed by the rim alone.
void make_share(Making& of) {
  const double share = 0.01 * of.size;
  const double delay_s = 60.0 * of.draw("delay_min", log_normal(3.0, 30.0, 2.5, 30.0));
  const double gas_share = of.draw("gas_share", uniform(0.1, 0.5));
  of.effect.state_count = 1;
  of.effect.act = [=](const double* bound_J, Instant& now) { heat_tire(bound_J[0], delay_s, gas_share, now); };
  of.effect.rates = [=](const double* bound_J, const Instant& now, double* rates) {
    rates[0] = share * now.brake_N * now.speed_m_s - bound_J[0] / delay_s;
  };
}

const EffectKind kind{
    "brake_heat",
    {"percent", "share of the brake power that reaches the tire in town, where the disc is cooled at 40 km/h", 0.0, 0.0,
     100.0, log_normal(2.0, 15.0, 1.5, 20.0)},
    {{"disc_and_rim",
      "excess heat in a disc that loses to the air faster with speed, led to a rim and from there to bead and gas",
      make_disc_and_rim},
     {"share", "a fixed share of the brake's power, late by one first-order delay, whatever the speed", make_share}},
    on_vehicles,
    on_rollers};

}  // namespace rollrig::generator::brake_heat
