/// Longitudinal slip under drive and brake force costs work.
#include "models/effect.h"

namespace rollrig::models::slip_loss {

struct SlipLoss {
  enum Parameter { kCompliance };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "slip_loss";
    info.summary = "Drive and brake force make the tire slip, and the work of the slip heats the rubber";
    info.equation = "slip s = Fx/C at the contact, loss Fx s = Fx^2/C, P_slip = Fx^2 v/C into the rubber";
    info.source =
        "Kolekar and Narasimhan (2024) §1.6 (drive and brake torque left out). As compliance 1/C, so that 0 is the "
        "baseline's stiff contact. Assumed: C 60 to 250 kN, 10 to 45 times a car tire's load; all of it stays in the "
        "rubber";
    info.parameters = {{"compliance_per_kN",
                        between(0.0, 0.1),
                        {1.0 / 250.0, 1.0 / 60.0, Prior::Scale::kLog},
                        "1/C, C = dFx/ds",
                        0.0}};
    info.faint_on = &hides_slip;  // Fx of a towed wheel; no slip in a force read off torque
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"inertia_error"};
    info.splitting_tests = {"constant speed at several drive and brake forces", "the same speed steps at two masses"};
    return info;
  }

  template <class S>
  static void contact(const EffectView<S>& self, const Instant<S>&, ContactPort<S>& port) {
    port.slip_compliance_per_N += self.parameter(kCompliance);
  }

  /// At 0 what the mechanics dissipate is numerical and heats nothing, but the derivative is that of Fx^2 v/C.
  template <class S>
  static void thermal(const EffectView<S>& self, const Instant<S>& now, ThermalPort<S>& port) {
    using std::abs;
    const S& force_N = now.motion.longitudinal_force_N;
    const bool stiff = value_of(self.parameter(kCompliance)) <= 0.0;
    const S heat_W = stiff ? S(force_N * force_N * self.parameter(kCompliance) * abs(now.motion.speed_m_s))
                           : now.motion.slip_power_W;
    add_tire_heat(now, HeatSource::kFriction, heat_W, port);
  }
};

const Effect& effect() { return make_effect<SlipLoss>(); }

}  // namespace rollrig::models::slip_loss
