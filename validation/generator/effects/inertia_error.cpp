/// More or less turns than is reckoned with, and hangs on softly.

#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator {
namespace {

class RigidInertia : public Effect {
 public:
  explicit RigidInertia(const Making& of) : Effect(of) {
    const double radius_m = 0.5 * of.specimen.drum_diameter_m;
    on_road_ = of.specimen.machine->has_vehicle();
    const double mass_kg = on_road_ ? of.specimen.truth(Base::kMass) + of.specimen.truth(Base::kRotatingMass)
                                    : of.specimen.drum_inertia_kg_m2 / (radius_m * radius_m);
    excess_kg_ = 0.01 * of.size * mass_kg;
  }

  void act(const double*, Instant& now) const override { add(now.acceleration_m_s2, now); }

 protected:
  void add(double acceleration_m_s2, Instant& now) const {
    (on_road_ ? now.body_force_N : now.rig_force_N) += excess_kg_ * acceleration_m_s2;
  }

 private:
  double excess_kg_ = 0.0;
  bool on_road_ = false;
};

/// Follows the speed with a lag of first order.
class SoftInertia : public RigidInertia {
 public:
  using RigidInertia::RigidInertia;

  std::size_t state_count() const override { return 1; }

  void act(const double* behind_m_s, Instant& now) const override { add(behind_m_s[0] / follows_s_, now); }

  void rates(const double* behind_m_s, const Instant& now, double* rates) const override {
    rates[0] = now.acceleration_m_s2 - behind_m_s[0] / follows_s_;
  }

 private:
  double follows_s_ =
      note("follows_s", draws_.uniform(0.05, 0.4));  // Assumed: response of a rig's simulation of inertia
};

}  // namespace

const EffectKind kind_inertia_error{
    "inertia_error",
    {"percent", "true over reckoned inertia of drum, roller or vehicle, less one", 0.0, -30.0, 30.0,
     log_normal(0.3, 4.0, 0.25, 6.0), true},
    {{"rigid", "a factor on the inertia", make_law<RigidInertia>},
     {"soft", "hanging on through a soft coupling that follows the speed with a lag of first order",
      make_law<SoftInertia>}},
    kEveryGround,
    kEveryGround};

}  // namespace rollrig::generator
