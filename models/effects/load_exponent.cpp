/// The loss grows with another power of the load than the first.
#include "models/effect.h"

namespace rollrig::models::load_exponent {

struct LoadExponent {
  enum Parameter { kExponent };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "load_exponent";
    info.summary = "Rolling resistance goes with a power of the load other than one, at equal temperature";
    info.equation = "F_rr <- F_rr (Fz/Fz_ref)^(b - 1), so that F_rr goes with Fz^b";
    info.source = "Kolekar and Narasimhan (2024) (3.7) and §3.3.1.3. Assumed: b 0.85 to 1.15";
    info.parameters = {{"exponent", between(0.3, 2.0), {0.85, 1.15}, "b, exponent of the load", 1.0}};
    info.faint_on = &is_on_road;  // one load
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"tire_loss_in_skim", "bearing_load_friction"};
    info.splitting_tests = {"skim at 50, 100, 200 and 400 N, extrapolated to zero", "load sweep hot and cold"};
    return info;
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    using std::pow;
    const S& load_N = now.motion.load_N;
    if (value_of(load_N) <= 0.0) return;  // lifted: no loss to scale
    const S& reference_N = now.context->tire.rolling_resistance.reference_load_N;
    port.factor *= pow(load_N / reference_N, self.parameter(kExponent) - S(1.0));
  }
};

const Effect& effect() { return make_effect<LoadExponent>(); }

}  // namespace rollrig::models::load_exponent
