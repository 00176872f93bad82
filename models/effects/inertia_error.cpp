/// The inertia that is reckoned with is not the one that turns.
#include "models/effect.h"

namespace rollrig::models::inertia_error {

struct InertiaError {
  enum Parameter { kError };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "inertia_error";
    info.summary =
        "The true inertia of drum or roller and the true effective mass of the vehicle differ from the files'";
    info.equation = "J <- J (1 + s), m <- m (1 + s)";
    info.source =
        "Assumed: 0.3 to 4 %; one s for machine and vehicle, either sign; law off by 15 % here and there, as where a "
        "simulated inertia follows the speed with a lag";
    info.parameters = {{"error_percent",
                        between(-30.0, 30.0),
                        {0.3, 4.0, Prior::Scale::kLog, true},
                        "s, true over reckoned, less one",
                        0.0}};
    info.visible_in = {quantities::kMachineForce};
    info.clean_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"slip_loss", "speed_record"};
    info.splitting_tests = {"ramps of several accelerations with the tire lifted",
                            "ramps up and down: slip has one sign"};
    info.law_error = {0.15, 0.03};  // Assumed
    return info;
  }

  template <class S>
  static void contact(const EffectView<S>& self, const Instant<S>&, ContactPort<S>& port) {
    const S factor = S(1.0) + self.parameter(kError);
    port.machine_inertia_factor *= factor;
    port.vehicle_mass_factor *= factor;
  }
};

const Effect& effect() { return make_effect<InertiaError>(); }

}  // namespace rollrig::models::inertia_error
