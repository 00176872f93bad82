/// More or less turns than is reckoned with, and hangs on softly.

#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator::inertia_error {

/// Adds the force of what turns and is not reckoned with: on the road to that of the vehicle, else to that of the rig.
auto find_excess(const Making& of) {
  const double radius_m = 0.5 * of.specimen.drum_diameter_m;
  const bool on_road = of.specimen.machine->has_vehicle();
  const double mass_kg = on_road ? of.specimen.truth(Base::kMass) + of.specimen.truth(Base::kRotatingMass)
                                 : of.specimen.drum_inertia_kg_m2 / (radius_m * radius_m);
  const double excess_kg = 0.01 * of.size * mass_kg;
  return [=](double acceleration_m_s2, Instant& now) {
    (on_road ? now.body_force_N : now.rig_force_N) += excess_kg * acceleration_m_s2;
  };
}

void make_rigid(Making& of) {
  of.effect.act = [add = find_excess(of)](const double*, Instant& now) { add(now.acceleration_m_s2, now); };
}

/// Follows the speed with a lag of first order.
void make_soft(Making& of) {
  // Assumed: response of a rig's simulation of inertia
  const double follows_s = of.draw("follows_s", uniform(0.05, 0.4));
  of.effect.state_count = 1;
  of.effect.act = [follows_s, add = find_excess(of)](const double* behind_m_s, Instant& now) {
    add(behind_m_s[0] / follows_s, now);
  };
  of.effect.rates = [=](const double* behind_m_s, const Instant& now, double* rates) {
    rates[0] = now.acceleration_m_s2 - behind_m_s[0] / follows_s;
  };
}

const EffectKind kind{
    "inertia_error",
    {"percent", "true over reckoned inertia of drum, roller or vehicle, less one", 0.0, -30.0, 30.0,
     log_normal(0.3, 4.0, 0.25, 6.0), true},
    {{"rigid", "a factor on the inertia", make_rigid},
     {"soft", "hanging on through a soft coupling that follows the speed with a lag of first order", make_soft}},
    everywhere,
    everywhere};

}  // namespace rollrig::generator::inertia_error
