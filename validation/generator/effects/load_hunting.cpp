/// Outside of the catalog: for some minutes at a time the control loop of the load hunts about the set load.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::load_hunting {

/// A valve that sticks under integral control jumps between two openings, so that the load is nearly a square wave:
/// 1.0 the amplitude. Assumed: the period, and how long it hunts and rests.
void make_load_hunting(Making& of) {
  constexpr double kTurn = 6.2831853;
  const double share = of.size / of.specimen.reference_load_N;
  const double period_s = of.draw("period_s", uniform(40.0, 150.0));
  const double spell_s = of.draw("spell_and_rest_s", uniform(700.0, 1800.0));
  const double phase = of.draws.uniform(0.0, kTurn);
  of.effect.state_count = 1;
  of.effect.start = [](const RunStart& start, double* run) { run[0] = static_cast<double>(start.index); };
  of.effect.enter = [=](const double* run, Instant& now) {
    const double hunting = 0.5 * (1.0 + std::tanh(8.0 * std::sin(kTurn * now.time_s / spell_s + phase + 2.3 * run[0])));
    const double wave = std::tanh(2.5 * std::sin(kTurn * now.time_s / period_s + 1.3 * run[0]));
    now.load_N += share * now.target_load_N * hunting * wave;
  };
}

const EffectKind kind{
    "load_hunting",
    {"N", "half of the swing of the load, at the reference load", 0.0, 0.0, 1000.0,
     log_normal(25.0, 150.0, 20.0, 200.0)},
    {{"only", "a rounded square wave about the set load, in proportion to it, in spells of some minutes",
      make_load_hunting}},
    on_carriages,
    on_carriages,
    true,
    OutsideList::kSecond};

}  // namespace rollrig::generator::load_hunting
