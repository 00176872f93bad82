/// The loss falls with another power of the pressure than the tire file's.
#include "models/effect.h"

namespace rollrig::models::pressure_exponent {

struct PressureExponent {
  enum Parameter { kShift };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "pressure_exponent";
    info.summary =
        "Rolling resistance falls with another power of the pressure than the tire file's, at equal temperature; weak "
        "where one pressure is run";
    info.equation = "F_rr <- F_rr (p/p_ref)^-d, so that F_rr goes with p^-(a + d); a of the tire file";
    info.source =
        "Kolekar and Narasimhan (2024) §2.2.2.3: 0.3 to 0.5 in the tests that it quotes. As a difference, since each "
        "tire file has its own a, at which the effect does nothing. Assumed: a + d from 0.25 to 0.55 about the usual "
        "0.4";
    info.parameters = {{"exponent_shift", between(-1.0, 1.0), {-0.15, 0.15}, "d, exponent less the tire file's", 0.0}};
    info.faint_on = &is_on_road;  // one pressure
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.splitting_tests = {"pressure sweep at one load", "pressure set anew on a warm tire, at one temperature"};
    return info;
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    using std::pow;
    if (value_of(now.pressure_Pa) <= 0.0) return;  // flat: out of the law's validity
    const S& reference_Pa = now.context->tire.rolling_resistance.reference_pressure_Pa;
    port.factor *= pow(now.pressure_Pa / reference_Pa, -self.parameter(kShift));
  }
};

const Effect& effect() { return make_effect<PressureExponent>(); }

}  // namespace rollrig::models::pressure_exponent
