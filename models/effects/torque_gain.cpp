/// The scale of the torque measurement is off.
#include "models/effect.h"

namespace rollrig::models {
namespace {

struct TorqueGain {
  enum Parameter { kGain };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "torque_gain";
    info.summary =
        "The force measurement shows a fixed share too much or too little: drum torque, loss force or traction force; "
        "the level of the loss takes it up where that is uncertain, but temperatures do not follow it";
    info.equation = "torque <- torque (1 + s), loss force <- loss force (1 + s), traction force <- the same";
    info.source =
        "2 %, of all torque: effects.md. On a dynamometer one scale of hub and roller, so that the loss between them "
        "has it too; Assumed: two scales that differ would leak the drive force into it, which is not in the catalogue";
    info.parameters = {{"gain_percent", between(-50.0, 50.0), {-2.0, 2.0}, "s, shown over true, less one", 0.0}};
    info.visible_in = {"drum_torque_Nm", "loss_force_N", "traction_force_N"};
    info.clean_in = {"liner_temperature_degC", "cavity_pressure_kPa"};
    info.confused_with = {"load_record"};
    info.splitting_tests = {"dead weights on a lever of known length", "ramps of a drum of known inertia, tire lifted"};
    return info;
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    const S factor = S(1.0) + self.parameter(kGain);
    for (const char* name : {"drum_torque_Nm", "loss_force_N", "traction_force_N"}) {
      std::vector<S>* values = port.find(name);
      if (values == nullptr) continue;
      for (S& value : *values) value *= factor;
    }
  }
};

}  // namespace

const Effect& effect_torque_gain() {
  static const Effect effect = make_effect<TorqueGain>();
  return effect;
}

}  // namespace rollrig::models
