/// Oil of axle and wheel bearings: viscosity by Vogel or by Walther, warmed by its own friction.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::driveline_warming {

constexpr double kHeating = 1.6;  // Assumed: of the steady rise, with oil as cold as soaked

/// What both oils have in common: how soon and how far they warm, and that a rest cools them.
struct Oil {
  double time_s = 0.0;
  double rise_dK = 0.0;
};

Oil draw_oil(Making& of) {
  Oil oil;
  oil.time_s = of.draw_min("time_constant_min", log_normal(15.0, 60.0, 11.0, 80.0));
  oil.rise_dK = of.draw("rise_dK", uniform(20.0, 50.0));
  of.effect.state_count = 1;
  of.effect.start = [oil](const RunStart& start, double* rise_dK) {
    rise_dK[0] = 0.7 * oil.rise_dK * start.left_after_rest(oil.time_s);
  };
  return oil;
}

void make_vogel(Making& of) {
  const double force_N = of.size;
  const Oil oil = draw_oil(of);
  const double viscous_power = of.draw("power_of_viscosity", uniform(0.4, 0.7));
  const double air_share = of.draw("share_of_ambient", uniform(0.0, 0.4));
  // Friction over that of oil at 23 degC.
  const auto friction = [=](const double* rise_dK, const Instant& now) {
    constexpr double kVogel_K = 900.0;
    constexpr double kVogel_degC = 110.0;
    constexpr double kSoaked_degC = 23.0;
    const double oil_degC = kSoaked_degC + rise_dK[0] + air_share * (now.ambient_degC - kSoaked_degC);
    return std::exp(viscous_power * kVogel_K * (1.0 / (oil_degC + kVogel_degC) - 1.0 / (kSoaked_degC + kVogel_degC)));
  };
  of.effect.act = [=](const double* rise_dK, Instant& now) { now.rig_force_N += force_N * friction(rise_dK, now); };
  of.effect.rates = [=](const double* rise_dK, const Instant& now, double* rates) {
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double transmitted = 0.3 * std::abs(now.longitudinal_N) / 500.0;
    rates[0] = (oil.rise_dK * x * (kHeating * friction(rise_dK, now) + transmitted) - rise_dK[0]) / oil.time_s;
  };
}

/// mm2/s; Assumed: 100 at 40 degC and 15 at 100 degC, as makers of such oils say.
double calc_viscosity(double oil_K) {
  return std::pow(10.0, std::pow(10.0, 7.6437 - 2.9418 * std::log10(oil_K))) - 0.7;
}

/// Gear oil 75W-90 by Walther's law, log log(nu + 0.7) = A - B log T, beside a part that does not feel the oil.
void make_walther(Making& of) {
  const double force_N = of.size;
  const Oil oil = draw_oil(of);
  const double viscous_power = of.draw("power_of_viscosity", uniform(0.4, 0.6));
  const double dry = of.draw("mechanical_share", uniform(0.1, 0.3));
  // Friction over that of oil at 23 degC.
  const auto friction = [=](double rise_dK) {
    constexpr double kSoaked_K = 296.15;
    const double thinner = calc_viscosity(kSoaked_K + rise_dK) / calc_viscosity(kSoaked_K);
    return dry + (1.0 - dry) * std::pow(thinner, viscous_power);
  };
  of.effect.act = [=](const double* rise_dK, Instant& now) { now.rig_force_N += force_N * friction(rise_dK[0]); };
  of.effect.rates = [=](const double* rise_dK, const Instant& now, double* rates) {
    rates[0] = (kHeating * oil.rise_dK * now.speed_m_s / kSpeed80_m_s * friction(rise_dK[0]) - rise_dK[0]) / oil.time_s;
  };
}

const EffectKind kind{
    "driveline_warming",
    {"N", "friction of one wheel, soaked at 23 degC", 0.0, 0.0, 200.0, log_normal(3.0, 25.0, 2.0, 35.0)},
    {{"vogel",
      "power of a viscosity by Vogel, at the temperature of oil that its own friction and the transmitted force warm",
      make_vogel},
     {"walther",
      "a mechanical part beside a power of the viscosity of gear oil by Walther (ASTM D341), at the temperature of oil "
      "that its own friction warms",
      make_walther}},
    on_vehicles,
    on_vehicles};

}  // namespace rollrig::generator::driveline_warming
