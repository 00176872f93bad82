/// Outside of the catalog: the cover of drum or roller rubs once the rig has warmed and its gap is closed.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::cover_rub {

/// Coulomb friction whose pressure grows with the overlap until the sheet yields, F (1 - exp(-(w - g)/0.3)) above the
/// gap g; warmth w of first order towards x^1.5, x = v/(80 km/h), between the powers of friction and of air drag.
/// Assumed: time constant, gap and yield.
void make_cover_rub(Making& of) {
  constexpr double kYield = 0.3;
  const double force_N = of.size;
  const double time_s = of.draw_min("time_constant_min", uniform(8.0, 30.0));
  const double gap = of.draw("gap_over_warmth_at_80_km_h", uniform(0.15, 0.5));
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* warmth) { warmth[0] = start.left_after_rest(time_s); };
  of.effect.act = [=](const double* warmth, Instant& now) {
    now.rig_force_N += force_N * -std::expm1(-std::max(0.0, warmth[0] - gap) / kYield);
  };
  of.effect.rates = [=](const double* warmth, const Instant& now, double* rates) {
    rates[0] = (std::pow(now.speed_m_s / kSpeed80_m_s, 1.5) - warmth[0]) / time_s;
  };
}

const EffectKind kind{
    "cover_rub",
    {"N", "friction where the cover lies fully on", 0.0, 0.0, 50.0, log_normal(0.25, 2.0, 0.15, 3.0)},
    {{"only", "nothing until the rig has warmed by running, then a friction at any speed until it cools",
      make_cover_rub}},
    on_rigs,
    on_rigs,
    true,
    OutsideList::kSecond};

}  // namespace rollrig::generator::cover_rub
