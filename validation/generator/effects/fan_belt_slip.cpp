/// Outside of the catalog: the belt of the fan in front of the wheel slips for some minutes now and then.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::fan_belt_slip {

/// A fan takes a torque of v^2, so that a slack belt slips more at speed. Assumed: how it grows, and the spells.
void make_fan_belt_slip(Making& of) {
  constexpr double kTurn = 6.2831853;
  const double lost = 0.01 * of.size;
  const double spell_s = of.draw("spell_and_rest_s", uniform(600.0, 2000.0));
  const double grip = of.draw("torque_of_half_slip", uniform(0.2, 0.8));
  const double phase = of.draws.uniform(0.0, kTurn);
  of.effect.state_count = 1;
  of.effect.start = [](const RunStart& start, double* run) { run[0] = static_cast<double>(start.index); };
  of.effect.act = [=](const double* run, Instant& now) {
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double slack = 0.5 * (1.0 + std::tanh(6.0 * std::sin(kTurn * now.time_s / spell_s + phase + 1.9 * run[0])));
    const double slip = (1.0 + grip) * x * x / (x * x + grip);  // 1 at 80 km/h
    now.air_speed_m_s *= 1.0 - lost * slack * std::fmin(slip, 1.2);
  };
}

const EffectKind kind{
    "fan_belt_slip",
    {"percent", "of the air speed that is lost at 80 km/h while the belt slips", 0.0, 0.0, 80.0,
     log_normal(4.0, 25.0, 3.0, 40.0)},
    {{"only", "in spells of some minutes the air that cools the tire is slower than the roller, more at high speed",
      make_fan_belt_slip}},
    on_rollers,
    on_rollers,
    true,
    OutsideList::kSecond};

}  // namespace rollrig::generator::fan_belt_slip
