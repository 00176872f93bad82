/// Heat goes from tire and gas to a rim of two parts, or of one.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::rim_heat {

/// What the rim takes.
struct Taken {
  double gas_W = 0.0;
  double bead_W = 0.0;
};

/// From a tire of so many W/K to the rim, of which a share leads from the gas.
auto draw_link(Making& of) {
  const double tire_W_per_K = of.size;
  const double gas_share = of.draw("gas_share", uniform(0.2, 0.7));
  const auto find_taken = [=](double rim_degC, const Instant& now) {
    return Taken{gas_share * tire_W_per_K * (now.gas_degC - rim_degC),
                 (1.0 - gas_share) * tire_W_per_K * (now.liner_degC - rim_degC)};
  };
  of.effect.act = [=](const double* rim_degC, Instant& now) {
    const Taken taken = find_taken(rim_degC[0], now);
    now.gas_heat_W -= taken.gas_W;
    now.liner_heat_W -= taken.bead_W;
  };
  return [=](double rim_degC, const Instant& now) {
    const Taken taken = find_taken(rim_degC, now);
    return taken.gas_W + taken.bead_W;
  };
}

void make_well_and_disc(Making& of) {
  const auto find_taken_W = draw_link(of);
  const double capacity_J_per_K = of.draw("capacity_J_per_K", log_normal(5000.0, 9000.0, 4000.0, 11000.0));
  const double well_share = of.draw("well_share", uniform(0.35, 0.6));
  const double spokes_W_per_K = of.draw("spokes_W_per_K", log_normal(8.0, 30.0, 5.0, 50.0));
  const double at_80_W_per_K = of.draw("air_W_per_K_at_80_km_h", log_normal(6.0, 20.0, 4.0, 30.0));
  const double still_share = of.draw("still_share", uniform(0.15, 0.4));
  const double power = of.draw("air_power", uniform(0.5, 0.8));
  of.effect.state_count = 2;
  of.effect.start = [](const RunStart& start, double* rim_degC) { rim_degC[0] = rim_degC[1] = start.initial_degC; };
  of.effect.rates = [=](const double* rim_degC, const Instant& now, double* rates) {
    const double air_W_per_K =
        at_80_W_per_K * (still_share + (1.0 - still_share) * std::pow(now.speed_m_s / kSpeed80_m_s, power));
    const double spokes_W = spokes_W_per_K * (rim_degC[0] - rim_degC[1]);
    const double well_W = 0.4 * air_W_per_K * (rim_degC[0] - now.ambient_degC);  // Assumed: the disc has more area
    const double disc_W = 0.6 * air_W_per_K * (rim_degC[1] - now.ambient_degC);
    rates[0] = (find_taken_W(rim_degC[0], now) - spokes_W - well_W) / (well_share * capacity_J_per_K);
    rates[1] = (spokes_W - disc_W) / ((1.0 - well_share) * capacity_J_per_K);
  };
}

/// One node for the whole rim, cooled by s + (1 - s) v.
void make_one_node(Making& of) {
  const auto find_taken_W = draw_link(of);
  const double capacity_J_per_K = of.draw("capacity_J_per_K", log_normal(5000.0, 9000.0, 4000.0, 11000.0));
  const double at_80_W_per_K = of.draw("air_W_per_K_at_80_km_h", log_normal(6.0, 20.0, 4.0, 30.0));
  const double still_share = of.draw("still_share", uniform(0.15, 0.5));
  of.effect.state_count = 1;
  of.effect.start = [](const RunStart& start, double* rim_degC) { rim_degC[0] = start.initial_degC; };
  of.effect.rates = [=](const double* rim_degC, const Instant& now, double* rates) {
    const double air_W_per_K = at_80_W_per_K * (still_share + (1.0 - still_share) * now.speed_m_s / kSpeed80_m_s);
    rates[0] = (find_taken_W(rim_degC[0], now) - air_W_per_K * (rim_degC[0] - now.ambient_degC)) / capacity_J_per_K;
  };
}

const EffectKind kind{
    "rim_heat",
    {"W/K", "conductance from gas and bead to the rim", 0.0, 0.0, 50.0, log_normal(0.5, 4.0, 0.3, 6.5)},
    {{"well_and_disc",
      "rim of two parts: the well takes heat from gas and bead, spokes lead it to the disc, both lose to the air with "
      "a power of the speed",
      make_well_and_disc},
     {"one_node",
      "rim of one node that takes heat from gas and bead and loses to the air in a straight line of the speed",
      make_one_node}}};

}  // namespace rollrig::generator::rim_heat
