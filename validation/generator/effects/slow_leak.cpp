/// Gas is lost through a small hole, or through the rubber.
#include <algorithm>
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator::slow_leak {

constexpr double kAir_kPa = 101.325;

/// Amount in the cavity at the reference pressure and 25 degC: the cavity holds n = p V/(R T).
double find_reference_mol(const Instant& now) {
  const double abs_kPa = now.pressure_kPa + kAir_kPa;
  return now.gas_mol * (now.specimen->reference_pressure_kPa + kAir_kPa) / abs_kPa * (now.gas_degC + kZeroCelsius_K) /
         298.15;
}

/// `find_relative`: flow over that to which the size refers.
template <class Relative>
void add_leak(Making& of, const Relative& find_relative) {
  const double rate_kPa_per_h = of.size;
  of.effect.act = [=](const double*, Instant& now) {
    // The rate of the size holds at the reference pressure; n falls as p does at constant temperature.
    const double reference_abs_kPa = now.specimen->reference_pressure_kPa + kAir_kPa;
    const double per_s = rate_kPa_per_h / 3600.0 / reference_abs_kPa;
    now.leak_mol_s += per_s * find_relative(now) * find_reference_mol(now);
  };
}

/// Flow through a nozzle, but for factors: sonic above 1.893 times the pressure outside (Saint-Venant, Wantzel).
double calc_flow(double abs_kPa) {
  constexpr double kGamma = 1.4;
  const double ratio = std::max(kAir_kPa / abs_kPa, std::pow(2.0 / (kGamma + 1.0), kGamma / (kGamma - 1.0)));
  return abs_kPa * std::sqrt(std::max(0.0, std::pow(ratio, 2.0 / kGamma) - std::pow(ratio, (kGamma + 1.0) / kGamma)));
}

void make_nozzle(Making& of) {
  add_leak(of, [](const Instant& now) {
    const double abs_kPa = std::max(0.0, now.pressure_kPa) + kAir_kPa;
    const double reference_abs_kPa = now.specimen->reference_pressure_kPa + kAir_kPa;
    return calc_flow(abs_kPa) / calc_flow(reference_abs_kPa) * std::sqrt(298.15 / (now.gas_degC + kZeroCelsius_K));
  });
}

/// Driven by the difference of pressures, faster in warm rubber.
void make_permeation(Making& of) {
  const double activation_K = of.note("activation_K", of.draws.uniform(25e3, 45e3) / kGasConstant_J_per_mol_K);
  add_leak(of, [=](const Instant& now) {
    const double warm_K = now.liner_degC + kZeroCelsius_K;
    return now.pressure_kPa / now.specimen->reference_pressure_kPa *
           std::exp(activation_K * (1.0 / 313.15 - 1.0 / warm_K));
  });
}

const EffectKind kind{
    "slow_leak",
    {"kPa/h",
     "loss of pressure at the reference pressure; through a hole with gas at 25 degC, through rubber at 40 degC", 0.0,
     0.0, 50.0, log_normal(0.2, 2.0, 0.1, 3.5)},
    {{"nozzle", "a nozzle (Saint-Venant and Wantzel, sonic here); what leaves takes its enthalpy along", make_nozzle},
     {"permeation",
      "with the gauge pressure, and by Arrhenius' law faster in warm rubber; what leaves takes its enthalpy along",
      make_permeation}}};

}  // namespace rollrig::generator::slow_leak
