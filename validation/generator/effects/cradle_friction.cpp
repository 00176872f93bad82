/// Outside of the catalog: friction in the bearings of the cradle holds back part of a change of the measured force.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::cradle_friction {

/// Play (Prandtl): the reading follows the force at most by the half width; vibration lets it creep back, the faster
/// the surface turns. Assumed: the pace of the creep.
void make_cradle_friction(Making& of) {
  const double half_N = of.size;
  const double creep_s = of.draw_min("creep_min_at_80_km_h", uniform(4.0, 20.0));
  of.effect.trace = [=](RunRecord& record) {
    const double half = record.lever * half_N;
    double reading = record.force.front();
    for (std::size_t row = 1; row < record.force.size(); ++row) {
      const double pace = record.speed_km_h[row] / 80.0 / creep_s;
      const double force = record.force[row];
      reading += (force - reading) * -std::expm1(-(record.time_s[row] - record.time_s[row - 1]) * pace);
      reading = std::clamp(reading, force - half, force + half);
      record.force[row] = reading;
    }
  };
}

const EffectKind kind{
    "cradle_friction",
    {"N", "half of the width of the hysteresis of the reading", 0.0, 0.0, 50.0, log_normal(0.2, 1.5, 0.15, 2.5)},
    {{"only", "play between force and reading, which creeps back as the rig runs", make_cradle_friction}},
    on_rigs,
    on_rigs,
    true,
    OutsideList::kSecond};

}  // namespace rollrig::generator::cradle_friction
