/// Outside of the catalog: for parts of a trip the vehicle drives in the wake of another.
#include <array>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::drafting {

void make_drafting(Making& of) {
  const double share = 0.01 * of.size;
  std::array<double, 2> phases{};
  for (double& phase : phases) phase = of.draws.uniform(0.0, 6.2831853);
  const double meeting_m = 1e3 * of.draws.uniform(3.0, 10.0);
  of.note("meeting_km", 1e-3 * meeting_m);
  of.effect.state_count = 1;
  of.effect.start = [](const RunStart& start, double* run) { run[0] = static_cast<double>(start.index); };
  of.effect.act = [=](const double* run, Instant& now) {
    const double turn = 6.2831853 * now.distance_m / meeting_m + 1.7 * run[0];
    const double near =
        0.5 * (1.0 + std::tanh(3.0 * (std::sin(turn + phases[0]) + 0.5 * std::sin(0.37 * turn + phases[1]))));
    now.drag_factor *= 1.0 - share * near;
  };
}

const EffectKind kind{"drafting",
                      {"percent", "drag saved in the wake", 0.0, 0.0, 80.0, log_normal(10.0, 30.0, 8.0, 40.0)},
                      {{"only", "the drag falls and comes back over stretches of some km", make_drafting}},
                      on_roads,
                      on_roads,
                      true};

}  // namespace rollrig::generator::drafting
