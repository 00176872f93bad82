/// The scale of the torque measurement is off, or bent.
#include "models/effect.h"

namespace rollrig::models::torque_gain {

struct TorqueGain {
  enum Parameter { kGain, kPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "torque_gain";
    info.summary =
        "The force measurement shows a share too much or too little, fixed or other at other forces: drum torque, loss "
        "force or traction force; the level of the loss takes it up where that is uncertain, but temperatures do not "
        "follow it";
    info.equation =
        "F <- F (1 + s q), q = (((F/F_ref)^2 + e^2)/(1 + e^2))^(n/2), F_ref = 60 N, e = 0.05; F: torque over the "
        "drum's radius, loss force; traction force of a vehicle on the road: q = 1";
    info.source =
        "on a dynamometer one scale of hub and roller, so that the loss between them has it too. Assumed: 2 %, of all "
        "torque; two scales that differ would leak the drive force into it, which is not in the catalog; n about 0, "
        "below it for a bridge that reads less at high force, which a rig's sensor is and the reckoning of a motor's "
        "force is not; F_ref, about the rolling resistance of a car's tire; e, below which the share stays, since the "
        "force passes through 0";
    info.parameters = {{"gain_percent", between(-50.0, 50.0), {-2.0, 2.0}, "s, shown over true at 60 N, less one", 0.0},
                       {"power", between(-0.9, 1.0), {-0.2, 0.2}, "n, of the force, by which the share grows"}};
    info.visible_in = {quantities::kMachineForce};
    info.clean_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"load_record"};
    info.splitting_tests = {"dead weights on a lever of known length", "ramps of a drum of known inertia, tire lifted"};
    return info;
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    using std::pow;
    constexpr double kAtRest = 0.05;
    const S reference = port.to_reading(quantity<S>(60.0, dimension::kForce));
    std::vector<S>* force = port.find_force();
    if (force == nullptr) return;
    for (S& value : *force) {
      const S x = value / reference;
      const S share =
          is_on_road(port.context->machine)
              ? S(1.0)
              : pow(S((x * x + S(kAtRest * kAtRest)) / S(1.0 + kAtRest * kAtRest)), S(0.5 * self.parameter(kPower)));
      value *= S(1.0) + self.parameter(kGain) * share;
    }
  }
};

const Effect& effect() { return make_effect<TorqueGain>(); }

}  // namespace rollrig::models::torque_gain
