/// A flat from standing, rolled out by distance, the faster the warmer the rubber.
#include <array>
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator::flat_spot {

void make_two_depths(Making& of) {
  const double excess = 0.01 * of.size;
  const double distance_km = of.draw("distance_km_at_35_degC", log_normal(4.0, 15.0, 3.0, 20.0));
  const double apart = of.draw("distances_apart", uniform(1.2, 1.8));
  const double set_s = 3600.0 * of.draw("set_time_h", log_normal(0.7, 4.0, 0.4, 6.0));
  const double doubling_K = of.draw("doubling_K", uniform(20.0, 45.0));
  const std::array<double, 2> distance_m{1e3 * distance_km / apart, 1e3 * distance_km * apart};
  of.effect.state_count = 2;
  of.effect.start = [=](const RunStart& start, double* flat) { flat[0] = flat[1] = start.recovered_in_rest(set_s); };
  of.effect.act = [=](const double* flat, Instant& now) {
    now.loss_factor *= 1.0 + 0.5 * excess * (flat[0] * flat[0] + flat[1] * flat[1]);
  };
  of.effect.rates = [=](const double* flat, const Instant& now, double* rates) {
    const double pace = std::exp2((now.rubber_degC - 35.0) / doubling_K);
    for (std::size_t i = 0; i < 2; ++i) rates[i] = -0.5 * flat[i] * pace * now.speed_m_s / distance_m[i];
  };
}

/// One depth d, d' = -d^2 v/s_0, faster in warm rubber by Arrhenius' law; the loss is in proportion to it.
void make_second_order(Making& of) {
  constexpr double kHalf = 0.69314718;  // ln 2
  const double excess = 0.01 * of.size;
  // Half is gone when it is of a first-order decay.
  const double distance_m = kHalf * 1e3 * of.draw("distance_km_at_35_degC", log_normal(4.0, 15.0, 3.0, 20.0));
  const double set_s = 3600.0 * of.draw("set_time_h", log_normal(0.7, 4.0, 0.4, 6.0));
  const double activation_K = of.note("activation_K", of.draws.uniform(15e3, 35e3) / kGasConstant_J_per_mol_K);
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* flat) { flat[0] = start.recovered_in_rest(set_s); };
  of.effect.act = [=](const double* flat, Instant& now) { now.loss_factor *= 1.0 + excess * flat[0]; };
  of.effect.rates = [=](const double* flat, const Instant& now, double* rates) {
    const double pace = std::exp(activation_K * (1.0 / 308.15 - 1.0 / (now.rubber_degC + kZeroCelsius_K)));
    rates[0] = -flat[0] * std::abs(flat[0]) * pace * now.speed_m_s / distance_m;
  };
}

const EffectKind kind{
    "flat_spot",
    {"percent", "higher loss after long standing", 0.0, 0.0, 100.0, log_normal(1.0, 8.0, 0.6, 12.0)},
    {{"two_depths", "square of a depth of two parts, each rolled out over its own distance, faster in warm rubber",
      make_two_depths},
     {"second_order",
      "one depth, rolled out over distance by a law of second order, 1/(1 + s/s_0), with Arrhenius' law of the "
      "temperature; loss in proportion to it",
      make_second_order}},
    everywhere,
    on_rigs};

}  // namespace rollrig::generator::flat_spot
