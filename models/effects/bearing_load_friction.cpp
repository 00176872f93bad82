/// The bearings of spindle and roller rub more under load.
#include "models/effect.h"

namespace rollrig::models::bearing_load_friction {

struct BearingLoadFriction {
  enum Parameter { kForce };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "bearing_load_friction";
    info.summary =
        "Bearings that carry the wheel's load rub in proportion to it, whatever their temperature; skim does not "
        "show it, so it is counted as loss of the tire";
    info.equation = "F_par <- F_par + F_b Fz/(5.4 kN)";
    info.source =
        "Kolekar and Narasimhan (2024) §3.2.3.2 takes the parasitic loss at skim load for that under load; a bearing's "
        "friction moment goes with its load (coefficient of friction, bearing makers' catalogs). Assumed: 0.3 to 3 N "
        "at 5.4 kN";
    info.parameters = {
        {"force_N", between(0.0, 50.0), {0.3, 3.0, Prior::Scale::kLog}, "F_b, at the surface, at 5.4 kN", 0.0}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kMachineForce};
    info.clean_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"load_cross_talk", "tire_loss_in_skim", "load_exponent"};
    info.splitting_tests = {"the same run with reversed rotation", "load sweep hot and cold",
                            "skim at 50, 100, 200 and 400 N, extrapolated to zero"};
    return info;
  }

  template <class S>
  static void parasitic(const EffectView<S>& self, const Instant<S>& now, ParasiticPort<S>& port) {
    const S reference_N = quantity<S>(5400.0, dimension::kForce);
    port.extra_force_N += self.parameter(kForce) * (positive_part(now.motion.load_N) / reference_N);
  }
};

const Effect& effect() { return make_effect<BearingLoadFriction>(); }

}  // namespace rollrig::models::bearing_load_friction
