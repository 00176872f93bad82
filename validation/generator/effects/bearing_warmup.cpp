/// Grease of the rig's bearings, thinner as the bearings' own friction warms it: by Vogel's law, or by Arrhenius'.
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator::bearing_warmup {

constexpr double kSoaked_degC = 25.0;

/// Friction at 80 km/h at which c0 and c1 were taken.
double find_cold_N(const Specimen& specimen) {
  return specimen.truth(Base::kC0) + specimen.truth(Base::kC1) * kSpeed80_m_s;
}

/// Cooling over that at 80 km/h.
double calc_cooling(double forced_share, double speed_m_s) {
  return 1.0 - forced_share + forced_share * std::pow(speed_m_s / kSpeed80_m_s, 0.8);
}

void make_vogel(Making& of) {
  const double steady_dK = of.draw("rise_dK", log_normal(8.0, 25.0, 5.0, 35.0));
  const double time_s = 60.0 * of.draw("time_constant_min", log_normal(10.0, 60.0, 6.0, 90.0));
  const double warm_share = of.draw("reference_share", uniform(0.7, 1.2));
  const double vogel_degC = of.draw("vogel_degC", uniform(90.0, 135.0));
  const double forced_share = of.draw("forced_cooling_share", uniform(0.2, 0.6));
  const double reference_degC = kSoaked_degC + warm_share * steady_dK;
  const double warm_degC = kSoaked_degC + steady_dK;
  const double vogel_K = of.size * (kSoaked_degC + vogel_degC) * (warm_degC + vogel_degC);
  // Viscosity over that at which c0 and c1 were taken.
  const auto thinning = [=](double bearing_degC) {
    return std::exp(vogel_K / (bearing_degC + vogel_degC) - vogel_K / (reference_degC + vogel_degC));
  };
  const double cooling_W_per_K = thinning(warm_degC) * find_cold_N(of.specimen) * kSpeed80_m_s / steady_dK;
  const double capacity_J_per_K = time_s * cooling_W_per_K;
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* rise_dK) {
    // Not soaked: warm before the rest. Standing, only the unforced share of the cooling acts.
    rise_dK[0] = steady_dK * start.left_after_rest(time_s, 1.0 - forced_share);
  };
  of.effect.act = [=](const double* rise_dK, Instant& now) {
    now.bearing_factor *= thinning(now.ambient_degC + rise_dK[0]);
  };
  of.effect.rates = [=](const double* rise_dK, const Instant& now, double* rates) {
    const double lost_W = cooling_W_per_K * calc_cooling(forced_share, now.speed_m_s) * rise_dK[0];
    rates[0] = (now.bearing_N * now.speed_m_s - lost_W) / capacity_J_per_K;
  };
}

/// Viscosity by Arrhenius' law at the temperature of the races, which warm a housing.
void make_arrhenius(Making& of) {
  const double steady_dK = of.draw("rise_dK", log_normal(8.0, 25.0, 5.0, 35.0));
  const double time_s = 60.0 * of.draw("time_constant_min", log_normal(10.0, 60.0, 6.0, 90.0));
  const double warm_share = of.draw("reference_share", uniform(0.7, 1.2));
  const double forced_share = of.draw("forced_cooling_share", uniform(0.2, 0.6));
  // Assumed: of the rise, between races and housing
  const double race_share = of.draw("share_between_race_and_housing", uniform(0.1, 0.35));
  const double race_s = 60.0 * of.draw("race_min", uniform(2.0, 6.0));
  const double reference_K = kSoaked_degC + warm_share * steady_dK + kZeroCelsius_K;
  const double soaked_K = kSoaked_degC + kZeroCelsius_K;
  const double activation_K = of.size * soaked_K * (soaked_K + steady_dK);
  const auto thinning = [=](double race_K) { return std::exp(activation_K * (1.0 / race_K - 1.0 / reference_K)); };
  const double steady_W = thinning(soaked_K + steady_dK) * find_cold_N(of.specimen) * kSpeed80_m_s;
  const double link_W_per_K = steady_W / (race_share * steady_dK);
  const double cooling_W_per_K = steady_W / ((1.0 - race_share) * steady_dK);
  of.effect.state_count = 2;  // rise of races and of housing
  of.effect.start = [=](const RunStart& start, double* rise_dK) {
    rise_dK[1] = (1.0 - race_share) * steady_dK * start.left_after_rest(time_s, 1.0 - forced_share);
    rise_dK[0] = rise_dK[1] + race_share * steady_dK * start.left_after_rest(race_s);
  };
  of.effect.act = [=](const double* rise_dK, Instant& now) {
    now.bearing_factor *= thinning(now.ambient_degC + rise_dK[0] + kZeroCelsius_K);
  };
  of.effect.rates = [=](const double* rise_dK, const Instant& now, double* rates) {
    const double lost_W = cooling_W_per_K * calc_cooling(forced_share, now.speed_m_s) * rise_dK[1];
    const double to_housing_W = link_W_per_K * (rise_dK[0] - rise_dK[1]);
    rates[0] = (now.bearing_N * now.speed_m_s - to_housing_W) / (race_s * link_W_per_K);
    rates[1] = (to_housing_W - lost_W) / (time_s * cooling_W_per_K);
  };
}

const EffectKind kind{
    "bearing_warmup",
    {"1/K", "relative fall of c0 + c1 v per K, from soaked at 25 degC to steady at 80 km/h", 0.0, 0.0, 0.2,
     log_normal(0.005, 0.04, 0.002, 0.06)},
    {{"vogel",
      "grease by Vogel's law exp(V/(T_b + T_V)) on c0 + c1 v alone, not on the drum's air drag; T_b warmed by the "
      "bearings' own friction power, cooled faster with speed",
      make_vogel},
     {"arrhenius",
      "grease by Arrhenius' law on c0 + c1 v alone; its friction warms races, these a housing that is cooled faster "
      "with speed",
      make_arrhenius}}};

}  // namespace rollrig::generator::bearing_warmup
