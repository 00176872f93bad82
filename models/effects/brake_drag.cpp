/// Brake pads keep rubbing after the brake is released.
#include "models/effect.h"

namespace rollrig::models::brake_drag {

struct BrakeDrag {
  enum Parameter { kForce, kDecay, kSetImpulse, kWearPower };
  enum State { kDragging };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "brake_drag";
    info.summary = "After braking the pads keep dragging on the disc until they have worked back";
    info.equation =
        "F_par <- F_par + F_d d, dd/dt = (1 - d) F_brake/(I_s + F_brake tau_s) - d (v/v_t)^n/tau, tau_s = 2 s, v_t = "
        "40 km/h, v not below 0.5 m/s; its heat goes into the disc and the air";
    info.source =
        "residual torque of disc brakes: SAE 2015-01-2670. Assumed: 2 to 12 N, decays after braking; first order; "
        "tau; I_s (one braking of everyday strength and length sets it); tau_s, the least time that it takes; n, from "
        "0 (creeps back in time) to 1 (pushed back by the turning disc)";
    info.parameters = {
        {"force_N",
         between(-50.0, 100.0),
         {2.0, 12.0, Prior::Scale::kLog},
         "F_d, of one wheel right after braking",
         0.0},
        {"decay_min", between(0.2, 120.0), {0.5, 5.0, Prior::Scale::kLog}, "tau, in which it decays at 40 km/h"},
        {"set_impulse_N_s",
         between(50.0, 1e6),
         {500.0, 5000.0, Prior::Scale::kLog},
         "I_s, brake force of one wheel times the time until it is set"},
        {"wear_power", between(-0.5, 1.5), {0.0, 1.0}, "n, of the speed in the pace of its decay"}};
    info.states = {{"dragging", 1.0, "d, share of the full drag"}};
    info.acts_on = &is_of_vehicle;
    info.visible_in = {quantities::kMachineForce};
    info.clean_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"toe_camber_drag"};
    info.splitting_tests = {"coastdown with and without braking before it", "steady speed after braking"};
    return info;
  }

  template <class S>
  static void parasitic(const EffectView<S>& self, const Instant<S>&, ParasiticPort<S>& port) {
    port.extra_force_N += self.parameter(kForce) * self.state(kDragging);
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    using std::pow;
    using std::sqrt;
    const S town_m_s = quantity<S>(40.0 / 3.6, dimension::kSpeed);
    const S slow_m_s = quantity<S>(0.5, dimension::kSpeed);  // Assumed: keeps the power finite at standstill
    const S& speed_m_s = now.motion.speed_m_s;
    const S least_s = quantity<S>(2.0, dimension::kTime);
    const S& brake_N = now.acting.brake_force_N;
    const S setting_per_s = brake_N / (self.parameter(kSetImpulse) + brake_N * least_s);
    const S pace = pow(sqrt(speed_m_s * speed_m_s + slow_m_s * slow_m_s) / town_m_s, self.parameter(kWearPower));
    rates[kDragging] =
        (S(1.0) - self.state(kDragging)) * setting_per_s - self.state(kDragging) * pace / self.parameter(kDecay);
  }
};

const Effect& effect() { return make_effect<BrakeDrag>(); }

}  // namespace rollrig::models::brake_drag
