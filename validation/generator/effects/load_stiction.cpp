/// Outside of the catalog: the load cylinder sticks short of where it is sent.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::load_stiction {

void make_load_stiction(Making& of) {
  const double band_N = of.size;
  const double follows_s = of.draw("follows_s", uniform(0.5, 2.0));
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* piston_N) { piston_N[0] = start.first_load_N - band_N; };
  of.effect.enter = [=](const double* piston_N, Instant& now) {
    now.load_N += std::clamp(piston_N[0] - now.target_load_N, -band_N, band_N);
  };
  of.effect.rates = [=](const double* piston_N, const Instant& now, double* rates) {
    const double apart_N = now.target_load_N - piston_N[0];
    const double beyond_N = std::max(0.0, std::abs(apart_N) - band_N);
    rates[0] = std::copysign(beyond_N, apart_N) / follows_s;
  };
}

const EffectKind kind{
    "load_stiction",
    {"N", "half of the width of the hysteresis", 0.0, 0.0, 1000.0, log_normal(50.0, 160.0, 40.0, 180.0)},
    {{"only", "play: the load stays short by the size after a rise and above by it after a fall", make_load_stiction}},
    on_carriages,
    on_carriages,
    true};

}  // namespace rollrig::generator::load_stiction
