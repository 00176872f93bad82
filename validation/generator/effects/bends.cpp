/// Outside of the catalog: bends of the road, where side forces drag.
#include <array>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::bends {

/// Drag Fy^2/C of the side force Fy = m a over the cornering stiffness C (resistance in bends; Mitschke and
/// Wallentowitz, "Dynamik der Kraftfahrzeuge"): 120 N for 1.8 t, 3 m/s2 and 240 kN. Faster roads have wider bends, so
/// that a in the tightest goes with 2 x^2/(1 + x^2), x = v/(80 km/h) (assumed).
void make_bends(Making& of) {
  constexpr double kTurn = 6.2831853;
  const double drag_N = of.size;
  const double bend_m = of.draw("bend_m", uniform(250.0, 600.0));
  const double winding_m = 1e3 * of.draw("winding_km", uniform(3.0, 8.0));
  std::array<double, 2> phases{};
  for (double& phase : phases) phase = of.draws.uniform(0.0, kTurn);
  of.effect.state_count = 1;
  of.effect.start = [](const RunStart& start, double* run) { run[0] = static_cast<double>(start.index); };
  of.effect.act = [=](const double* run, Instant& now) {
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double winding =
        0.5 * (1.0 + std::tanh(3.0 * std::sin(kTurn * now.distance_m / winding_m + phases[0] + 2.7 * run[0])));
    const double curvature = winding * std::sin(0.5 * kTurn * now.distance_m / bend_m + phases[1]);
    const double acceleration = 2.0 * x * x / (1.0 + x * x) * curvature;  // over that in the tightest at 80 km/h
    now.body_force_N += drag_N * acceleration * acceleration;
  };
}

const EffectKind kind{
    "bends",
    {"N", "drag of the whole vehicle at 80 km/h in the tightest bends", 0.0, 0.0, 1000.0,
     log_normal(50.0, 200.0, 40.0, 300.0)},
    {{"only", "square of a side acceleration, bend by bend on winding stretches of some km", make_bends}},
    on_roads,
    on_roads,
    true,
    OutsideList::kSecond};

}  // namespace rollrig::generator::bends
