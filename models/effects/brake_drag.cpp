/// Brake pads keep rubbing after the brake is released.
#include "models/effect.h"

namespace rollrig::models {
namespace {

struct BrakeDrag {
  enum Parameter { kForce, kDecay, kSetTime, kSetForce };
  enum State { kDragging };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "brake_drag";
    info.summary = "After braking the pads keep dragging on the disc until they have worked back";
    info.equation =
        "F_par <- F_par + F_d d, dd/dt = (1 - d) (F_brake/(F_brake + F_b))/tau_s - d/tau; its heat goes into the "
        "disc and the air";
    info.source =
        "residual torque of disc brakes: SAE 2015-01-2670; 2 to 12 N, decays after braking: effects.md. Assumed: "
        "first order; tau, tau_s, F_b (brakings of everyday strength and length set it)";
    info.parameters = {
        {"force_N",
         between(-50.0, 100.0),
         {2.0, 12.0, Prior::Scale::kLog},
         "F_d, of one wheel right after braking",
         0.0},
        {"decay_min", between(0.05, 120.0), {0.5, 5.0, Prior::Scale::kLog}, "tau, in which it decays"},
        {"set_time_s", between(2.0, 60.0), {2.0, 6.0, Prior::Scale::kLog}, "tau_s, of strong braking until it is set"},
        {"set_force_N",
         positive(),
         {50.0, 400.0, Prior::Scale::kLog},
         "F_b, brake force of one wheel at which it sets at half that pace"}};
    info.states = {{"dragging", 1.0, "d, share of the full drag"}};
    info.acts_on = {RigKind::kDyno, RigKind::kFlat};
    info.visible_in = {"loss_force_N", "traction_force_N"};
    info.clean_in = {"liner_temperature_degC", "cavity_pressure_kPa"};
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
    const S& brake_N = now.acting.brake_force_N;
    const S pressed = brake_N / (brake_N + self.parameter(kSetForce));
    rates[kDragging] = (S(1.0) - self.state(kDragging)) * pressed / self.parameter(kSetTime) -
                       self.state(kDragging) / self.parameter(kDecay);
  }
};

}  // namespace

const Effect& effect_brake_drag() {
  static const Effect effect = make_effect<BrakeDrag>();
  return effect;
}

}  // namespace rollrig::models
