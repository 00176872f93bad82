/// A wheel that stands at an angle to its way drags.
#include "models/effect.h"

namespace rollrig::models::toe_camber_drag {

struct ToeCamberDrag {
  enum Parameter { kForce, kHeatShare, kLoadPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "toe_camber_drag";
    info.summary =
        "Toe and camber make a side force whose component against the motion drags; part of it heats the rubber";
    info.equation = "F <- F + F_a (Fz/Fz_ref)^m, F_a = C_a a^2 at the reference load; share h of it heats the rubber";
    info.source =
        "side force C_a a at a slip angle a, resolved against the motion. Assumed: 2 to 12 N, part of it heat; h (the "
        "rest goes off at the sliding part of the contact), m (cornering stiffness rises with load, less than in "
        "proportion)";
    info.parameters = {
        {"force_N", between(-50.0, 50.0), {2.0, 12.0, Prior::Scale::kLog}, "F_a, at the tire's reference load", 0.0},
        {"heat_share", between(0.0, 1.0), {0.3, 0.9}, "h, of the drag that heats the rubber"},
        {"load_power", between(0.0, 2.0), {0.5, 1.0}, "m, how it goes with load"}};
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"tie_down_load", "brake_drag"};
    info.splitting_tests = {"wheel set to zero toe and camber", "toe set to both sides: the drag goes with the square",
                            "coastdown before and after braking"};
    return info;
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    using std::pow;
    const S& load_N = now.motion.load_N;
    if (value_of(load_N) <= 0.0) return;  // lifted: no side force
    const S load_ratio = load_N / now.context->tire.rolling_resistance.reference_load_N;
    port.add_force(self.parameter(kForce) * pow(load_ratio, self.parameter(kLoadPower)), self.parameter(kHeatShare));
  }
};

const Effect& effect() { return make_effect<ToeCamberDrag>(); }

}  // namespace rollrig::models::toe_camber_drag
