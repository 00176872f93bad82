/// Rubber that has rested loses more: its structure breaks down and builds up, in two parts or by a second order.
#include <algorithm>
#include <array>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::rubber_memory {

void make_two_parts(Making& of) {
  const double excess = 0.01 * of.size;
  const double decay_min = of.draws.from(log_normal(3.0, 20.0, 2.0, 30.0));
  const double apart = of.draws.uniform(1.2, 2.0);
  const double recovery_min = of.draws.from(log_normal(8.0, 60.0, 5.0, 120.0));
  const double weight = of.draws.uniform(0.35, 0.65);
  of.effect.shape = {{"decay_min", decay_min},
                     {"recovery_min", recovery_min},
                     {"time_constants_apart", apart},
                     {"weight_of_fast", weight}};
  const std::array<double, 2> decay_s{60.0 * decay_min / apart, 60.0 * decay_min * apart};
  const std::array<double, 2> recovery_s{60.0 * recovery_min / apart, 60.0 * recovery_min * apart};
  of.effect.state_count = 2;
  of.effect.start = [=](const RunStart& start, double* rested) {
    // Not soaked: worked in before the rest.
    for (std::size_t i = 0; i < 2; ++i) rested[i] = start.recovered_in_rest(recovery_s[i]);
  };
  of.effect.act = [=](const double* rested, Instant& now) {
    now.loss_factor *= 1.0 + excess * (weight * rested[0] + (1.0 - weight) * rested[1]);
  };
  of.effect.rates = [=](const double* rested, const Instant& now, double* rates) {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double work = load * load / (load * load + 0.02) * now.speed_m_s / (now.speed_m_s + 1.0);
    for (std::size_t i = 0; i < 2; ++i) {
      rates[i] = (1.0 - rested[i]) * (1.0 - work) / recovery_s[i] - rested[i] * work / decay_s[i];
    }
  };
}

/// Structure that breaks down in pairs of bonds, ds/dt = -s^2 w/tau, as Kraus has it for filled rubber.
void make_second_order(Making& of) {
  constexpr double kHalf = 0.69314718;  // ln 2
  const double excess = 0.01 * of.size;
  // Half is gone when it is of a first-order decay.
  const double decay_s = kHalf * 60.0 * of.draw("decay_min", log_normal(3.0, 20.0, 2.0, 30.0));
  const double recovery_s = 60.0 * of.draw("recovery_min", log_normal(8.0, 60.0, 5.0, 120.0));
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* rested) { rested[0] = start.recovered_in_rest(recovery_s); };
  of.effect.act = [=](const double* rested, Instant& now) { now.loss_factor *= 1.0 + excess * rested[0]; };
  of.effect.rates = [=](const double* rested, const Instant& now, double* rates) {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double strained = load / (load + 0.15);  // Assumed: half worked at 15 % of the reference load
    const double work = strained * now.speed_m_s / (now.speed_m_s + 1.0);
    rates[0] = (1.0 - rested[0]) * (1.0 - work) / recovery_s - rested[0] * std::abs(rested[0]) * work / decay_s;
  };
}

const EffectKind kind{
    "rubber_memory",
    {"percent", "higher loss after long rest", 0.0, 0.0, 100.0, log_normal(1.0, 8.0, 0.6, 12.0)},
    {{"two_parts",
      "two parts that break down under load and build up at rest or in skim, each with its own time constants: a "
      "stretched decay; work saturates with the square of the load",
      make_two_parts},
     {"second_order",
      "one structure that breaks down by a law of second order, 1/(1 + t/tau), while it is worked, and builds up at "
      "rest or in skim by one of first order",
      make_second_order}}};

}  // namespace rollrig::generator::rubber_memory
