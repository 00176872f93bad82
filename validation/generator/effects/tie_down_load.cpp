/// Straps press the wheels onto the rollers: they creep and are tightened by the pull, or they relax.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::tie_down_load {

void make_creeping(Making& of) {
  const double load_N = of.size;
  const double creep = of.draw("creep_a_decade", uniform(0.0, 0.08));
  const double pull = of.draw("N_per_N_of_pull_at_200_N", uniform(0.0, 0.08));
  of.effect.enter = [=](const double*, Instant& now) {
    const double slack = creep * std::log10(1.0 + now.time_s / 60.0);
    const double pull_N = pull * load_N / 200.0 * std::abs(now.longitudinal_N);
    now.load_N += load_N * (1.0 - slack) + pull_N;
  };
}

/// Load L (1 - r (1 - exp(-t/tau))) from tying down at the start of a run on.
void make_relaxing(Making& of) {
  const double load_N = of.size;
  const double relaxing = of.draw("relaxing_share", uniform(0.0, 0.25));
  const double time_s = of.draw_min("time_constant_min", uniform(5.0, 30.0));
  of.effect.enter = [=](const double*, Instant& now) {
    now.load_N += load_N * (1.0 + relaxing * std::expm1(-now.time_s / time_s));
  };
}

const EffectKind kind{
    "tie_down_load",
    {"N", "further load of one wheel, just tied down", 0.0, -500.0, 3000.0, log_normal(50.0, 400.0, 30.0, 600.0)},
    {{"creeping", "falls with the logarithm of time as straps creep, rises with the pull of the wheel", make_creeping},
     {"relaxing", "straps of a spring and a damper relax to a lower load over minutes, whatever the wheel does",
      make_relaxing}},
    on_rollers,
    on_rollers};

}  // namespace rollrig::generator::tie_down_load
