/// The cavity shrinks under load and grows with speed, and works on its gas.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::cavity_volume {

constexpr double kReference_N = 5400.0;
constexpr double kFollows_s = 0.5;  // Assumed: about as the load settles

void make_power(Making& of) {
  const double shrink = 0.01 * of.size;
  const double load_power = of.draw("load_power", uniform(0.9, 1.5));
  const double growth = of.draw("growth_at_80_km_h_over_size", uniform(0.1, 0.5));
  const auto rate_per_s = [=](const double* state, const Instant& now) {
    const double load = std::max(0.0, now.load_N) / kReference_N;
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double aim = shrink * (growth * x * x - std::pow(load, load_power));
    return (aim - state[0]) / kFollows_s;
  };
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* state) {
    state[0] = -shrink * std::pow(std::max(0.0, start.first_load_N) / kReference_N, load_power);
  };
  of.effect.enter = [=](const double* state, Instant& now) {
    now.volume_factor *= 1.0 + state[0];
    now.volume_rate_per_s += rate_per_s(state, now);
  };
  of.effect.rates = [=](const double* state, const Instant& now, double* rates) { rates[0] = rate_per_s(state, now); };
}

/// The segment that the contact cuts off goes with d^(3/2), d = Fz/(s + (1 - s) p/p_ref) the deflection over that at
/// 5.4 kN and the reference pressure.
void make_segment(Making& of) {
  const double shrink = 0.01 * of.size;
  // Assumed: share of the stiffness without pressure
  const double carcass = of.draw("carcass_share", uniform(0.1, 0.4));
  const double growth = of.draw("growth_at_80_km_h_over_size", uniform(0.1, 0.5));
  const double reference_kPa = of.specimen.reference_pressure_kPa;
  const auto segment = [=](double load_N, double pressure_kPa) {
    const double stiffness = carcass + (1.0 - carcass) * pressure_kPa / reference_kPa;
    return std::pow(std::max(0.0, load_N) / kReference_N / stiffness, 1.5);
  };
  const auto rate_per_s = [=](const double* state, const Instant& now) {
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double aim = shrink * (growth * x * x - segment(now.load_N, now.pressure_kPa));
    return (aim - state[0]) / kFollows_s;
  };
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* state) {
    state[0] = -shrink * segment(start.first_load_N, start.cold_pressure_kPa);
  };
  of.effect.enter = [](const double* state, Instant& now) { now.volume_factor *= 1.0 + state[0]; };
  of.effect.act = [=](const double* state, Instant& now) { now.volume_rate_per_s += rate_per_s(state, now); };
  of.effect.rates = [=](const double* state, const Instant& now, double* rates) { rates[0] = rate_per_s(state, now); };
}

const EffectKind kind{
    "cavity_volume",
    {"percent", "smaller volume at 5.4 kN and the reference pressure than without load", 0.0, 0.0, 10.0,
     log_normal(0.15, 1.0, 0.1, 1.4)},
    {{"power",
      "a power of the load, and growth with v^2; the change does work on the gas, which warms or cools by it and comes "
      "back as heat flows; filled without load",
      make_power},
     {"segment",
      "the segment that the contact cuts off, deflection^(3/2), where the deflection is load over a stiffness that "
      "follows the pressure; growth with v^2; works on the gas",
      make_segment}}};

}  // namespace rollrig::generator::cavity_volume
