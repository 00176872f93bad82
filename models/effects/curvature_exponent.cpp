/// The curvature of the drum counts more or less than the standard says.
#include "models/effect.h"

namespace rollrig::models::curvature_exponent {

struct CurvatureExponent {
  enum Parameter { kExponent };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "curvature_exponent";
    info.summary = "Loss goes from one drum to another with a power of the standard's correction factor other than one";
    info.equation = "F_rr <- F_rr K^(n - 1), so that F_rr goes with K^n; K = 1 on the tire's reference drum";
    info.source = "Kolekar and Narasimhan (2024) (3.1), after ISO 28580. Assumed: n 0.6 to 1.4";
    info.parameters = {{"exponent", between(-1.0, 3.0), {0.6, 1.4}, "n, power of the correction factor", 1.0}};
    info.faint_on = &is_drum;  // no change at all where the drum is the reference drum
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"tie_down_load"};
    info.splitting_tests = {"the same tire on three diameters", "tie-downs slack and tight"};
    return info;
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    using std::pow;
    port.factor *= pow(now.curvature_factor, self.parameter(kExponent) - S(1.0));
  }
};

const Effect& effect() { return make_effect<CurvatureExponent>(); }

}  // namespace rollrig::models::curvature_exponent
