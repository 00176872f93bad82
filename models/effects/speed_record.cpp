/// The recorded speed is off by a scale.
#include "models/effect.h"

namespace rollrig::models {
namespace {

struct SpeedRecord {
  enum Parameter { kError };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "speed_record";
    info.summary =
        "What really turns is faster or slower than recorded, by a fixed share: loss, heat, drag and inertia go with "
        "the "
        "true speed, while the record keeps its own";
    info.equation = "v <- v (1 + s), dv/dt <- (1 + s) dv/dt, on entry as recorded";
    info.source =
        "scale, 1 to 10 %: effects.md. The record is given and the truth follows from it; torque and force are "
        "measured "
        "by themselves, so that their channels have no error of their own from it. A slope is taken as it is recorded. "
        "Assumed: either sign";
    info.parameters = {{"error_percent",
                        between(-50.0, 50.0),
                        {1.0, 10.0, Prior::Scale::kLog, true},
                        "s, true over recorded, less one",
                        0.0}};
    info.visible_in = {"drum_torque_Nm", "loss_force_N", "traction_force_N", "liner_temperature_degC",
                       "cavity_pressure_kPa"};
    info.confused_with = {"inertia_error"};
    info.splitting_tests = {"hand tachometer on drum or roller", "revolutions counted over a minute",
                            "ramps of several accelerations with the tire lifted"};
    return info;
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, InputPort<S>& port) {
    const S factor = S(1.0) + self.parameter(kError);
    port.speed_m_s *= factor;
    port.acceleration_m_s2 *= factor;
  }
};

}  // namespace

const Effect& effect_speed_record() {
  static const Effect effect = make_effect<SpeedRecord>();
  return effect;
}

}  // namespace rollrig::models
