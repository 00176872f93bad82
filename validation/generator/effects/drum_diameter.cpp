/// Between machines: the drum is larger or smaller than its file says.
#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator::drum_diameter {

/// The speed is measured at the surface.
void make_at_surface(Making& of) {
  const double size = 1.0 + 0.01 * of.size;
  of.effect.rebuild = [size](Specimen& machine) { machine.drum_diameter_m *= size; };
}

/// The speed is counted in turns of the drum.
void make_counted(Making& of) {
  make_at_surface(of);
  const double size = 1.0 + 0.01 * of.size;
  of.effect.true_speed_m_s = [size](double recorded_m_s) { return size * recorded_m_s; };
}

bool on_drums(const Ground& ground) { return on_carriages(ground) && ground.machine.is_near_reference_drum; }

const EffectKind kind{
    "drum_diameter",
    {"percent", "true over stated diameter of the drum, less one", 0.0, -20.0, 20.0, log_normal(0.3, 1.8, 0.2, 2.5),
     true},
    {{"at_surface", "lever of the torque, curvature and inertia by the true diameter; speed measured at the surface",
      make_at_surface},
     {"counted", "the same, and the speed counted in turns of the stated diameter", make_counted}},
    on_drums,
    on_drums,
    true,
    OutsideList::kBetweenMachines};

}  // namespace rollrig::generator::drum_diameter
